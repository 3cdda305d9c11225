// A constant force against motion, and none moves that is not overcome. Where the output may be a speed, a variant acts
// against the output itself, which then stands at 0.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& coulomb_friction();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    const std::vector<double> starts = {0.02 * scales.force, 0.1 * scales.force};
    const EffectParameter force{"force", "rhs", 0.0, 0.7 * scales.force, 0.0, starts};
    if (!scales.maybe_speed) {
        return {force, {"of_speed", "1", 0.0, 1.0, 0.0, {0.0}, true}};
    }
    return {{"force", "rhs", 0.0, 0.7 * scales.force, 0.0, {starts[0], starts[1], starts[0], starts[1]}},
            {"of_speed", "1", 0.0, 1.0, 0.0, {0.0, 0.0, 1.0, 1.0}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.forces.friction_up += values[0];
    scenario.forces.friction_down += values[0];
    scenario.forces.friction_of_speed = values[1] > 0.5;
}

}  // namespace

const Effect& coulomb_friction() {
    static const Effect effect{
        .name = "coulomb_friction",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"force"}, {"of_speed", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical},
    };
    return effect;
}

}  // namespace gap
