// The dead time is another one. Below 0 the model waits too long; in all it is at least 0.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& dead_time_error();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"extra_s",
             "s",
             -4.0 * scales.time_constant_s,
             4.0 * scales.time_constant_s,
             0.0,
             {-0.3 * scales.time_constant_s, 0.1 * scales.time_constant_s, 0.5 * scales.time_constant_s}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.model.delay_s = std::max(0.0, scenario.model.delay_s + values[0]);
}

}  // namespace

const Effect& dead_time_error() {
    static const Effect effect{
        .name = "dead_time_error",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::command,
        .numbers = {{"extra_s"}},
        .of_fitted_base = true,
        .linear = true,
    };
    return effect;
}

}  // namespace gap
