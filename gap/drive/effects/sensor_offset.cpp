// Every reading is off by the same.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& sensor_offset();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"offset", "y", -1.0 * scales.output_span, 1.0 * scales.output_span, 0.0, {0.05 * scales.output_span}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.output.emplace_back([offset = values[0]](std::span<double> z, const Motion&) {
        for (double& value : z) {
            value += offset;
        }
    });
}

}  // namespace

const Effect& sensor_offset() {
    static const Effect effect{
        .name = "sensor_offset",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::sensor,
        .numbers = {{"offset"}},
        .of_fitted_base = true,
        .linear = true,
    };
    return effect;
}

}  // namespace gap
