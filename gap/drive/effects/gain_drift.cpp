// The gain changes with time, 1 + per_s t.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& gain_drift();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"per_s",
             "1/s",
             -0.9 / scales.length_s,
             2.0 / scales.length_s,
             0.0,
             {-0.15 / scales.length_s, 0.15 / scales.length_s}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.input.emplace_back([per_s = values[0]](std::span<double> held, const Grid& grid) {
        for (std::size_t k = 0; k < held.size(); ++k) {
            held[k] *= 1.0 + per_s * (static_cast<double>(k) + 0.5) * grid.step_s;
        }
    });
}

}  // namespace

const Effect& gain_drift() {
    static const Effect effect{
        .name = "gain_drift",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"per_s"}},
    };
    return effect;
}

}  // namespace gap
