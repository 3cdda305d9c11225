#include "gap/drive/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"

namespace gap {
namespace {

// A record is stepped at no more nodes than this, however finely it is stamped.
constexpr double most_nodes = 60000.0;

bool moves(const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [&](double value) { return value != values.front(); });
}

}  // namespace

Grid Record::grid(double per_interval) const {
    Grid grid;
    grid.first_s = time_s.front();
    const double length_s = time_s.back() - time_s.front();
    grid.step_s = std::max(usual_interval_s / per_interval, length_s / most_nodes);
    grid.count = static_cast<std::size_t>(std::ceil(length_s / grid.step_s - 1e-6)) + 2;
    return grid;
}

Record to_record(drive::Log log) {
    const auto refuse = [&](const std::string& what) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{}: {}", log.name, what));
    };
    Record record{log.name, std::move(log.time_s), std::move(log.input), std::move(log.output), 0.0};
    record.more_inputs = std::move(log.more_inputs);
    record.simulated = std::move(log.simulated);
    if (record.size() < 32) {
        refuse(fmt::format("expected 32 samples or more, found {}", record.size()));
    }
    if (!moves(record.output)) {
        refuse(fmt::format("the output is {} throughout: nothing can be diagnosed", record.output.front()));
    }
    std::vector<double> intervals;
    for (std::size_t i = 1; i < record.size(); ++i) {
        intervals.push_back(record.time_s[i] - record.time_s[i - 1]);
    }
    std::nth_element(intervals.begin(), intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2),
                     intervals.end());
    record.usual_interval_s = intervals[intervals.size() / 2];
    return record;
}

Record up_to(const Record& record, double until_s) {
    const auto count = static_cast<std::size_t>(std::lower_bound(record.time_s.begin(), record.time_s.end(), until_s) -
                                                record.time_s.begin());
    Record first = record;
    first.time_s.resize(count);
    for (auto* values : {&first.input, &first.output, &first.simulated}) {
        values->resize(std::min(count, values->size()));
    }
    for (auto& values : first.more_inputs) {
        values.resize(count);
    }
    return first;
}

Record thinned(const Record& record, std::size_t every) {
    Record thin;
    thin.name = record.name;
    thin.usual_interval_s = record.usual_interval_s * static_cast<double>(every);
    thin.more_inputs.resize(record.more_inputs.size());
    const auto mean_held = [&](const std::vector<double>& values, std::size_t from, std::size_t to) {
        double sum = 0.0;
        for (std::size_t i = from; i < to; ++i) {
            sum += values[i] * (record.time_s[i + 1] - record.time_s[i]);
        }
        return to > from ? sum / (record.time_s[to] - record.time_s[from]) : values[from];
    };
    for (std::size_t i = 0; i < record.size(); i += every) {
        const std::size_t to = std::min(i + every, record.size() - 1);
        thin.time_s.push_back(record.time_s[i]);
        thin.output.push_back(record.output[i]);
        thin.input.push_back(mean_held(record.input, i, to));
        for (std::size_t m = 0; m < record.more_inputs.size(); ++m) {
            thin.more_inputs[m].push_back(mean_held(record.more_inputs[m], i, to));
        }
    }
    return thin;
}

std::vector<double> held_on(const Grid& grid, std::span<const double> time_s, std::span<const double> levels) {
    std::vector<double> held(grid.count, 0.0);
    std::size_t i = 0;
    for (std::size_t k = 0; k < grid.count; ++k) {
        const double from = grid.at(k);
        const double to = grid.at(k + 1);
        double sum = 0.0;
        double at = from;
        while (at < to - 1e-9 * grid.step_s) {
            while (i + 1 < time_s.size() && time_s[i + 1] <= at + 1e-9 * grid.step_s) {
                ++i;
            }
            const double until = i + 1 < time_s.size() ? std::min(to, time_s[i + 1]) : to;
            sum += (until - at) * levels[i];
            at = until;
        }
        held[k] = sum / grid.step_s;
    }
    return held;
}

std::vector<double> read_at(const Grid& grid, std::span<const double> nodes, std::span<const double> times_s) {
    std::vector<double> read;
    read.reserve(times_s.size());
    for (const double time : times_s) {
        const double place =
            std::clamp((time - grid.first_s) / grid.step_s, 0.0, static_cast<double>(nodes.size() - 1));
        const auto below = std::min(static_cast<std::size_t>(place), nodes.size() - 2);
        const double share = place - static_cast<double>(below);
        read.push_back((1.0 - share) * nodes[below] + share * nodes[below + 1]);
    }
    return read;
}

}  // namespace gap
