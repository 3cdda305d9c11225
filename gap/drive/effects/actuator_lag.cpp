// A first-order lag from u to w, exact for a held input.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& actuator_lag();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"tau_s",
             "s",
             0.0,
             3.0 * scales.time_constant_s,
             0.0,
             {0.1 * scales.time_constant_s, 0.4 * scales.time_constant_s}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.input.emplace_back([tau_s = values[0]](std::span<double> held, const Grid& grid) {
        if (!(tau_s > 0.0)) {
            return;
        }
        const double intervals = grid.step_s / tau_s;
        const double left = std::exp(-intervals);
        const double mean_left = -std::expm1(-intervals) / intervals;
        double w = 0.0;
        for (double& u : held) {
            const double mean = u + (w - u) * mean_left;
            w = u + (w - u) * left;
            u = mean;
        }
    });
}

}  // namespace

const Effect& actuator_lag() {
    static const Effect effect{
        .name = "actuator_lag",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"tau_s"}},
        .linear = true,
    };
    return effect;
}

}  // namespace gap
