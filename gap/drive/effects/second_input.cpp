// Another logged input acts, with a gain and a lag of its own: it is added to the effective one. It was there before
// the record, at its first level.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& second_input();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.further_max > 0.0)) {
        return {};
    }
    const double unit = scales.input_max / scales.further_max;
    // A lag that outlasts the records is a drift.
    const double slowest_s = std::min(10.0 * scales.time_constant_s, scales.length_s);
    const double slow_s = std::min(2.0 * scales.time_constant_s, 0.5 * slowest_s);
    return {{"gain", "u/u2", -50.0 * unit, 50.0 * unit, 0.0, {0.2 * unit, -0.2 * unit, 0.2 * unit, -0.2 * unit}},
            {"tau_s",
             "s",
             0.0,
             slowest_s,
             0.0,
             {0.05 * slow_s, 0.05 * slow_s, slow_s, slow_s}}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.further_inputs.push_back({0, values[0], values[1]});
}

}  // namespace

const Effect& second_input() {
    static const Effect effect{
        .name = "second_input",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::command,
        .numbers = {{"gain"}, {"tau_s", Number::Given::otherwise, 0.0}},
    };
    return effect;
}

}  // namespace gap
