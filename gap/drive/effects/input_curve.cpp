// w = u ((1 - c) + c |u| / reference): a bend through 0 that leaves the reference where it is.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& input_curve();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double top = scales.input_max;
    // At one level a bend is any gain, and a reference is told by none.
    if (scales.input_levels <= 2) {
        return {{"curvature", "1", -0.9, 1.0, 0.0, {-0.3, 0.3, 0.8, -0.3, 0.3}},
                {"reference", "u", 0.5 * top, top, top, {top, top, top, 0.5 * top, 0.5 * top}, true}};
    }
    return {{"curvature", "1", -0.9, 1.0, 0.0, {-0.3, 0.3, 0.8}},
            {"reference", "u", 0.3 * top, 4.0 * top, top, {top, top, top}}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.levels.emplace_back([c = values[0], reference = values[1]](std::span<double> levels) {
        for (double& u : levels) {
            u *= (1.0 - c) + c * std::fabs(u) / reference;
        }
    });
}

}  // namespace

const Effect& input_curve() {
    static const Effect effect{
        .name = "input_curve",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .generalises = {"gain_error"},
        .place = Place::actuator,
        .numbers = {{"curvature"}, {"reference"}},
        .smooth = true,
    };
    return effect;
}

}  // namespace gap
