// What rounding costs a sum over a window: of each term what its technique says.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/error_bound.hpp"
#include "glsum/sum.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// Roundings that the term of a_j passes: as the kernel says, else as its technique does.
template <class K>
[[nodiscard]] constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
    if constexpr (requires { K::sum_roundings(j, taps); }) {
        return K::sum_roundings(j, taps);
    } else {
        return K::TechniquePart::template sum_roundings<typename K::FormatPart>(j, taps);
    }
}

/// Floating point: of a window of the design's taps, each term of which passes so many further additions.
template <class K>
[[nodiscard]] double window_error_bound(const Design& design, double peak, std::size_t further = 0) {
    using Format = typename K::FormatPart;
    using Technique = typename K::TechniquePart;
    // (1 + data)^(coefficients + input) (1 + sum)^operations (1 + output) - 1
    const auto growth = [&](std::size_t j) {
        const auto data = static_cast<double>(Technique::coefficient_roundings(j) + 1);
        const auto sum = static_cast<double>(sum_roundings<K>(j, design.taps) + further);
        return std::expm1(data * std::log1p(Format::data_roundoff) + sum * std::log1p(Format::sum_roundoff) +
                          std::log1p(Format::output_roundoff));
    };
    double bound = growth(0);
    Weights weights(design);
    for (std::size_t j = 1; j < design.taps; ++j) {
        weights.next();
        bound += growth(j) * std::fabs(weights.weight());
    }
    // Products below the smallest normal number lose half of the smallest denormal one.
    constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
    return peak * bound + static_cast<double>(design.taps) * denormal;
}

/// Of every history whose family has no answer of its own.
template <class History, class Technique, class Format>
struct ErrorBound<Sum<History, Technique, Format>> {
    using K = Sum<History, Technique, Format>;

    static double of(const Design& design, const typename K::State& state, double peak, std::size_t) {
        if constexpr (Format::fixed_point) {
            return Technique::template fixed_error<Format>(design, state.scale, peak) +
                   std::ldexp(absolute_sum(design, design.taps), -Format::sample_bits - 1) +
                   std::ldexp(1.0, state.scale.output_exponent - 32);
        } else {
            return window_error_bound<K>(design, peak);
        }
    }
};

}  // namespace glsum
