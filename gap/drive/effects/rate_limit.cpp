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

void add(Scenario& scenario, std::span<const double> values) {
    scenario.input.emplace_back([per_s = values[0], first = scenario.input_before](std::span<double> held,
                                                                                   const Grid& grid) {
        const std::vector<double> levels(held.begin(), held.end());
        double w = first;
        // The integral of w over a share of the interval, on its way to a level.
        const auto advance = [&](double level, double share) {
            const double most = per_s * grid.step_s * share;
            const double end = w + std::clamp(level - w, -most, most);
            const double moving = most > 0.0 ? std::min(1.0, std::fabs(level - w) / most) : 0.0;
            const double integral = share * (end - 0.5 * moving * (end - w));
            w = end;
            return integral;
        };
        for (std::size_t k = 0; k < held.size(); ++k) {
            const double before = k > 0 ? levels[k - 1] : levels[k];
            const double after = k + 1 < levels.size() ? levels[k + 1] : levels[k];
            // A level between its neighbours is a change within the interval: the old one for a share of it, then the
            // new one.
            const double old_share = before != after ? (levels[k] - after) / (before - after) : 0.0;
            held[k] = old_share > 0.0 && old_share < 1.0 ? advance(before, old_share) + advance(after, 1.0 - old_share)
                                                         : advance(levels[k], 1.0);
        }
    });
}

}  // namespace

const Effect& rate_limit() {
    static const Effect effect{
        .name = "rate_limit",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"per_s"}},
    };
    return effect;
}

}  // namespace gap
