// A sample was taken at another time than its stamp says, evenly within a half width on both sides: what is read is off
// by the speed times an unknown time, so that no simulation can follow it and only its spread is told.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& sampling_jitter();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    // Neither moves a reading: both are found by likelihood (gap/drive/jitter.hpp).
    return {{"half_width_s", "s", 0.0, 1.0 * scales.interval_s, 0.0, {0.3 * scales.interval_s}, true},
            {"noise_share", "1", 0.0, 1.0, 1.0, {1.0}, true}};
}

void add(Scenario& scenario, std::span<const double> values) { scenario.jitter_s = values[0]; }

}  // namespace

const Effect& sampling_jitter() {
    static const Effect effect{
        .name = "sampling_jitter",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::logger,
        .numbers = {{"half_width_s"}, {"noise_share", Number::Given::otherwise, 1.0}},
        .uneven_noise = true,
        .only_spreads = true,
    };
    return effect;
}

}  // namespace gap
