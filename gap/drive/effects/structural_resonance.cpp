// A lightly damped mode q, excited by the input and late as y is, adds to z a share of its place or of its speed,
// K (share + speed_share s / wn) (wn^2 / (s^2 + 2 d wn s + wn^2)) u. Which of them it is is a variant: both together
// would be any phase, which damping and frequency tell already.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/failure.hpp"
#include "gap/drive/effect.hpp"

namespace gap {

const Effect& structural_resonance();

namespace {

// The share in either place, and how much of a quarter turn of phase it leads: 0 of the place, 1 of the speed.
std::vector<EffectParameter> parameters(const Scales& scales) {
    const double slowest = 0.3 / scales.time_constant_s;
    std::vector<double> hz;
    std::vector<double> of_speed;
    for (const double variant : {0.0, 1.0}) {
        for (const double start : {1.0 / scales.time_constant_s, 2.5 / scales.time_constant_s, 0.05 / scales.interval_s,
                                   0.12 / scales.interval_s}) {
            hz.push_back(start);
            of_speed.push_back(variant);
        }
    }
    return {{"hz", "Hz", slowest, 0.45 / scales.interval_s, slowest, hz},
            {"damping", "1", 0.002, 0.5, 0.05, {0.05}},
            {"share", "1", -0.8, 0.8, 0.0, {0.03}},
            {"of_speed", "1", 0.0, 1.0, 0.0, of_speed, true}};
}

double of_place(double of_speed) { return of_speed == 1.0 ? 0.0 : std::cos(0.5 * std::numbers::pi * of_speed); }
double of_rate(double of_speed) { return std::sin(0.5 * std::numbers::pi * of_speed); }

void add(Scenario& scenario, std::span<const double> values) {
    const double gain = drive::constant_coefficient(scenario.model.denominator) != 0.0
                            ? drive::static_gain(scenario.model)
                            : scenario.model.gain;
    scenario.output.emplace_back(
        [gain, delay_s = scenario.model.delay_s, hz = values[0], damping = values[1],
         share = values[2] * of_place(values[3]),
         speed_share = values[2] * of_rate(values[3])](std::span<double> z, const Motion& motion) {
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

std::vector<Written> to_contract(const Effect&, std::span<const Fitted> fitted) {
    std::vector<Written> written = {{"hz", fitted[0].value, {{fitted[0].low, fitted[0].high}}},
                                    {"damping", fitted[1].value, {{fitted[1].low, fitted[1].high}}}};
    const auto add_share = [&](const char* name, double by) {
        if (by != 0.0) {
            written.push_back({name, by * fitted[2].value, {{by * fitted[2].low, by * fitted[2].high}}});
        }
    };
    add_share("share", of_place(fitted[3].value));
    add_share("speed_share", of_rate(fitted[3].value));
    return written;
}

std::vector<double> from_contract(const Effect& effect, const Contracted& contracted) {
    Contracted own = contracted;
    double speed_share = 0.0;
    if (const auto found = own.find("speed_share"); found != own.end()) {
        if (!std::holds_alternative<double>(found->second)) {
            throw glsum::Failure(glsum::Exit::bad_input, "structural_resonance: expected a number speed_share");
        }
        speed_share = std::get<double>(found->second);
        own.erase(found);
    }
    std::vector<double> values = numbers_from_contract(effect, own);
    if (speed_share != 0.0) {
        const double share = values[2];
        values[2] = share == 0.0 ? speed_share : std::copysign(std::hypot(share, speed_share), share);
        values[3] = share == 0.0 ? 1.0 : std::atan(speed_share / share) / (0.5 * std::numbers::pi);
    }
    return values;
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
                    {"of_speed", Number::Given::never, 0.0}},
        .domains = {Domain::mechanical, Domain::hydraulic, Domain::electric},
        .linear = true,
        .to_contract = to_contract,
        .from_contract = from_contract,
    };
    return effect;
}

}  // namespace gap
