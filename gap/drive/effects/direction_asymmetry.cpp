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

// A lag over one step, y taken as straight between nodes: exact as long as it does not change on the way.
class Lag {
public:
    Lag(double tau_s, double step_s) : at_once_(!(tau_s > 0.0)) {
        const double intervals = at_once_ ? 1.0 : step_s / tau_s;
        left_ = std::exp(-intervals);
        ramp_ = -std::expm1(-intervals) / intervals;
    }
    [[nodiscard]] double after_a_step(double at, double before, double y) const {
        return at_once_ ? y : at * left_ + y * (1.0 - ramp_) + before * (ramp_ - left_);
    }

private:
    bool at_once_;
    double left_;
    double ramp_;
};

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.output.emplace_back(
        [tau_up_s = values[0], tau_down_s = values[1]](std::span<double> z, const Motion& motion) {
            const Lag up(tau_up_s, motion.grid.step_s);
            const Lag down(tau_down_s, motion.grid.step_s);
            double at = z.empty() ? 0.0 : z[0];
            double before = at;
            for (double& value : z) {
                const double y = value;
                at = (y > at ? up : down).after_a_step(at, before, y);
                before = y;
                value = at;
            }
        });
}

std::string linear_with(std::span<const Fitted> fitted, [[maybe_unused]] const Scales& scales) {
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
