// w = min(u, limit), and the same below 0.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& input_saturation();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"limit",
             "u",
             0.05 * scales.input_max,
             1.0 * scales.input_max,
             scales.input_max,
             {0.5 * scales.input_max, 0.8 * scales.input_max}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.levels.emplace_back([limit = values[0]](std::span<double> levels) {
        for (double& u : levels) {
            u = std::clamp(u, -limit, limit);
        }
    });
}

}  // namespace

const Effect& input_saturation() {
    static const Effect effect{
        .name = "input_saturation",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"limit"}},
        .hides_base = true,
    };
    return effect;
}

}  // namespace gap
