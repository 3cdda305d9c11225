// What rounding costs a kernel of increments: what it costs the inner sum, of order v - 1 over increments up to 2 P,
// and what the increments themselves lose. With A = sum |b_j| of the inner sum's own weights, modes included:
//   floating point   x_k and x_(k-1) rounded (u P each) and their difference (2 u P): 4 u P A, or denormals' halves
//   fixed point      all at half scale: both samples rounded to half a unit of 2^-n, 2^-n A; the difference is exact.
//                    The whole is doubled with the output
//   order            v - 1 is exact for v >= 0.5; below, rounded to double, it moves b_j by 2^-53 (1 + ln L) of itself
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/error_bound.hpp"
#include "glsum/weights.hpp"
#include "glsum/wrap/delta_sum.hpp"

namespace glsum {

/// A: by it the sum can exceed the largest increment.
[[nodiscard]] inline double absolute_sum_with_modes(const Design& design) {
    double sum = absolute_sum(design, design.taps - 2 * design.modes.size());
    for (const Mode& mode : design.modes) {
        sum += std::fabs(mode.weight) / forgets(mode.decay);
    }
    return sum;
}

template <class Kept, class Technique, class Format>
struct ErrorBound<Sum<Delta<Kept>, Technique, Format>> {
    using K = Sum<Delta<Kept>, Technique, Format>;

    static double of(const Design& design, const typename K::State& state, double peak, std::size_t samples) {
        const Design inner = K::inner_design(design);
        const double absolute = absolute_sum_with_modes(inner);
        const double of_order =
            design.order < 0.5 ? 0x1p-53 * (1.0 + std::log(static_cast<double>(design.taps))) * absolute : 0.0;
        const auto of_inner = [&](double largest) {
            return error_bound<typename K::Inner>(inner, state, largest, samples);
        };
        if constexpr (Format::fixed_point) {
            const double unit = std::ldexp(1.0, -Format::sample_bits);
            return 2.0 * (of_inner(peak + unit) + unit * absolute + of_order * peak);
        } else {
            constexpr double u = Format::data_roundoff;
            constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
            const double increment = 2.0 * peak * (1.0 + 4.0 * u);
            return of_inner(increment) + (2.0 * u * increment + denormal) * absolute + of_order * increment;
        }
    }
};

}  // namespace glsum
