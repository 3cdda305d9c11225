// The restoring term a_0 y becomes a_0 sin(kappa y) / kappa.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& gravity_nonlinearity();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"angle_per_unit",
             "rad/y",
             1e-3 / scales.output_span,
             1.5 / std::max(std::fabs(scales.output_high), std::fabs(scales.output_low)),
             1e-3 / scales.output_span,
             {0.5 / std::max(std::fabs(scales.output_high), std::fabs(scales.output_low)),
              1.0 / std::max(std::fabs(scales.output_high), std::fabs(scales.output_low))}}};
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
