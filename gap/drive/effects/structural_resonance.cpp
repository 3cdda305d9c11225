// A lightly damped mode q, excited by the input and late as y is, adds to z a share of its place and of its speed:
// K (share + speed_share s / wn) (wn^2 / (s^2 + 2 d wn s + wn^2)) u.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& structural_resonance();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"hz",
             "Hz",
             0.3 / scales.time_constant_s,
             0.45 / scales.interval_s,
             0.3 / scales.time_constant_s,
             {1.0 / scales.time_constant_s, 2.5 / scales.time_constant_s, 0.05 / scales.interval_s,
              0.12 / scales.interval_s}},
            {"damping", "1", 0.002, 0.5, 0.05, {0.05}},
            {"share", "1", -0.8, 0.8, 0.0, {0.03}},
            {"speed_share", "1", -0.8, 0.8, 0.0, {0.0}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    const double gain = drive::constant_coefficient(scenario.model.denominator) != 0.0
                            ? drive::static_gain(scenario.model)
                            : scenario.model.gain;
    scenario.output.emplace_back([gain, delay_s = scenario.model.delay_s, hz = values[0], damping = values[1],
                                  share = values[2],
                                  speed_share = values[3]](std::span<double> z, const Motion& motion) {
        // Exact for a held input: the pair of poles turns by wd h and shrinks by d wn h a step.
        const double h = motion.grid.step_s;
        const double wn = 2.0 * 3.14159265358979323846 * hz;
        const double wd = wn * std::sqrt(1.0 - damping * damping);
        const double shrink = std::exp(-damping * wn * h);
        const double c = shrink * std::cos(wd * h);
        const double s = shrink * std::sin(wd * h);
        const double ratio = damping * wn / wd;
        double q = 0.0;     // the mode's place
        double rate = 0.0;  // its speed over wd
        const double late = delay_s / h;
        const auto whole = static_cast<std::size_t>(late);
        const double part = late - static_cast<double>(whole);
        for (std::size_t k = 0; k < z.size(); ++k) {
            z[k] += gain * (share * q + speed_share * rate * wd / wn);
            const double u = (k >= whole ? (1.0 - part) * motion.input[k - whole] : 0.0) +
                             (k > whole ? part * motion.input[k - whole - 1] : 0.0);
            const double from = q - u;
            const double next = from * (c + ratio * s) + rate * s;
            rate = -from * s * (1.0 + ratio * ratio) + rate * (c - ratio * s);
            q = u + next;
        }
    });
}

}  // namespace

const Effect& structural_resonance() {
    static const Effect effect{
        .name = "structural_resonance",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::output,
        .numbers = {{"hz"},
                    {"damping"},
                    {"share", Number::Given::otherwise, 0.0},
                    {"speed_share", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical, Domain::hydraulic, Domain::electric},
    };
    return effect;
}

}  // namespace gap
