// The simulation that ran forgets: each sum over so many taps.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& finite_memory();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double samples = scales.length_s / scales.deployed_step_s;
    if (!(scales.deployed_step_s > 0.0) || samples < 64.0) {
        return {};
    }
    return {{"taps", "1", 4.0, 0.8 * samples, 0.8 * samples, {0.02 * samples, 0.08 * samples, 0.3 * samples}},
            {"step_s", "s", 0.0, 1e6, 0.0, {scales.deployed_step_s}, true}};
}

void add(Scenario& scenario, std::span<const double> values) { scenario.deployed = Deployed{values[1], values[0], ""}; }

}  // namespace

const Effect& finite_memory() {
    static const Effect effect{
        .name = "finite_memory",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::deployed,
        .numbers = {{"taps"}, {"step_s", Number::Given::otherwise, 0.0}},
        .of_fitted_base = true,
    };
    return effect;
}

}  // namespace gap
