#include "gap/drive/audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/statistics/linear_regression.hpp>
#include <cmath>
#include <utility>

#include "gap/drive/base/signs.hpp"
#include "gap/drive/clipped.hpp"
#include "gap/drive/ends.hpp"
#include "gap/drive/white_noise.hpp"

namespace gap {
namespace {

double span_of(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
}

// The power of ten whose multiples all readings are, to the seven digits of single precision; 0 where they have more
// than six behind the point.
double last_digit_of(const std::vector<Record>& records) {
    for (const double digit : {1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        const bool all = std::all_of(records.begin(), records.end(), [&](const Record& record) {
            return std::all_of(record.output.begin(), record.output.end(), [&](double value) {
                const double number = value / digit;
                return std::fabs(number - std::round(number)) < std::min(1e-6 * (1.0 + std::fabs(number)), 0.01);
            });
        });
        if (all) {
            return digit;
        }
    }
    return 0.0;
}

// The step by whose multiples readings differ. A logger's last digit may round them: 0.3223 K is 0.32 or 0.33 there.
double quantum_of(const std::vector<Record>& records) {
    std::vector<double> sizes;
    std::vector<double> levels;
    double span = 0.0;
    for (const Record& record : records) {
        span = std::max(span, span_of(record.output));
        levels.insert(levels.end(), record.output.begin(), record.output.end());
        for (std::size_t i = 1; i < record.size(); ++i) {
            const double by = std::fabs(record.output[i] - record.output[i - 1]);
            if (by > 0.0) {
                sizes.push_back(by);
            }
        }
    }
    if (sizes.empty()) {
        return 0.0;
    }
    const double least = *std::min_element(sizes.begin(), sizes.end());
    if (least < 1e-5 * span) {
        return 0.0;  // the digits of the file
    }
    const double last_digit = last_digit_of(records);
    const double rounded = last_digit < 0.1 * least ? last_digit : 0.0;
    double along = 0.0;
    double square = 0.0;
    double far = 0.0;
    for (const double size : sizes) {
        const double multiple = std::round(size / least);
        along += size * multiple;
        square += multiple * multiple;
        far += std::fabs(size / least - multiple) > 0.02 * multiple + rounded / least ? 1.0 : 0.0;
    }
    if (far > 0.01 * static_cast<double>(sizes.size())) {
        return 0.0;
    }
    // The readings lie on a lattice, wherever its origin is: 0 K is on none of a sensor's that counts from 0 degrees.
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    const double step = along / square;
    std::vector<double> numbers{0.0};
    for (std::size_t i = 1; i < levels.size(); ++i) {
        numbers.push_back(numbers.back() + std::round((levels[i] - levels[i - 1]) / step));
    }
    const auto [origin, quantum] = boost::math::statistics::simple_ordinary_least_squares(numbers, levels);
    std::ptrdiff_t off = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        off += std::fabs(levels[i] - origin - quantum * numbers[i]) > 0.1 * quantum + rounded ? 1 : 0;
    }
    return 100 * off > static_cast<std::ptrdiff_t>(levels.size()) ? 0.0 : quantum;
}

// Readings that repeat the one before although their neighbours move.
double held_share_of(const std::vector<Record>& records, double quantum) {
    constexpr std::size_t near = 8;
    double held = 0.0;
    double count = 0.0;
    for (const Record& record : records) {
        const std::vector<double>& z = record.output;
        const auto [low, high] = std::minmax_element(z.begin(), z.end());
        count += static_cast<double>(z.size());
        // By stretches of readings that are the same.
        for (std::size_t from = 0; from < z.size();) {
            std::size_t to = from + 1;
            while (to < z.size() && z[to] == z[from]) {
                ++to;
            }
            const bool within = z[from] != *low && z[from] != *high && from >= near && to + near <= z.size();
            // Before and after the stretch every sample moved by more than a quantum makes.
            bool moves = within && std::fabs(z[to] - z[from]) > 2.5 * quantum;
            for (std::size_t k = 1; k < near / 2; ++k) {
                moves = moves && std::fabs(z[from - k] - z[from + 1 - k]) > 0.0 &&
                        (quantum > 0.0 || std::fabs(z[to + k] - z[to + k - 1]) > 0.0);
            }
            held += moves ? static_cast<double>(to - from - 1) : 0.0;
            from = to;
        }
    }
    return held > 0.002 * count ? held / count : 0.0;
}

// From differences of an order.
double noise_of_differences(const std::vector<Record>& records, double quantum, std::size_t order) {
    std::vector<double> sizes;
    for (const Record& record : records) {
        std::vector<double> differences = record.output;
        for (std::size_t taken = 0; taken < order; ++taken) {
            for (std::size_t i = differences.size(); i-- > 1;) {
                differences[i] -= differences[i - 1];
            }
        }
        const std::vector<double>& z = record.output;
        for (std::size_t i = order; i < record.size(); ++i) {
            // Where no step rounds them, readings that stay the same are held or at a stop: they show no noise, and
            // there is some.
            if (quantum > 0.0 || z[i] != z[i - 1] || z[i - 1] != z[i - 2]) {
                sizes.push_back(std::fabs(differences[i]));
            }
        }
    }
    return noise_by_differences(std::move(sizes), order);
}

// Of a drive that is sampled some ten times a period, second differences are the swing's: 0.19 of it at nine samples.
// Of the eighth order they are 0.0004 of it, and of white noise they tell the same. So where those tell much less, that
// is the noise.
double noise_of(const std::vector<Record>& records, double quantum) {
    const double second = noise_of_differences(records, quantum, 2);
    const double eighth = noise_of_differences(records, quantum, 8);
    constexpr double much_less = 0.5;
    return eighth > 0.0 && eighth < much_less * second ? eighth : second;
}

// At most 100: each is further than a fiftieth from the others.
std::size_t levels_of(const std::vector<Record>& records) {
    double largest = 0.0;
    for (const Record& record : records) {
        for (const double u : record.input) {
            largest = std::max(largest, std::fabs(u));
        }
    }
    std::vector<double> seen;
    for (const Record& record : records) {
        for (const double u : record.input) {
            if (std::none_of(seen.begin(), seen.end(),
                             [&](double other) { return std::fabs(other - u) <= 0.02 * largest; })) {
                seen.push_back(u);
            }
        }
    }
    return seen.size();
}

}  // namespace

Audit audit(const std::vector<Record>& records) {
    Audit found;
    found.quantum = quantum_of(records);
    found.held_share = held_share_of(records, found.quantum);
    found.noise = std::max(noise_of(records, found.quantum), 0.29 * found.quantum);
    found.levels = levels_of(records);
    found.may_clip = std::any_of(records.begin(), records.end(), [](const Record& record) {
        const std::vector<char> clipped = clipped_readings(record);
        return !ends_would_show(record) || std::find(clipped.begin(), clipped.end(), 1) != clipped.end();
    });
    if (found.quantum > 0.0) {
        found.notes.push_back(fmt::format("readings are multiples of {:.6g}", found.quantum));
    }
    if (found.held_share > 0.0) {
        found.notes.push_back(fmt::format("{:.1f} % of the readings repeat the one before while the output moves",
                                          100.0 * found.held_share));
    }
    if (may_have_lost_signs(records)) {
        found.notes.push_back("no reading is below 0 while the input has both signs: does the sensor lose the sign?");
    }
    for (const Record& record : records) {
        const double longest = [&] {
            double most = 0.0;
            for (std::size_t i = 1; i < record.size(); ++i) {
                most = std::max(most, record.time_s[i] - record.time_s[i - 1]);
            }
            return most;
        }();
        if (longest > 5.0 * record.usual_interval_s) {
            found.notes.push_back(fmt::format("{}: a gap of {:.4g} s between stamps, usually {:.4g} s", record.name,
                                              longest, record.usual_interval_s));
        }
        const std::vector<char> ends = readings_at_an_end(record);
        if (const auto stay = std::count(ends.begin(), ends.end(), 1); stay > 0) {
            found.notes.push_back(fmt::format(
                "{}: {} readings stay where they are while the input goes further: an end?", record.name, stay));
        }
        const std::vector<char> clipped = clipped_readings(record);
        if (const auto held = std::count(clipped.begin(), clipped.end(), 1); held > 0) {
            found.notes.push_back(fmt::format("{}: {} readings are held at {:.6g}, the highest: clipped?", record.name,
                                              held, *std::max_element(record.output.begin(), record.output.end())));
        }
    }
    return found;
}

}  // namespace gap
