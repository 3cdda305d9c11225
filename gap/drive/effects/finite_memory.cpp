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
    static const Effect effect{"finite_memory", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
