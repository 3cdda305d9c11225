// The reading is held for stretches: where the record itself repeats one value though the model moves.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& dropped_samples();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"rate", "1", 0.0, 1.0, 0.0, {1.0}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    if (!(values[0] > 0.0)) {
        return;
    }
    scenario.logger.emplace_back([](std::span<double> reading, const Record& record) {
        for (std::size_t i = 1; i < reading.size(); ++i) {
            if (record.output[i] == record.output[i - 1]) {
                reading[i] = reading[i - 1];
            }
        }
    });
}

}  // namespace

const Effect& dropped_samples() {
    static const Effect effect{"dropped_samples", Kind::event, parameters, add};
    return effect;
}

}  // namespace gap
