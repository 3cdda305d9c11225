// Friction that grows with the force carried: against motion, a share of |what drives| + |what restores|.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& load_dependent_friction();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"share", "1", 0.0, 0.6, 0.0, {0.02, 0.1}}};
}

void add(Scenario& scenario, std::span<const double> values) { scenario.forces.friction_share += values[0]; }

}  // namespace

const Effect& load_dependent_friction() {
    static const Effect effect{
        .name = "load_dependent_friction",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"share"}},
        .domains = {Domain::mechanical},
    };
    return effect;
}

}  // namespace gap
