#include "drive/static_characteristic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"

namespace drive {
namespace {

struct Mean {
    double value;
    double deviation;
};

// Of the outputs with from_s <= t < to_s; the hold has samples there.
Mean mean_of(const Log& log, double from_s, double to_s) {
    double sum = 0.0;
    double square = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < log.time_s.size(); ++i) {
        if (log.time_s[i] >= from_s && log.time_s[i] < to_s) {
            sum += log.output[i];
            count += 1.0;
        }
    }
    const double mean = sum / std::max(count, 1.0);
    for (std::size_t i = 0; i < log.time_s.size(); ++i) {
        if (log.time_s[i] >= from_s && log.time_s[i] < to_s) {
            square += (log.output[i] - mean) * (log.output[i] - mean);
        }
    }
    return {mean, std::sqrt(square / std::max(count - 1.0, 1.0))};
}

}  // namespace

StaticCharacteristic static_characteristic(const Log& log, double shortest_s) {
    const auto refuse = [&](const std::string& what) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: {}", log.name, what));
    };
    if (log.input.size() != log.time_s.size()) {
        refuse("expected a column input or duty, found none");
    }
    const auto [lowest, highest] = std::minmax_element(log.output.begin(), log.output.end());
    const double range = *highest - *lowest;
    StaticCharacteristic found;
    double before = 0.0;
    double longest_s = 0.0;
    for (std::size_t first = 0; first < log.time_s.size();) {
        std::size_t end = first;
        while (end < log.time_s.size() && log.input[end] == log.input[first]) {
            ++end;
        }
        const double from_s = log.time_s[first];
        const double to_s = end < log.time_s.size() ? log.time_s[end] : log.time_s.back();
        const double held_s = to_s - from_s;
        longest_s = std::max(longest_s, held_s);
        if (held_s >= shortest_s && end - first >= 16) {
            const Mean last = mean_of(log, to_s - 0.25 * held_s, to_s);
            const double drift = mean_of(log, to_s - 0.125 * held_s, to_s).value -
                                 mean_of(log, to_s - 0.25 * held_s, to_s - 0.125 * held_s).value;
            found.levels.push_back({log.input[first], last.value, last.deviation, from_s, to_s, drift,
                                    std::fabs(drift) <= 0.02 * range, log.input[first] >= before});
        }
        before = log.input[first];
        first = end;
    }
    if (found.levels.empty()) {
        refuse(fmt::format("expected a hold of the input of at least {} s and 16 samples, the longest has {} s",
                           shortest_s, longest_s));
    }
    double count = 0.0;
    double mean_input = 0.0;
    double mean_output = 0.0;
    double smallest = highest == log.output.end() ? 0.0 : *highest;
    double largest = lowest == log.output.end() ? 0.0 : *lowest;
    for (const Level& level : found.levels) {
        if (level.settled) {
            count += 1.0;
            mean_input += level.input;
            mean_output += level.output;
            smallest = std::min(smallest, level.output);
            largest = std::max(largest, level.output);
        }
    }
    if (count == 0.0) {
        refuse(fmt::format("expected a hold in which the output settles; of {} holds none does", found.levels.size()));
    }
    mean_input /= count;
    mean_output /= count;
    double product = 0.0;
    double square = 0.0;
    for (const Level& level : found.levels) {
        if (level.settled) {
            product += (level.input - mean_input) * (level.output - mean_output);
            square += (level.input - mean_input) * (level.input - mean_input);
        }
    }
    found.slope = square > 0.0 ? product / square : 0.0;
    found.intercept = mean_output - found.slope * mean_input;
    for (const Level& level : found.levels) {
        if (level.settled && largest > smallest) {
            found.largest_bend =
                std::max(found.largest_bend,
                         std::fabs(level.output - found.intercept - found.slope * level.input) / (largest - smallest));
        }
    }
    return found;
}

std::string to_text(const StaticCharacteristic& found) {
    std::string text =
        fmt::format("{:>10} {:>12} {:>12} {:>10} {:>10}\n", "input", "output", "deviation", "from s", "to s");
    for (const Level& level : found.levels) {
        text += fmt::format("{:>10.5g} {:>12.6g} {:>12.2g} {:>10.2f} {:>10.2f}  {}{}\n", level.input, level.output,
                            level.deviation, level.from_s, level.to_s, level.rising ? "up" : "down",
                            level.settled ? "" : fmt::format(", not settled: still moves by {:.2g}", level.drift));
    }
    return text +
           fmt::format(
               "straight line {:.6g} + {:.6g} input; the output bends away from it by up to {:.1f} % of its range\n",
               found.intercept, found.slope, 100.0 * found.largest_bend);
}

std::string to_csv(const StaticCharacteristic& found) {
    std::string text = "input,output,deviation,from_s,to_s,settled,rising\n";
    for (const Level& level : found.levels) {
        text += fmt::format("{},{},{},{},{},{},{}\n", level.input, level.output, level.deviation, level.from_s,
                            level.to_s, level.settled ? 1 : 0, level.rising ? 1 : 0);
    }
    return text;
}

base::Picture picture_of_characteristic(const StaticCharacteristic& found, const std::string& title) {
    std::string up = "$up << EOD\n";
    std::string down = "$down << EOD\n";
    for (const Level& level : found.levels) {
        if (level.settled) {
            (level.rising ? up : down) +=
                fmt::format("{:.9g} {:.9g} {:.9g}\n", level.input, level.output, level.deviation);
        }
    }
    return {
        up + "EOD\n" + down + "EOD\n" +
            fmt::format(
                "set title \"{}\" noenhanced\nset xlabel \"input\"\nset ylabel \"output at rest\"\nset grid lc rgb "
                "\"#dddddd\"\nset key top left\nset border 3\nset tics nomirror\nplot {:.9g} + {:.9g} * x with lines "
                "lc rgb \"{}\" dt 2 title \"straight line\", $up using 1:2:3 with yerrorbars pt 9 ps 1.2 lc rgb \"{}\" "
                "title \"reached from below\", $down using 1:2:3 with yerrorbars pt 11 ps 1.2 lc rgb \"{}\" title "
                "\"reached from above\"\n",
                title, found.intercept, found.slope, base::palette[7], base::palette[0], base::palette[1]),
        800, 520};
}

}  // namespace drive
