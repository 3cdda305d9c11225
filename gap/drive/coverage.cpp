#include "gap/drive/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "gap/drive/audit.hpp"

namespace gap {
namespace {

using Records = std::vector<Record>;

double span_of(const std::vector<double>& sorted, const std::vector<double>& others) {
    return std::max(sorted.back(), others.back()) - std::min(sorted.front(), others.front());
}

struct Way {
    double total = 0.0;
    double longest = 0.0;  // without a turn
    void add(double by) {
        total += by;
        longest = std::max(longest, by);
    }
};

struct Ways {
    Way up;
    Way down;
};

// Medians of five: a reading that was lost for once is no motion.
std::vector<double> without_spikes(const std::vector<double>& values) {
    constexpr std::size_t around = 2;
    std::vector<double> medians = values;
    for (std::size_t i = around; i + around < values.size(); ++i) {
        std::vector<double> near(values.begin() + static_cast<std::ptrdiff_t>(i - around),
                                 values.begin() + static_cast<std::ptrdiff_t>(i + around + 1));
        std::nth_element(near.begin(), near.begin() + around, near.end());
        medians[i] = near[around];
    }
    return medians;
}

// How far the outputs go up and down, between turns of more than what noise makes.
Ways ways_of(const Records& records, double least_turn) {
    Ways ways;
    for (const Record& record : records) {
        double low = record.output.front();
        double high = low;
        int direction = 0;
        for (const double value : without_spikes(record.output)) {
            low = direction > 0 ? low : std::min(low, value);
            high = direction < 0 ? high : std::max(high, value);
            // Of the first one, what was before is neither way.
            if (direction >= 0 && high - value > least_turn) {
                ways.up.add(direction > 0 ? high - low : 0.0);
                direction = -1;
                low = value;
            } else if (direction <= 0 && value - low > least_turn) {
                ways.down.add(direction < 0 ? high - low : 0.0);
                direction = 1;
                high = value;
            }
        }
        if (direction != 0) {
            (direction > 0 ? ways.up : ways.down).add(high - low);
        }
    }
    return ways;
}

void add_directions(std::vector<std::string>& all, const Records& train, const Records& validate, double span) {
    const double noise = std::max(audit(train).noise, audit(validate).noise);
    const double least_turn = std::max(0.03 * span, 6.0 * noise);
    const Ways known = ways_of(train, least_turn);
    const Ways asked = ways_of(validate, least_turn);
    const auto lacks = [span](const Way& of_training, const Way& of_validation) {
        constexpr double there = 0.1;
        constexpr double part = 0.25;
        return of_validation.longest >= there * span && of_training.total < part * of_validation.longest;
    };
    if (lacks(known.up, asked.up)) {
        all.emplace_back("rising output");
    }
    if (lacks(known.down, asked.down)) {
        all.emplace_back("falling output");
    }
}

// \param signal  of a record
template <class Signal>
std::vector<double> sorted_values(const Records& records, const Signal& signal) {
    std::vector<double> values;
    for (const Record& record : records) {
        const std::vector<double>& some = std::invoke(signal, record);
        values.insert(values.end(), some.begin(), some.end());
    }
    std::sort(values.begin(), values.end());
    return values;
}

void add_levels(std::vector<std::string>& all, const std::vector<double>& known, const std::vector<double>& asked,
                const std::string& name, double noise) {
    const double span = span_of(known, asked);
    if (!(span > 0.0)) {
        return;
    }
    const double beyond = std::max(0.05 * span, 4.0 * noise);
    const std::size_t few = asked.size() / 100;
    if (asked[asked.size() - 1 - few] > known.back() + beyond) {
        all.push_back(fmt::format("{} above {:.3g}", name, known.back()));
    }
    if (asked[few] < known.front() - beyond) {
        all.push_back(fmt::format("{} below {:.3g}", name, known.front()));
    }
    for (std::size_t i = 1; i < known.size(); ++i) {
        if (known[i] - known[i - 1] > 0.2 * span) {
            const auto from = std::upper_bound(asked.begin(), asked.end(), known[i - 1] + beyond);
            const auto to = std::lower_bound(from, asked.end(), known[i] - beyond);
            if (10 * (to - from) > static_cast<std::ptrdiff_t>(asked.size())) {
                all.push_back(fmt::format("{} between {:.3g} and {:.3g}", name, known[i - 1], known[i]));
            }
        }
    }
}

// What an output's mean square in each band is in proportion to, its ends' difference taken off; the mean of several
// records by their lengths. \param edges  Hz, rising
std::vector<double> squares_by_band(const Records& records, const std::vector<double>& edges) {
    std::vector<double> squares(edges.size() - 1, 0.0);
    double samples = 0.0;
    for (const Record& record : records) {
        const std::size_t size = record.size();
        const double last = static_cast<double>(size - 1);
        const double mean_step = (record.output.back() - record.output.front()) / last;
        double mean = 0.0;
        std::vector<double> values(size);
        for (std::size_t i = 0; i < size; ++i) {
            values[i] = record.output[i] - mean_step * static_cast<double>(i);
            mean += values[i] / static_cast<double>(size);
        }
        for (std::size_t i = 0; i < size; ++i) {
            // Hann's window.
            values[i] = (values[i] - mean) * (1.0 - std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / last));
        }
        Eigen::FFT<double> fft;
        std::vector<std::complex<double>> spectrum;
        fft.fwd(spectrum, values);
        const double rate_hz = last / (record.time_s.back() - record.time_s.front());
        for (std::size_t k = 1; k < size; ++k) {
            const double hz = rate_hz * static_cast<double>(std::min(k, size - k)) / static_cast<double>(size);
            const auto above = std::upper_bound(edges.begin(), edges.end(), hz);
            if (above != edges.begin() && above != edges.end()) {
                squares[static_cast<std::size_t>(above - edges.begin()) - 1] +=
                    std::norm(spectrum[k]) / static_cast<double>(size);
            }
        }
        samples += static_cast<double>(size);
    }
    for (double& square : squares) {
        square /= samples;
    }
    return squares;
}

// Half-decades from one period in the longest record of either to half the highest rate.
std::vector<double> edges_of(const Records& train, const Records& validate) {
    double longest_s = 0.0;
    double shortest_s = std::numeric_limits<double>::infinity();
    for (const Records* records : {&train, &validate}) {
        for (const Record& record : *records) {
            const double length_s = record.time_s.back() - record.time_s.front();
            longest_s = std::max(longest_s, length_s);
            shortest_s = std::min(shortest_s, length_s / static_cast<double>(record.size() - 1));
        }
    }
    std::vector<double> edges = {0.9 / longest_s};
    while (edges.back() < 0.5 / shortest_s) {
        edges.push_back(edges.back() * std::sqrt(10.0));
    }
    return edges;
}

void add_frequencies(std::vector<std::string>& all, const Records& train, const Records& validate) {
    const std::vector<double> edges = edges_of(train, validate);
    const std::vector<double> known = squares_by_band(train, edges);
    const std::vector<double> asked = squares_by_band(validate, edges);
    double variance = 0.0;
    for (const double square : asked) {
        variance += square;
    }
    constexpr double there = 0.02;
    constexpr double lacks = 0.05;
    const auto is_lacking = [&](std::size_t band) {
        return asked[band] > there * variance && known[band] < lacks * asked[band];
    };
    for (std::size_t from = 0; from < asked.size(); ++from) {
        if (!is_lacking(from)) {
            continue;
        }
        std::size_t to = from + 1;
        while (to < asked.size() && is_lacking(to)) {
            ++to;
        }
        // Above or below all that training has much of.
        const auto has_much = [&](std::size_t band) { return known[band] > there * variance; };
        bool slower = false;
        bool faster = false;
        for (std::size_t band = 0; band < asked.size(); ++band) {
            slower = slower || (band < from && has_much(band));
            faster = faster || (band >= to && has_much(band));
        }
        all.push_back(!faster   ? fmt::format("faster than {:.2g} Hz", edges[from])
                      : !slower ? fmt::format("slower than {:.2g} Hz", edges[to])
                                : fmt::format("between {:.2g} and {:.2g} Hz", edges[from], edges[to]));
        from = to;
    }
}

// Those that every record has.
std::size_t further_inputs_of(const Records& train, const Records& validate) {
    std::size_t count = train.front().more_inputs.size();
    for (const Records* records : {&train, &validate}) {
        for (const Record& record : *records) {
            count = std::min(count, record.more_inputs.size());
        }
    }
    return count;
}

}  // namespace

