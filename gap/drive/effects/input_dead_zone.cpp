// w = u - width beyond the width, on both sides, else 0.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& input_dead_zone();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"width", "u", 0.0, 0.9 * scales.input_max, 0.0, {0.08 * scales.input_max, 0.3 * scales.input_max}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.levels.emplace_back([width = values[0]](std::span<double> levels) {
        for (double& u : levels) {
            u = u > width ? u - width : u < -width ? u + width : 0.0;
        }
    });
}

}  // namespace

const Effect& input_dead_zone() {
    static const Effect effect{
        .name = "input_dead_zone",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"width"}},
    };
    return effect;
}

}  // namespace gap
