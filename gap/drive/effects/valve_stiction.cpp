// A valve that sticks [Kano2004, Choudhury2005]: it stays while u moves by less than the band since it last turned,
// then jumps and follows, half of the band less the jump behind. Where u rests it sticks again, and goes on the same
// way when u has moved by the jump. In terms of forces: it breaks loose at |u - w| = (band + jump) / 2 and slides at
// (band - jump) / 2. Within 0.4 % of the greatest input it breaks loose in part, so that the misfit of a ramp or a sine
// falls towards the band, and does not jump from one logged level to the next.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"
#include "gap/drive/scan.hpp"

namespace gap {

const Effect& valve_stiction();

namespace {

double range_of(const Scales& scales) { return (scales.two_signs ? 2.0 : 1.0) * scales.input_max; }

double softness_of(const Scales& scales) { return 0.004 * scales.input_max; }

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double range = range_of(scales);
    return {{"band", "u", 0.0, range, 0.0, {0.05 * range, 0.15 * range, 0.4 * range}},
            {"jump", "u", 0.0, range, 0.0, {0.02 * range, 0.06 * range, 0.16 * range}},
            {"softness", "u", 0.0, scales.input_max, 0.0, {softness_of(scales)}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    const double jump = std::min(values[1], values[0]);
    const double breaks = 0.5 * (values[0] + jump);
    const double slides = 0.5 * (values[0] - jump);
    const double softness = std::min(values[2], breaks);
    scenario.levels.emplace_back([breaks, slides, softness, first = scenario.input_before](std::span<double> levels) {
        double w = first;
        double before = first;
        double way = 0.0;  // in which it slides; 0: it sticks
        for (double& u : levels) {
            const double by = u - before;
            before = u;
            if (!(way * by > 0.0)) {
                way = 0.0;
                const double beyond = std::fabs(u - w) - breaks;
                const double loose =
                    softness > 0.0 ? std::clamp(0.5 + beyond / softness, 0.0, 1.0) : (beyond > 0.0 ? 1.0 : 0.0);
                const double towards = std::copysign(1.0, u - w);
                w += loose * towards * std::max(0.0, std::fabs(u - w) - slides);
                way = loose == 1.0 ? towards : 0.0;
            } else {
                w = u - way * slides;
            }
            u = w;
        }
    });
}

// Which logged levels break it loose goes by steps: bands from a hundredth of the range to all of it.
std::vector<double> start(const Clue& clue) {
    std::vector<std::vector<double>> candidates;
    for (double band = 0.01; band <= 1.0; band *= 1.25) {
        for (const double jump : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
            const double range = range_of(clue.scales);
            candidates.push_back({band * range, jump * band * range, softness_of(clue.scales)});
        }
    }
    return best_of(clue, candidates, add);
}

// Without a jump it neither sticks nor breaks loose: what is left is a play.
std::optional<Special> is_only(std::span<const double> values) {
    constexpr double next_to_no_jump = 0.1;
    if (values[1] > next_to_no_jump * values[0]) {
        return std::nullopt;
    }
    return Special{"input_hysteresis", {values[0], 1.0}};
}

}  // namespace

const Effect& valve_stiction() {
    static const Effect effect{
        .name = "valve_stiction",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .looks_like = {"input_hysteresis"},
        .place = Place::actuator,
        .numbers = {{"band"}, {"jump"}, {"softness", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical, Domain::hydraulic},
        .start = start,
        .is_only = is_only,
    };
    return effect;
}

}  // namespace gap
