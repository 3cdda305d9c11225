// Readings drift with time.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& sensor_drift();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"per_s",
             "y/s",
             -0.8 * scales.output_span / scales.length_s,
             0.8 * scales.output_span / scales.length_s,
             0.0,
             {0.05 * scales.output_span / scales.length_s}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.output.emplace_back([per_s = values[0]](std::span<double> z, const Motion& motion) {
        for (std::size_t k = 0; k < z.size(); ++k) {
            z[k] += per_s * static_cast<double>(k) * motion.grid.step_s;
        }
    });
}

}  // namespace

const Effect& sensor_drift() {
    static const Effect effect{
        .name = "sensor_drift",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::sensor,
        .numbers = {{"per_s"}},
        .of_time = true,
    };
    return effect;
}

}  // namespace gap
