// w = g u.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& gain_error();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"gain", "1", 0.05, 20.0, 1.0, {0.7, 1.4}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.levels.emplace_back([g = values[0]](std::span<double> levels) {
        for (double& u : levels) {
            u *= g;
        }
    });
}

}  // namespace

const Effect& gain_error() {
    static const Effect effect{
        .name = "gain_error",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"gain"}},
        .of_fitted_base = true,
        .linear = true,
    };
    return effect;
}

}  // namespace gap
