// A first-order lag from y to z, exact for an output that is straight between nodes.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& sensor_lag();

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
    scenario.output.emplace_back([tau_s = values[0]](std::span<double> z, const Motion& motion) {
        if (!(tau_s > 0.0) || z.empty()) {
            return;
        }
        const double intervals = motion.grid.step_s / tau_s;
        const double left = std::exp(-intervals);
        const double ramp = -std::expm1(-intervals) / intervals;
        double at = z[0];
        double before = z[0];
        for (double& value : z) {
            const double y = value;
            at = at * left + y * (1.0 - ramp) + before * (ramp - left);
            before = y;
            value = at;
        }
    });
}

}  // namespace

const Effect& sensor_lag() {
    static const Effect effect{
        .name = "sensor_lag",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::sensor,
        .numbers = {{"tau_s"}},
        .linear = true,
    };
    return effect;
}

}  // namespace gap
