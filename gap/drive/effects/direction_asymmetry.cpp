// z follows y with another lag up than down.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& direction_asymmetry();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    // What is driven up and left down may differ; what swings by itself has no such ways.
    if (!scales.driven) {
        return {};
    }
    return {{"tau_up_s",
             "s",
             0.0,
             3.0 * scales.time_constant_s,
             0.0,
             {0.2 * scales.time_constant_s, 0.01 * scales.time_constant_s}},
            {"tau_down_s",
             "s",
             0.0,
             3.0 * scales.time_constant_s,
             0.0,
             {0.01 * scales.time_constant_s, 0.2 * scales.time_constant_s}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.output.emplace_back([up = values[0], down = values[1]](std::span<double> z, const Motion& motion) {
        double at = z.empty() ? 0.0 : z[0];
        double before = at;
        for (double& value : z) {
            // y taken as straight between nodes: exact for a lag that does not change on the way.
            const double tau = value > at ? up : down;
            const double y = value;
            if (tau > 0.0) {
                const double intervals = motion.grid.step_s / tau;
                const double left = std::exp(-intervals);
                const double ramp = -std::expm1(-intervals) / intervals;
                at = at * left + y * (1.0 - ramp) + before * (ramp - left);
            } else {
                at = y;
            }
            before = y;
            value = at;
        }
    });
}

std::string linear_with(std::span<const Fitted> fitted) {
    const Fitted& up = fitted[0];
    const Fitted& down = fitted[1];
    return up.low <= down.high && down.low <= up.high ? "its lags up and down may be the same" : "";
}

}  // namespace

const Effect& direction_asymmetry() {
    static const Effect effect{
        .name = "direction_asymmetry",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .generalises = {"sensor_lag", "actuator_lag"},
        .place = Place::output,
        .numbers = {{"tau_up_s"}, {"tau_down_s"}},
        .linear_with = linear_with,
    };
    return effect;
}

}  // namespace gap
