// The reading is a multiple of a step, which the audit of the readings finds.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& encoder_quantisation();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.quantum > 0.0)) {
        return {};
    }
    return {{"step", "y", scales.quantum, scales.quantum, 0.0, {scales.quantum}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.logger.emplace_back([step = values[0]](std::span<double> reading, const Record&) {
        for (double& value : reading) {
            value = step * std::nearbyint(value / step);
        }
    });
}

}  // namespace

const Effect& encoder_quantisation() {
    static const Effect effect{"encoder_quantisation", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
