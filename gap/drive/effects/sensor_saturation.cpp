// The reading ends at a limit, and at its opposite. What it holds there repeats exactly, noise and all: where readings
// at their extremes differ like others, it is the plant that ends.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& sensor_saturation();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!scales.may_clip) {
        return {};
    }
    return {{"limit",
             "y",
             scales.output_low + 0.2 * scales.output_span,
             scales.output_high + 0.02 * scales.output_span,
             scales.output_high + 0.02 * scales.output_span,
             {scales.output_high - 0.01 * scales.output_span, scales.output_high - 0.15 * scales.output_span}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.output.emplace_back([limit = values[0]](std::span<double> z, const Motion&) {
        for (double& value : z) {
            value = limit > 0.0 ? std::clamp(value, -limit, limit) : std::min(value, limit);
        }
    });
}

}  // namespace

const Effect& sensor_saturation() {
    static const Effect effect{
        .name = "sensor_saturation",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::sensor,
        .numbers = {{"limit"}},
        .uneven_noise = true,
        .hides_base = true,
    };
    return effect;
}

}  // namespace gap
