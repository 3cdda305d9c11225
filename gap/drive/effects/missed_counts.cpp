// The reading jumps by a size at a time and stays off.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& missed_counts();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"at_s",
             "s",
             0.0,
             scales.length_s,
             0.0,
             {0.1 * scales.length_s, 0.3 * scales.length_s, 0.5 * scales.length_s, 0.7 * scales.length_s,
              0.9 * scales.length_s}},
            {"size", "y", -0.6 * scales.output_span, 0.6 * scales.output_span, 0.0, {0.03 * scales.output_span}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.logger.emplace_back([at_s = values[0], size = values[1]](std::span<double> reading, const Record& record) {
        for (std::size_t i = 0; i < reading.size(); ++i) {
            reading[i] += record.time_s[i] - record.time_s.front() >= at_s ? size : 0.0;
        }
    });
}

}  // namespace

const Effect& missed_counts() {
    static const Effect effect{"missed_counts", Kind::event, parameters, add};
    return effect;
}

}  // namespace gap
