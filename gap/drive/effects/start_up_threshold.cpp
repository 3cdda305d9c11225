// w = 0 until u passes the threshold, then u: an actuator that must start. What it does when u falls below again is a
// variant: it runs on until u is 0, or it stops. Within 0.4 % of the greatest input it starts in part, so that
// the misfit of a ramp or a chirp falls towards the threshold, and does not jump from one logged level to the next.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gap/drive/effect.hpp"
#include "gap/drive/level_scan.hpp"

namespace gap {

const Effect& start_up_threshold();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    std::vector<double> starts;
    std::vector<double> stops;
    for (const double stop : {0.0, 1.0}) {
        for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.65}) {
            starts.push_back(share * scales.input_max);
            stops.push_back(stop);
        }
    }
    return {{"threshold", "u", 0.0, 0.95 * scales.input_max, 0.0, starts},
            {"stops_below", "1", 0.0, 1.0, 0.0, stops, true},
            {"width", "u", 0.0, scales.input_max, 0.0, {0.004 * scales.input_max}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.levels.emplace_back(
        [threshold = values[0], stops_below = values[1] > 0.5, width = values[2]](std::span<double> levels) {
            double started = 0.0;
            for (double& u : levels) {
                const double beyond = std::fabs(u) - threshold;
                const double now = width > 0.0 ? std::clamp(0.5 + beyond / width, 0.0, 1.0) : beyond > 0.0 ? 1.0 : 0.0;
                started = stops_below || u == 0.0 ? now : std::max(started, now);
                u *= started;
            }
        });
}

// Levels lie on either side of a threshold, and nothing between two of them tells where: a start on the wrong side
// stays there.
std::vector<double> start(const Clue& clue) {
    const double width = 0.004 * clue.scales.input_max;
    LevelPlace best{0.0, std::numeric_limits<double>::infinity()};
    double stops_below = 0.0;
    for (const double stops : {0.0, 1.0}) {
        const LevelPlace found = scan_levels(clue, [&](Scenario& scenario, double level) {
            add(scenario, std::vector{level, stops, width});
        });
        if (found.squares < best.squares) {
            best = found;
            stops_below = stops;
        }
    }
    return {best.level, stops_below, width};
}

}  // namespace

const Effect& start_up_threshold() {
    static const Effect effect{
        .name = "start_up_threshold",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"threshold"},
                    {"stops_below", Number::Given::otherwise, 0.0},
                    {"width", Number::Given::otherwise, 0.0}},
        .leads_base = true,
        .start = start,
    };
    return effect;
}

}  // namespace gap
