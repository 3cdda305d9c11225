// Coulomb friction with another force up than down; where the output may be a speed, in a variant, above 0 than below.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& direction_dependent_friction();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    std::vector<double> up;
    std::vector<double> down;
    std::vector<double> of_speed;
    for (const double variant : scales.maybe_speed ? std::vector{0.0, 1.0} : std::vector{0.0}) {
        for (const auto& [share_up, share_down] : {std::pair(0.02, 0.1), std::pair(0.1, 0.02), std::pair(0.1, 0.15)}) {
            up.push_back(share_up * scales.force);
            down.push_back(share_down * scales.force);
            of_speed.push_back(variant);
        }
    }
    return {{"force_up", "rhs", 0.0, 0.7 * scales.force, 0.0, up},
            {"force_down", "rhs", 0.0, 0.7 * scales.force, 0.0, down},
            {"of_speed", "1", 0.0, 1.0, 0.0, of_speed, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.forces.friction_up += values[0];
    scenario.forces.friction_down += values[1];
    scenario.forces.friction_of_speed = values[2] > 0.5;
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
        .numbers = {{"force_up"}, {"force_down"}, {"of_speed", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical},
    };
    return effect;
}

}  // namespace gap
