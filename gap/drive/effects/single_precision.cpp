// The simulation that ran did so in float32: newest first or oldest first, on values or on increments.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& single_precision();

namespace {

constexpr const char* kernels[] = {"ring_plain_f32", "ring_oldest_f32"};

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.deployed_step_s > 0.0)) {
        return {};
    }
    return {{"oldest_first", "1", 0.0, 1.0, 0.0, {0.0, 1.0, 0.0, 1.0}, true},
            {"increments", "1", 0.0, 1.0, 0.0, {0.0, 0.0, 1.0, 1.0}, true},
            {"step_s", "s", 0.0, 1e6, 0.0, {scales.deployed_step_s}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.deployed = Deployed{values[2], 0.0, kernels[values[0] > 0.5 ? 1 : 0], values[1] > 0.5};
}

}  // namespace

const Effect& single_precision() {
    static const Effect effect{
        .name = "single_precision",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::deployed,
        .numbers = {{"oldest_first", Number::Given::otherwise, 0.0},
                    {"increments", Number::Given::otherwise, 0.0},
                    {"step_s", Number::Given::otherwise, 0.0}},
        .of_fitted_base = true,
    };
    return effect;
}

}  // namespace gap
