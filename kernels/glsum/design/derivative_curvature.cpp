#include "glsum/design/derivative_curvature.hpp"

#include <algorithm>
#include <cmath>

namespace glsum::design {

Curvature::Curvature(const Filter& filter, const DerivativeGoal& goal) : filter_(filter), goal_(goal) {
    for (std::size_t j = 1; j < filter.taps.size(); ++j) {
        of_taps_ += static_cast<double>(j) * static_cast<double>(j) * std::fabs(filter.taps[j]);
    }
}

double Curvature::bound(double low, double high) const {
    const double v = goal_.order;
    double sum = of_taps_ + std::fabs(v * (v - 1.0)) * std::pow(goal_.step_s, -v) *
                                std::max(std::pow(low, v - 2.0), std::pow(high, v - 2.0));
    const auto near = static_cast<double>(filter_.taps.size());
    for (const Mode& mode : filter_.modes) {
        // f = z^-K / g, g = 1 - s r z^-1 of the sign s: |g'| = |g''| = r, and |g| rises with the angle, of a mode whose
        // weights change their sign it falls.
        const double r = std::fabs(1.0 - mode.decay);
        const double turned = mode.decay > 1.0 ? std::cos(0.5 * high) : std::sin(0.5 * low);
        const double g = std::hypot(1.0 - r, 2.0 * std::sqrt(r) * turned);
        sum +=
            std::fabs(mode.weight) * (near * near / g + (2.0 * near + 1.0) * r / (g * g) + 2.0 * r * r / (g * g * g));
    }
    return sum;
}

}  // namespace glsum::design
