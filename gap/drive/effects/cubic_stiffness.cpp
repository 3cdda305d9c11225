// The restoring term a_0 y becomes a_0 (y + c y^3): a spring that stiffens, or below 0 gives way.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& cubic_stiffness();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    // What drives a speed meets no spring.
    if (!scales.steady || (scales.driven && scales.maybe_speed)) {
        return {};
    }
    // Of a spring that gives way: down to where it has nearly no stiffness left.
    const double unit = 1.0 / (scales.output_max * scales.output_max);
    return {{"coefficient", "1/y^2", -0.32 * unit, 20.0 * unit, 0.0, {0.2 * unit, 2.0 * unit, -0.1 * unit}}};
}

void add(Scenario& scenario, std::span<const double> values) { scenario.forces.cubic += values[0]; }

}  // namespace

const Effect& cubic_stiffness() {
    static const Effect effect{
        .name = "cubic_stiffness",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"coefficient"}},
        .domains = {Domain::mechanical, Domain::electric},
        .smooth = true,
    };
    return effect;
}

}  // namespace gap
