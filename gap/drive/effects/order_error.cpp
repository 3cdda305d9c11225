// The orders of the denominator differ, the highest by the shift s, each a by s (a / highest)^power: all alike, in
// proportion, or the highest alone. Which of these it is the record says, once: the power is no number to be fitted.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& order_error();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    const bool one = scales.orders < 2;
    return {{"shift", "1", -0.5, 0.5, 0.0, {-0.1, 0.1}},
            {"power", "1", 0.0, 8.0, 0.0, one ? std::vector{0.0} : std::vector{0.0, 0.0, 1.0, 1.0, 8.0, 8.0}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    constexpr double least = 0.05;  // an order of 0 would be another term
    const double highest = drive::highest_order(scenario.model.denominator);
    for (drive::Term& term : scenario.model.denominator) {
        if (term.order > 0.0) {
            term.order = std::max(least, term.order + values[0] * std::pow(term.order / highest, values[1]));
        }
    }
}

}  // namespace

const Effect& order_error() {
    static const Effect effect{
        .name = "order_error",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"shift"}, {"power", Number::Given::otherwise, 0.0}},
        .of_fitted_base = true,
        .linear = true,
    };
    return effect;
}

}  // namespace gap
