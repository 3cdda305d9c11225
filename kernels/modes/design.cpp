#include "modes/design.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glsum/weights.hpp"
#include "modes/projection.hpp"

namespace glsum::modes {
namespace {

// a_0 ... a_N.
std::vector<double> weights_to(double order, std::size_t horizon) {
    std::vector<double> weights = {1.0};
    weights.reserve(horizon + 1);
    for (Weights walk(order); weights.size() <= horizon;) {
        walk.next();
        weights.push_back(walk.weight());
    }
    return weights;
}

Projection projection_of(const Target& target, std::size_t near_taps) {
    return {tail_nodes(target.order, near_taps, target.horizon, target.error), target.horizon};
}

std::vector<Mode> signed_modes(const Target& target, const Projection& projection, std::size_t count) {
    std::vector<Mode> modes = projection.modes(count);
    const double sign = std::sin(std::numbers::pi * target.order) > 0.0 ? -1.0 : 1.0;
    for (Mode& mode : modes) {
        mode.weight *= sign;
    }
    return modes;
}

}  // namespace

Approximation approximate(const Target& target, std::size_t near_taps, std::size_t modes) {
    const Projection projection = projection_of(target, near_taps);
    std::vector<Mode> found = signed_modes(target, projection, std::min(modes, projection.size()));
    const double error = error_of(weights_to(target.order, target.horizon), near_taps, found, INFINITY);
    return {near_taps, std::move(found), error};
}

std::optional<Approximation> design(const Target& target) {
    constexpr std::size_t most_modes = 40;
    constexpr std::size_t most_taps = 64;
    const std::vector<double> weights = weights_to(target.order, target.horizon);
    std::optional<Approximation> best;
    for (std::size_t near = least_near_taps(target.order); near <= most_taps; near += near < 8 ? 1 : 8) {
        if (best && near >= best->cost()) {
            break;
        }
        const Projection projection = projection_of(target, near);
        for (std::size_t count = 0; count <= std::min(most_modes, projection.size()); ++count) {
            if (best && near + 2 * count >= best->cost()) {
                break;
            }
            // The exact error was never seen below a third of this estimate; without a mode it is cheap.
            if (count > 0 && projection.dropped(count) > 3.0 * target.error) {
                continue;
            }
            std::vector<Mode> modes = signed_modes(target, projection, count);
            const double error = error_of(weights, near, modes, target.error);
            if (error <= target.error) {
                best = Approximation{near, std::move(modes), error};
            }
        }
    }
    return best;
}

}  // namespace glsum::modes
