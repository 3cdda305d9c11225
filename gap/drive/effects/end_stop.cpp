// The output cannot pass a limit, with or without bounce.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& end_stop();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"limit",
             "y",
             scales.output_low + 0.3 * scales.output_span,
             scales.output_high + 0.02 * scales.output_span,
             scales.output_high + 0.02 * scales.output_span,
             {scales.output_high - 0.02 * scales.output_span, scales.output_high - 0.15 * scales.output_span}},
            {"restitution", "1", 0.0, 0.9, 0.0, {0.0}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.forces.stop = EndStop{values[0], values[1]};
}

}  // namespace

const Effect& end_stop() {
    static const Effect effect{
        .name = "end_stop",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"limit"}, {"restitution", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical, Domain::hydraulic},
        .hides_base = true,
    };
    return effect;
}

}  // namespace gap
