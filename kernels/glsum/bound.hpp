// The error bound that a kernel promises, from its parts: the number that its test enforces.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "glsum/kernel.hpp"
#include "glsum/modes_bound.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// Bound of |S - exact|, where exact is the sum of the same length with exact coefficients over the real-valued
/// input, |x| <= peak (in fixed point also peak < 1), so that the rounding of the input counts too.
/// With modes the exact sum is that of the design's own taps and exponentials.
/// Derivation: modes_bound.hpp, and the headers of the technique (floating point) and of format/fixed.hpp. Absolute,
/// before h^-v.
template <class K>
[[nodiscard]] double error_bound(const Design& design, const typename K::State& state, double peak) {
    using Format = typename K::FormatPart;
    using Technique = typename K::TechniquePart;
    if constexpr (std::is_same_v<typename K::HistoryPart, Modes>) {
        return modes_error_bound<K>(design, state, peak);
    } else if constexpr (Format::fixed_point) {
        return Technique::template fixed_error<Format>(design, state.scale, peak) +
               std::ldexp(absolute_sum(design, design.taps), -Format::sample_bits - 1) +
               std::ldexp(1.0, state.scale.output_exponent - 32);
    } else {
        // (1 + data)^(coefficients + input) (1 + sum)^operations (1 + output) - 1
        const auto growth = [&](std::size_t j) {
            const auto data = static_cast<double>(Technique::coefficient_roundings(j) + 1);
            const auto sum = static_cast<double>(Technique::template sum_roundings<Format>(j, design.taps));
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
}

}  // namespace glsum
