// A force that is locked to the place, size sin(2 pi per_unit y + phase); where the output may be a speed, one that is
// locked to the speed's integral over the record.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gap/drive/effect.hpp"
#include "gap/drive/wave_guess.hpp"

namespace gap {

const Effect& cogging();

namespace {

constexpr double half_turns = 4.0;

// How far the place goes.
double way_of(const Scales& scales) {
    return scales.maybe_speed ? 0.5 * scales.output_max * scales.length_s : scales.output_span;
}

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double unit = 1.0 / way_of(scales);
    constexpr double pi = std::numbers::pi;
    std::vector<double> rates;
    std::vector<double> phases;
    for (const double rate : {4.0, 8.0, 16.0, 32.0}) {
        for (const double phase : {0.0, 0.5 * pi}) {
            rates.push_back(rate * unit);
            phases.push_back(phase);
        }
    }
    // A size below 0 is the other half of the phases: a fit may go through 0.
    return {{"size", "rhs", -0.6 * scales.force, 0.6 * scales.force, 0.0, {0.05 * scales.force}},
            // A wave longer than the way is a weight's or a spring's force.
            {"per_unit", "1/y", 3.0 * unit, 200.0 * unit, 3.0 * unit, rates},
            {"phase_rad", "rad", -half_turns * pi, half_turns * pi, 0.0, phases},
            {"of_speed", "1", 0.0, 1.0, 0.0, {scales.maybe_speed ? 1.0 : 0.0}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.forces.cogging.push_back({values[0], values[1], values[2], values[3] > 0.5});
}

std::vector<double> start(const Clue& clue) {
    const double unit = 1.0 / way_of(clue.scales);
    const double of_speed = clue.scales.maybe_speed ? 1.0 : 0.0;
    std::vector<double> rates;
    for (double rate = 0.5; rate <= 40.0; rate += 0.5) {
        rates.push_back(rate * unit);
    }
    const WaveGuess wave = guess_wave(clue, rates, 1e-4 * clue.scales.force, [&](Scenario& scenario, const auto& one) {
        add(scenario, std::vector{one.size, one.rate, one.phase_rad, of_speed});
    });
    return {wave.size, wave.rate, wave.phase_rad, of_speed};
}

}  // namespace

const Effect& cogging() {
    static const Effect effect{
        .name = "cogging",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"size"},
                    {"per_unit"},
                    {"phase_rad", Number::Given::otherwise, 0.0},
                    {"of_speed", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical},
        .start = start,
    };
    return effect;
}

}  // namespace gap
