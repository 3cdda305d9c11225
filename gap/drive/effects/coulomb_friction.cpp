// A constant force against motion, and none moves that is not overcome.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& coulomb_friction();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"force", "rhs", 0.0, 0.7 * scales.force, 0.0, {0.02 * scales.force, 0.1 * scales.force}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.forces.friction_up += values[0];
    scenario.forces.friction_down += values[0];
}

}  // namespace

const Effect& coulomb_friction() {
    static const Effect effect{
        .name = "coulomb_friction",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"force"}},
        .domains = {Domain::mechanical},
    };
    return effect;
}

}  // namespace gap
