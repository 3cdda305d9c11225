// Small sums over records, and what is added to them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "drive/stand/chance.hpp"

namespace stand::blind {

/// Root of the mean square of a - b, which are as long.
[[nodiscard]] inline double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        square += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return std::sqrt(square / static_cast<double>(a.size()));
}

/// Whether `a` differs from `b` by more than noise of that deviation could hide: twice as much, as a root mean square.
[[nodiscard]] inline bool stands_out(const std::vector<double>& a, const std::vector<double>& b, double noise) {
    return rms(a, b) > 2.0 * noise;
}

/// Standard deviation.
[[nodiscard]] inline double deviation_of(const std::vector<double>& values) {
    double mean = 0.0;
    for (const double value : values) {
        mean += value / static_cast<double>(values.size());
    }
    return rms(values, std::vector<double>(values.size(), mean));
}

/// Rounded to four significant digits, as people write numbers down.
[[nodiscard]] inline double digits(double value) { return std::stod(fmt::format("{:.4g}", value)); }

/// Normal, of a first-order memory: 0 is white. \param memory  share of a sample that the next one keeps, below 1
[[nodiscard]] inline std::vector<double> make_noise(std::size_t count, double deviation, double memory,
                                                    Chance& chance) {
    std::vector<double> noise;
    double state = deviation * chance.normal();
    for (std::size_t k = 0; k < count; ++k) {
        noise.push_back(state);
        state = memory * state + deviation * std::sqrt(1.0 - memory * memory) * chance.normal();
    }
    return noise;
}

}  // namespace stand::blind
