// The orders of the denominator differ, all by the same share of themselves.
// A shift s makes each order a (1 + s / highest order), so that the highest moves by s.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& order_error();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"shift", "1", -0.5, 0.5, 0.0, {-0.1, 0.1}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    const double highest = drive::highest_order(scenario.model.denominator);
    for (drive::Term& term : scenario.model.denominator) {
        term.order *= 1.0 + values[0] / highest;
    }
}

}  // namespace

const Effect& order_error() {
    static const Effect effect{"order_error", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
