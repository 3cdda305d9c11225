// The simulation that ran did so in fractions of 31 or 15 bits, on values or on increments.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& fixed_point();

namespace {

constexpr const char* kernels[] = {"ring_plain_q31", "ring_plain_q15"};

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.deployed_step_s > 0.0)) {
        return {};
    }
    return {{"format", "bits", 15.0, 31.0, 31.0, {31.0, 15.0, 31.0, 15.0}, true},
            {"increments", "1", 0.0, 1.0, 0.0, {0.0, 0.0, 1.0, 1.0}, true},
            {"step_s", "s", 0.0, 1e6, 0.0, {scales.deployed_step_s}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.deployed = Deployed{values[2], 0.0, kernels[values[0] > 20.0 ? 0 : 1], values[1] > 0.5};
}

}  // namespace

const Effect& fixed_point() {
    static const Effect effect{"fixed_point", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
