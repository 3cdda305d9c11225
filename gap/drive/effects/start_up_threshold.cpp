// w = 0 until u passes the threshold for the first time, then u: an actuator that must start.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& start_up_threshold();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"threshold",
             "u",
             0.0,
             0.95 * scales.input_max,
             0.0,
             {0.15 * scales.input_max, 0.35 * scales.input_max, 0.6 * scales.input_max}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.input.emplace_back([threshold = values[0]](std::span<double> held, const Grid&) {
        bool started = false;
        for (double& u : held) {
            started = started || std::fabs(u) > threshold;
            u = started ? u : 0.0;
        }
    });
}

}  // namespace

const Effect& start_up_threshold() {
    static const Effect effect{"start_up_threshold", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
