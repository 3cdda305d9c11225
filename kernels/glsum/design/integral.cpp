#include "glsum/design/integral.hpp"

#include <algorithm>
#include <cmath>

#include "glsum/design/fitted.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/design/projection.hpp"

namespace glsum::design {
namespace {

// What the poles are chosen by: below every error that is designed for.
constexpr double mixture_error = 1e-10;

Projection poles_of(double order, std::size_t near_taps, std::size_t horizon) {
    return {tail_nodes(order, near_taps, horizon, mixture_error), horizon};
}

// Poles chosen with the running sum among the free ones would be as good, but its weight then has either sign: an
// integral that runs backward beyond the horizon. In the place of the slowest it comes out near a_N.
Approximation fitted(const Projection& poles, const std::vector<double>& weights, std::size_t near_taps,
                     std::size_t modes) {
    Approximation found{near_taps, poles.modes(std::min(modes, poles.size())), 0.0};
    found.modes.front().decay = 0.0;
    fit_weights(found.modes, weights, near_taps);
    found.error = error_of(weights, near_taps, found.modes, INFINITY);
    return found;
}

// At v = -1 every weight is 1, and those of higher order come near to that.
Approximation running_sum(const std::vector<double>& weights, std::size_t near_taps) {
    Approximation found{near_taps, {{0.0, weights.back()}}, 0.0};
    found.error = error_of(weights, near_taps, found.modes, INFINITY);
    return found;
}

}  // namespace

bool is_integral(double order) { return order >= -1.0 && order < 0.0; }

std::size_t integral_modes_within(double order, std::size_t taps) {
    return order == -1.0 ? (taps >= 3 ? 1 : 0) : is_integral(order) ? modes_within(order, taps) : 0;
}

Approximation approximate_integral(const std::vector<double>& weights, double order, std::size_t near_taps,
                                   std::size_t modes) {
    return order == -1.0 || near_taps + 2 >= weights.size()
               ? running_sum(weights, std::min(near_taps, weights.size() - 1))
               : fitted(poles_of(order, near_taps, weights.size() - 1), weights, near_taps, modes);
}

std::optional<Approximation> design_integral(const std::vector<double>& weights, double order, double error) {
    if (order == -1.0) {
        for (std::size_t near_taps = 1; near_taps < weights.size(); ++near_taps) {
            if (Approximation found = running_sum(weights, near_taps); found.error <= error) {
                return found;
            }
        }
        return std::nullopt;
    }
    for (const std::size_t near_taps : {least_near_taps(order), least_near_taps(order) + 1}) {
        const Projection poles = poles_of(order, near_taps, weights.size() - 1);
        for (std::size_t modes = 1; modes <= std::min(most_modes, poles.size()); ++modes) {
            if (Approximation found = fitted(poles, weights, near_taps, modes); found.error <= error) {
                return found;
            }
        }
    }
    return std::nullopt;
}

}  // namespace glsum::design
