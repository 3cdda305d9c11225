#include "gap/drive/wave_guess.hpp"

#include <cmath>
#include <numbers>

#include "gap/drive/simulate.hpp"

namespace gap {
namespace {

double product(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

}  // namespace

WaveGuess guess_wave(const Clue& clue, std::span<const double> rates, double small,
                     const std::function<void(Scenario& scenario, const WaveGuess& wave)>& add) {
    const std::vector<double> without = simulate(clue.scenario, clue.course);
    const auto response = [&](double rate, double phase_rad) {
        Scenario scenario = clue.scenario;
        add(scenario, {small, rate, phase_rad});
        std::vector<double> by = simulate(scenario, clue.course);
        for (std::size_t i = 0; i < by.size(); ++i) {
            by[i] = (by[i] - without[i]) / small;
        }
        return by;
    };
    WaveGuess best;
    double most = 0.0;
    for (const double rate : rates) {
        const std::vector<double> sine = response(rate, 0.0);
        const std::vector<double> cosine = response(rate, 0.5 * std::numbers::pi);
        const double ss = product(sine, sine);
        const double cc = product(cosine, cosine);
        const double sc = product(sine, cosine);
        const double determinant = ss * cc - sc * sc;
        if (!(determinant > 1e-9 * ss * cc)) {
            continue;  // both do the same, or the simulation ran away
        }
        const double with_sine = product(sine, clue.residuals);
        const double with_cosine = product(cosine, clue.residuals);
        const double a = (cc * with_sine - sc * with_cosine) / determinant;
        const double b = (ss * with_cosine - sc * with_sine) / determinant;
        const double taken = a * with_sine + b * with_cosine;
        if (taken > most) {
            most = taken;
            best = {std::hypot(a, b), rate, std::atan2(b, a)};
        }
    }
    return best;
}

}  // namespace gap
