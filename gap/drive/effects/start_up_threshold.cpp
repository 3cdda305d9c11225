// w = 0 until u passes the threshold, then u: an actuator that must start. What it does when u falls below again is a
// variant: it runs on until u is 0, or it stops.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& start_up_threshold();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    std::vector<double> starts;
    std::vector<double> stops;
    for (const double stop : {0.0, 1.0}) {
        for (const double share : {0.15, 0.35, 0.6}) {
            starts.push_back(share * scales.input_max);
            stops.push_back(stop);
        }
    }
    return {{"threshold", "u", 0.0, 0.95 * scales.input_max, 0.0, starts},
            {"stops_below", "1", 0.0, 1.0, 0.0, stops, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.levels.emplace_back([threshold = values[0], stops_below = values[1] > 0.5](std::span<double> levels) {
        bool started = false;
        for (double& u : levels) {
            started = std::fabs(u) > threshold || (started && !stops_below && u != 0.0);
            u = started ? u : 0.0;
        }
    });
}

}  // namespace

const Effect& start_up_threshold() {
    static const Effect effect{"start_up_threshold", Kind::lasting, parameters, add};
    return effect;
}

}  // namespace gap
