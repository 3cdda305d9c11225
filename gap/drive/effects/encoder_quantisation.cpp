// The reading is a multiple of a step.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& encoder_quantisation();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"step", "y", 0.0, 0.3 * scales.output_span, 0.0, {0.02 * scales.output_span}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.logger.emplace_back([step = values[0]](std::span<double> reading, const Record&) {
        if (!(step > 0.0)) {
            return;
        }
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
