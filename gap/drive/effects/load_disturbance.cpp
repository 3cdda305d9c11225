// An outside force for a time.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& load_disturbance();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"from_s",
             "s",
             0.0,
             scales.length_s,
             0.0,
             {0.15 * scales.length_s, 0.35 * scales.length_s, 0.6 * scales.length_s, 0.8 * scales.length_s}},
            {"to_s",
             "s",
             0.0,
             scales.length_s,
             0.0,
             {0.3 * scales.length_s, 0.5 * scales.length_s, 0.75 * scales.length_s, 0.95 * scales.length_s}},
            {"size", "rhs", -scales.force, scales.force, 0.0, {0.05 * scales.force}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.forces.pushes.push_back({values[0], values[1], values[2]});
}

}  // namespace

const Effect& load_disturbance() {
    static const Effect effect{"load_disturbance", Kind::event, parameters, add};
    return effect;
}

}  // namespace gap
