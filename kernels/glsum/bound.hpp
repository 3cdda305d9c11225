// The error bound that a kernel promises, from its parts: the number that its test enforces.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// Bound of |S - exact|, where exact is the sum of the same length with exact coefficients over the real-valued
/// input, |x| <= peak (in fixed point also peak < 1), so that the rounding of the input counts too.
/// Derivation: the headers of the technique (floating point) and of format/fixed.hpp. Absolute, before h^-v.
template <class K>
[[nodiscard]] double error_bound(const Design& design, const typename K::State& state, double peak) {
    using Format = typename K::FormatPart;
    const double absolute = absolute_sum(design.order, design.taps);
    const auto taps = static_cast<double>(design.taps);
    if constexpr (Format::fixed_point) {
        constexpr int bits = Format::fraction_bits;
        return (taps - 1.0) * std::ldexp(peak, state.scale.table_exponent - bits - 1) +
               std::ldexp(absolute, -bits - 1) + std::ldexp(1.0, state.scale.output_exponent - 32);
    } else {
        constexpr double u = Format::unit_roundoff;
        const auto growth = [](std::size_t roundings) {
            return std::expm1(static_cast<double>(roundings) * std::log1p(u));
        };
        const auto roundings = [&](std::size_t j) {
            return K::TechniquePart::template roundings<Format>(j, design.taps) + 1;
        };
        double bound = growth(roundings(0));
        Weights weights(design.order);
        for (std::size_t j = 1; j < design.taps; ++j) {
            weights.next();
            bound += growth(roundings(j)) * std::fabs(weights.weight());
        }
        // Products below the smallest normal number lose half of the smallest denormal one.
        constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
        return peak * bound + taps * denormal;
    }
}

}  // namespace glsum
