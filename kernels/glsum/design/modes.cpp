#include "glsum/design/modes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "glsum/design/projection.hpp"

namespace glsum::design {
namespace {

// How fine the trapezoid is, below every error that is designed for. It then has more than `most_modes` nodes, whatever
// the horizon.
constexpr double mixture_error = 1e-10;

Projection projection_of(const Tail& tail, std::size_t near_taps) {
    return {tail_nodes(tail.order, near_taps, tail.horizon, mixture_error), tail.horizon};
}

std::vector<Mode> signed_modes(double order, const Projection& projection, std::size_t count) {
    std::vector<Mode> modes = projection.modes(count);
    const double sign = std::sin(std::numbers::pi * order) > 0.0 ? -1.0 : 1.0;
    for (Mode& mode : modes) {
        mode.weight *= sign;
    }
    return modes;
}

}  // namespace

bool has_tail(double order) { return order > -1.0 && order != std::floor(order); }

std::size_t modes_within(double order, std::size_t taps) {
    if (!has_tail(order) || taps < least_near_taps(order)) {
        return 0;
    }
    return std::min((taps - least_near_taps(order)) / 2, most_modes);
}

std::size_t most_taps(double order) { return least_near_taps(order) + 1 + 2 * most_modes; }

Approximation approximate(const Tail& tail, std::size_t near_taps, std::size_t modes) {
    std::vector<Mode> found;
    if (modes > 0) {
        const Projection projection = projection_of(tail, near_taps);
        found = signed_modes(tail.order, projection, std::min(modes, projection.size()));
    }
    const double error = error_of(weights_to(tail.order, tail.horizon), near_taps, found, INFINITY);
    return {near_taps, std::move(found), error};
}

std::optional<Approximation> design_modes(const Tail& tail, double error) {
    const std::vector<double> weights = weights_to(tail.order, tail.horizon);
    std::map<std::size_t, Projection> projections;  // by near taps: two at most
    for (std::size_t taps = 1; taps <= most_taps(tail.order); ++taps) {
        const std::size_t count = modes_within(tail.order, taps);
        const std::size_t near_taps = taps - 2 * count;
        std::vector<Mode> modes;
        if (count > 0) {
            auto found = projections.find(near_taps);
            if (found == projections.end()) {
                found = projections.emplace(near_taps, projection_of(tail, near_taps)).first;
            }
            const Projection& projection = found->second;
            // The exact error was never seen below a third of this estimate.
            if (count > projection.size() || projection.dropped(count) > 3.0 * error) {
                continue;
            }
            modes = signed_modes(tail.order, projection, count);
        }
        const double found = error_of(weights, near_taps, modes, error);
        if (found <= error) {
            return Approximation{near_taps, std::move(modes), found};
        }
    }
    return std::nullopt;
}

}  // namespace glsum::design
