// Coulomb friction with another force up than down.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& direction_dependent_friction();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"force_up",
             "rhs",
             0.0,
             0.7 * scales.force,
             0.0,
             {0.02 * scales.force, 0.1 * scales.force, 0.1 * scales.force}},
            {"force_down",
             "rhs",
             0.0,
             0.7 * scales.force,
             0.0,
             {0.1 * scales.force, 0.02 * scales.force, 0.15 * scales.force}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.forces.friction_up += values[0];
    scenario.forces.friction_down += values[1];
}

}  // namespace

const Effect& direction_dependent_friction() {
    static const Effect effect{
        .name = "direction_dependent_friction",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .generalises = {"coulomb_friction"},
        .place = Place::plant,
        .numbers = {{"force_up"}, {"force_down"}},
        .domains = {Domain::mechanical},
    };
    return effect;
}

}  // namespace gap
