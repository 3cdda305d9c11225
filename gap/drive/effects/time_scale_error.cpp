// Every coefficient of order a times c^a: the same motion, c times slower.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& time_scale_error();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"scale", "1", 0.2, 5.0, 1.0, {0.8, 1.25}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    for (auto* terms : {&scenario.model.numerator, &scenario.model.denominator}) {
        for (drive::Term& term : *terms) {
            term.coefficient *= std::pow(values[0], term.order);
        }
    }
}

}  // namespace

const Effect& time_scale_error() {
    static const Effect effect{
        .name = "time_scale_error",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"scale"}},
        .of_fitted_base = true,
        .linear = true,
    };
    return effect;
}

}  // namespace gap