std::vector<std::string> extrapolated(const Records& train, const Records& validate) {
    std::vector<std::string> all;
    if (train.empty() || validate.empty()) {
        return all;
    }
    const auto known = [&](const auto& signal) { return sorted_values(train, signal); };
    const auto asked = [&](const auto& signal) { return sorted_values(validate, signal); };
    const std::vector<double> known_output = known(&Record::output);
    const std::vector<double> asked_output = asked(&Record::output);
    const double span = span_of(known_output, asked_output);
    if (!(span > 0.0)) {
        return all;
    }
    add_directions(all, train, validate, span);
    add_levels(all, known(&Record::input), asked(&Record::input), "input", 0.0);
    for (std::size_t i = 0; i < further_inputs_of(train, validate); ++i) {
        const auto further = [i](const Record& record) -> const std::vector<double>& { return record.more_inputs[i]; };
        add_levels(all, known(further), asked(further), fmt::format("input {}", i + 2), 0.0);
    }
    add_levels(all, known_output, asked_output, "output", audit(train).noise);
    add_frequencies(all, train, validate);
    return all;
}

std::vector<Record> counted_stretches(const std::vector<Record>& records,
                                      const std::vector<std::vector<char>>& counts) {
    constexpr std::size_t least = 32;
    std::vector<Record> stretches;
    for (std::size_t r = 0; r < records.size(); ++r) {
        const Record& record = records[r];
        for (std::size_t from = 0; from < record.size();) {
            std::size_t to = from;
            while (to < record.size() && counts[r][to] != 0) {
                ++to;
            }
            if (to - from >= least) {
                const auto part = [&](const std::vector<double>& values) {
                    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(from),
                                               values.begin() + static_cast<std::ptrdiff_t>(to));
                };
                Record& stretch = stretches.emplace_back();
                stretch.name = record.name;
                stretch.time_s = part(record.time_s);
                stretch.input = part(record.input);
                stretch.output = part(record.output);
                for (const std::vector<double>& levels : record.more_inputs) {
                    stretch.more_inputs.push_back(part(levels));
                }
                stretch.usual_interval_s = record.usual_interval_s;
            }
            from = std::max(to, from + 1);
        }
    }
    return stretches;
}

}  // namespace gap
