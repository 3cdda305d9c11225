// w follows u around a loop: w = (1 - share) u + share p, where p is dragged along by u through a play of the width.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& input_hysteresis();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double range = (scales.two_signs ? 2.0 : 1.0) * scales.input_max;
    return {{"width", "u", 0.0, 0.9 * range, 0.0, {0.1 * range, 0.3 * range, 0.6 * range}},
            {"share", "1", 0.0, 1.0, 0.0, {0.9, 0.6, 0.6}}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.levels.emplace_back(
        [half = 0.5 * values[0], share = values[1], first = scenario.input_before](std::span<double> levels) {
            double play = first;
            for (double& u : levels) {
                play = std::clamp(play, u - half, u + half);
                u = (1.0 - share) * u + share * play;
            }
        });
}

}  // namespace

const Effect& input_hysteresis() {
    static const Effect effect{
        .name = "input_hysteresis",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .looks_like = {"coulomb_friction"},
        .place = Place::actuator,
        .numbers = {{"width"}, {"share", Number::Given::otherwise, 1.0}},
        .domains = {Domain::mechanical, Domain::hydraulic, Domain::electric},
    };
    return effect;
}

}  // namespace gap
