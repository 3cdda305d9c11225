// w follows u at a bounded rate.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& rate_limit();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"per_s",
             "u/s",
             0.02 * scales.input_max / scales.time_constant_s,
             2.0 * scales.input_max / scales.interval_s,
             2.0 * scales.input_max / scales.interval_s,
             {0.5 * scales.input_max / scales.time_constant_s, 3.0 * scales.input_max / scales.time_constant_s}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.input.emplace_back([per_s = values[0]](std::span<double> held, const Grid& grid) {
        const double most = per_s * grid.step_s;
        double w = 0.0;
        for (double& u : held) {
            // The mean over the interval of what moves from w towards u.
            const double way = u - w;
            const double end = w + std::clamp(way, -most, most);
            const double share = most > 0.0 ? std::min(1.0, std::fabs(way) / most) : 0.0;
            const double mean = end - 0.5 * share * (end - w);
            w = end;
            u = mean;
        }
    });
}

}  // namespace

const Effect& rate_limit() {
    static const Effect effect{"rate_limit", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
