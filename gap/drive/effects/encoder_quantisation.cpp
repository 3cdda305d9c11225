// The reading is a multiple of a step, which the audit of the readings finds. What was measured says which values
// within the step it stands for: the simulation is off by what it lies outside of them. Where nothing was measured it
// is rounded.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& encoder_quantisation();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.quantum > 0.0)) {
        return {};
    }
    return {{"step", "y", scales.quantum, scales.quantum, 0.0, {scales.quantum}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.logger.emplace_back([step = values[0]](std::span<double> reading, const Record& record) {
        for (std::size_t i = 0; i < reading.size(); ++i) {
            reading[i] = record.output.empty()
                             ? step * std::nearbyint(reading[i] / step)
                             : record.output[i] -
                                   std::copysign(std::max(0.0, std::fabs(record.output[i] - reading[i]) - 0.5 * step),
                                                 record.output[i] - reading[i]);
        }
    });
}

}  // namespace

const Effect& encoder_quantisation() {
    static const Effect effect{
        .name = "encoder_quantisation",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::sensor,
        .numbers = {{"step"}},
        .uneven_noise = true,
        .rounds = true,
    };
    return effect;
}

}  // namespace gap
