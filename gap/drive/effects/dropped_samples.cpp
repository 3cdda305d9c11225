// The reading is held for stretches: where the record itself repeats one value though no quantum makes it. Its rate is
// the share of repeats that the audit counted. What a record repeats at its highest or lowest is held by an end, and
// not by a logger.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& dropped_samples();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.held_share > 0.0)) {
        return {};
    }
    return {{"rate", "1", scales.held_share, scales.held_share, 0.0, {scales.held_share}, true}};
}

void add(Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.logger.emplace_back([](std::span<double> reading, const Record& record) {
        if (record.output.empty()) {
            return;  // nobody measured: nothing was repeated
        }
        const auto [lowest, highest] = std::ranges::minmax(record.output);
        for (std::size_t i = 1; i < record.output.size(); ++i) {
            const double read = record.output[i];
            if (read == record.output[i - 1] && read != lowest && read != highest) {
                reading[i] = reading[i - 1];
            }
        }
    });
}

}  // namespace

const Effect& dropped_samples() {
    static const Effect effect{
        .name = "dropped_samples",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::logger,
        .numbers = {{"rate"}},
        .uneven_noise = true,
    };
    return effect;
}

}  // namespace gap
