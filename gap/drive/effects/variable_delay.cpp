// The dead time goes up and down, by depth sin(2 pi t / period + phase), from the record's first stamp on: a network, a
// queue. In all it is at least 0. What arrives twice counts twice, and what is overtaken never arrives. No logger waits
// for the wave, so each record has its own phase.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gap/drive/effect.hpp"
#include "gap/drive/wave_guess.hpp"

namespace gap {

const Effect& variable_delay();

namespace {

constexpr double pi = std::numbers::pi;

std::vector<EffectParameter> parameters(const Scales& scales) {
    std::vector<double> periods;
    for (const double share : {0.6, 0.3, 0.15, 0.08}) {
        periods.push_back(share * scales.length_s);
    }
    std::vector<double> phases;
    for (int eighths = -7; eighths <= 8; ++eighths) {
        phases.push_back(0.125 * pi * eighths);
    }
    // A depth below 0 is the other half of the phases: a fit may go through 0.
    const double deepest = 2.0 * scales.time_constant_s;
    return {{"depth_s", "s", -deepest, deepest, 0.0, {0.1 * scales.time_constant_s}},
            {"period_s", "s", 4.0 * scales.interval_s, 2.0 * scales.length_s, 2.0 * scales.length_s, periods},
            {.name = "phase_rad",
             .unit = "rad",
             .lower = -4.0 * pi,
             .upper = 4.0 * pi,
             .none = 0.0,
             .starts = phases,
             .of_record = true}};
}

// \param held  means over intervals \param at  in intervals
double integral_to(std::span<const double> integral, std::span<const double> held, double at, double before) {
    if (at <= 0.0) {
        return before * at;
    }
    const auto below = std::min(static_cast<std::size_t>(at), held.size() - 1);
    return integral[below] + (at - static_cast<double>(below)) * held[below];
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.input.emplace_back([depth_s = values[0], period_s = values[1], phase_rad = values[2],
                                 delay_s = scenario.model.delay_s,
                                 before = scenario.input_before](std::span<double> held, const Grid& grid) {
        if (depth_s == 0.0) {
            return;
        }
        const std::vector<double> sent(held.begin(), held.end());
        std::vector<double> integral(sent.size(), 0.0);
        for (std::size_t k = 1; k < sent.size(); ++k) {
            integral[k] = integral[k - 1] + sent[k - 1];
        }
        // What acts at a time was sent the whole delay before. The model's own share of it comes behind.
        const auto sent_at = [&](std::size_t k) {
            const double sent_s = static_cast<double>(k) * grid.step_s;
            const double more_s = depth_s * std::sin(2.0 * pi * (sent_s + delay_s) / period_s + phase_rad);
            return (sent_s - std::max(more_s, -delay_s)) / grid.step_s;
        };
        double from = sent_at(0);
        for (std::size_t k = 0; k < held.size(); ++k) {
            const double to = sent_at(k + 1);
            // The mean over an interval in which the time of sending goes evenly.
            constexpr double still = 1e-6;
            const double middle = 0.5 * (from + to);
            const double low = std::fabs(to - from) > still ? from : middle - still;
            const double high = std::fabs(to - from) > still ? to : middle + still;
            held[k] =
                (integral_to(integral, sent, high, before) - integral_to(integral, sent, low, before)) / (high - low);
            from = to;
        }
    });
}

std::vector<double> start(const Clue& clue) {
    std::vector<double> rates;
    for (double rate = 0.5; rate <= 40.0; rate += 0.5) {
        rates.push_back(rate / clue.scales.length_s);
    }
    const WaveGuess wave =
        guess_wave(clue, rates, 0.02 * clue.scales.time_constant_s, [](Scenario& scenario, const WaveGuess& one) {
            add(scenario, std::vector{one.size, 1.0 / one.rate, one.phase_rad});
        });
    return {wave.size, wave.rate > 0.0 ? 1.0 / wave.rate : clue.scales.length_s, wave.phase_rad};
}

}  // namespace

const Effect& variable_delay() {
    static const Effect effect{
        .name = "variable_delay",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::command,
        .numbers = {{"depth_s"}, {"period_s"}, {"phase_rad", Number::Given::otherwise, 0.0}},
        .start = start,
        .period_s = [](std::span<const double> values) { return values[1]; },
    };
    return effect;
}

}  // namespace gap
