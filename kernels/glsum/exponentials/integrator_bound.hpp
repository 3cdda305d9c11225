// What rounding costs a kernel with an integrator, with u the roundoff of its data, P the peak and N the samples of the
// record: what it costs the inner sum, and of the term w_0 r, |r| <= N P:
//   input   u, coefficient u, product u, the addition of the loss u, that to the inner sum u
//   r       two_sum is exact, and the loss l <= N u N P loses u l at each addition: N u u N P N at most, relative to
//           N P that is (N u)^2
// The last addition rounds the inner sum, too: u of all its magnitudes.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/error_bound.hpp"
#include "glsum/exponentials/integrator_sum.hpp"
#include "glsum/wrap/delta_bound.hpp"

namespace glsum {

template <class Technique, class Format>
struct ErrorBound<Sum<Integrator, Technique, Format>> {
    using K = Sum<Integrator, Technique, Format>;

    static double of(const Design& design, const typename K::State& state, double peak, std::size_t samples) {
        constexpr double u = Format::data_roundoff;
        const Design inner = K::inner_design(design);
        const double weight = design.modes.empty() ? 0.0 : std::fabs(design.modes.front().weight);
        const auto count = static_cast<double>(samples);
        const double once = std::expm1(5.0 * std::log1p(u)) + (count * u) * (count * u);
        constexpr double denormal = std::numeric_limits<typename K::Sample>::denorm_min();
        return (1.0 + u) * error_bound<typename K::Inner>(inner, state, peak, samples) +
               u * peak * absolute_sum_with_modes(inner) + weight * count * (peak * once + denormal);
    }
};

}  // namespace glsum
