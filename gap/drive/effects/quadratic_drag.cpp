// A force k y' |y'|.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& quadratic_drag();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"coefficient",
             "rhs s^2/y^2",
             0.0,
             5.0 * scales.force / (scales.speed_max * scales.speed_max),
             0.0,
             {0.1 * scales.force / (scales.speed_max * scales.speed_max),
              0.6 * scales.force / (scales.speed_max * scales.speed_max)}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.forces.drag += values[0];
}

}  // namespace

const Effect& quadratic_drag() {
    static const Effect effect{
        .name = "quadratic_drag",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"coefficient"}},
        .domains = {Domain::mechanical, Domain::hydraulic},
    };
    return effect;
}

}  // namespace gap
