// Play between y and z: z stays while y crosses the gap.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& backlash();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"gap", "y", 0.0, 0.6 * scales.output_span, 0.0, {0.02 * scales.output_span, 0.1 * scales.output_span}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.output.emplace_back([gap = values[0]](std::span<double> z, const Motion&) {
        double at = z.empty() ? 0.0 : z[0];
        for (double& value : z) {
            at = std::clamp(at, value - 0.5 * gap, value + 0.5 * gap);
            value = at;
        }
    });
}

}  // namespace

const Effect& backlash() {
    static const Effect effect{
        .name = "backlash",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::output,
        .numbers = {{"gap"}},
        .domains = {Domain::mechanical},
    };
    return effect;
}

}  // namespace gap
