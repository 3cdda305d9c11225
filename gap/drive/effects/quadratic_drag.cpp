// A force k y' |y'|.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& quadratic_drag();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    constexpr double most = 5.0;
    const double usual = scales.force / (scales.speed_max * scales.speed_max);
    if (!scales.maybe_speed) {
        return {{"coefficient", "rhs/speed^2", 0.0, most * usual, 0.0, {0.1 * usual, 0.6 * usual}},
                {"of_speed", "1", 0.0, 1.0, 0.0, {0.0}, true}};
    }
    const double of_output = scales.force / (scales.output_max * scales.output_max);
    return {{"coefficient",
             "rhs/speed^2",
             0.0,
             most * std::max(usual, of_output),
             0.0,
             {0.1 * usual, 0.6 * usual, 0.1 * of_output, 0.6 * of_output, 2.0 * of_output}},
            {"of_speed", "1", 0.0, 1.0, 0.0, {0.0, 0.0, 1.0, 1.0, 1.0}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    (values[1] > 0.5 ? scenario.forces.drag_of_speed : scenario.forces.drag) += values[0];
}

// What is driven at some speed resists a further one by the tangent.
double slope(std::span<const double> values, double output) {
    return values[1] > 0.5 ? 2.0 * values[0] * std::fabs(output) : 0.0;
}

}  // namespace

const Effect& quadratic_drag() {
    static const Effect effect{
        .name = "quadratic_drag",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"coefficient"}, {"of_speed", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical, Domain::hydraulic},
        .smooth = true,
        .slope = slope,
    };
    return effect;
}

}  // namespace gap
