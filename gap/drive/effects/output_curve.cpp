// A memoryless bend between y and z: z = y ((1 - c) + c |y| / reference), the reference being the largest reading.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& output_curve();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"curvature", "1", -0.9, 0.9, 0.0, {-0.25, 0.25}},
            {"reference",
             "y",
             std::max(std::fabs(scales.output_high), std::fabs(scales.output_low)),
             std::max(std::fabs(scales.output_high), std::fabs(scales.output_low)),
             std::max(std::fabs(scales.output_high), std::fabs(scales.output_low)),
             {std::max(std::fabs(scales.output_high), std::fabs(scales.output_low))}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.output.emplace_back([c = values[0], reference = values[1]](std::span<double> z, const Motion&) {
        for (double& value : z) {
            value *= (1.0 - c) + c * std::fabs(value) / reference;
        }
    });
}

}  // namespace

const Effect& output_curve() {
    static const Effect effect{"output_curve", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
