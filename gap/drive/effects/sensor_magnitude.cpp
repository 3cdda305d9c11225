// z = |y|: the sensor loses the sign.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& sensor_magnitude();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    // What is pushed one way only, and does not swing, never was below 0.
    if (scales.driven && !scales.two_signs && !scales.swings) {
        return {};
    }
    // Noise about 0 goes a little below it.
    constexpr double noise_share = 0.05;
    if (scales.output_low < -noise_share * scales.output_span) {
        return {};
    }
    // It has no number: that it is there is all that there is to say.
    return {{"there", "1", 1.0, 1.0, 0.0, {1.0}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    if (!(values[0] > 0.5)) {
        return;
    }
    scenario.output.emplace_back([](std::span<double> z, const Motion&) {
        for (double& value : z) {
            value = std::fabs(value);
        }
    });
}

}  // namespace

const Effect& sensor_magnitude() {
    static const Effect effect{
        .name = "sensor_magnitude",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::sensor,
        .numbers = {{"there", Number::Given::never, 1.0}},
        .hides_base = true,
    };
    return effect;
}

}  // namespace gap
