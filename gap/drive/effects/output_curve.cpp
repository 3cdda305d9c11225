// A memoryless bend of the output, z = y ((1 - c) + c |y| / reference), about a reference that stays where it is. In
// its other variant it is the restoring term that bends, as an outflow does that goes with the power 1 + c of the
// level.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& output_curve();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double reference = std::max(std::fabs(scales.output_high), std::fabs(scales.output_low));
    // Which one it is is not known: free, it lets the slope at 0 be any.
    const EffectParameter about{"reference", "y", 0.3 * reference, 3.0 * reference, reference, {reference}};
    // What swings is no flow that drains.
    if (!scales.steady || scales.swings || !scales.drains) {
        return {
            {"curvature", "1", -0.9, 0.9, 0.0, {-0.25, 0.25}}, about, {"in_outflow", "1", 0.0, 1.0, 0.0, {0.0}, true}};
    }
    return {{"curvature", "1", -0.9, 0.9, 0.0, {-0.25, 0.25, -0.5, 0.25}},
            about,
            {"in_outflow", "1", 0.0, 1.0, 0.0, {0.0, 0.0, 1.0, 1.0}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    if (values[2] > 0.5) {
        scenario.forces.outflow = Outflow{values[0], values[1]};
        return;
    }
    scenario.output.emplace_back([c = values[0], reference = values[1]](std::span<double> z, const Motion&) {
        for (double& value : z) {
            value *= (1.0 - c) + c * std::fabs(value) / reference;
        }
    });
}

bool counts_from_zero(std::span<const double> values) { return values[2] > 0.5; }

}  // namespace

const Effect& output_curve() {
    static const Effect effect{
        .name = "output_curve",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .generalises = {"gain_error"},
        .place = Place::output,
        .numbers = {{"curvature"},
                    {"reference", Number::Given::otherwise, 1.0},
                    {"in_outflow", Number::Given::otherwise, 0.0}},
        .smooth = true,
        .from_zero = counts_from_zero,
    };
    return effect;
}

}  // namespace gap
