// The restoring term a_0 y becomes a_0 sin(kappa y) / kappa.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& gravity_nonlinearity();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    // A speed has no place where a weight would pull.
    if (!scales.steady || (scales.driven && scales.maybe_speed)) {
        return {};
    }
    // A swing of nearly half a turn, farther than which a weight does not fall back.
    const double unit = 1.0 / scales.output_max;
    return {{"angle_per_unit",
             "rad/y",
             1e-3 / scales.output_span,
             3.0 * unit,
             1e-3 / scales.output_span,
             {0.5 * unit, 1.0 * unit, 2.0 * unit}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.forces.angle_per_unit = values[0];
}

}  // namespace

const Effect& gravity_nonlinearity() {
    static const Effect effect{
        .name = "gravity_nonlinearity",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"angle_per_unit"}},
        .domains = {Domain::mechanical},
    };
    return effect;
}

}  // namespace gap
