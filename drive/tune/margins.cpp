#include "drive/tune/margins.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace tune {
namespace {

constexpr double quiet = 0.05;  // |L| that neither crosses nor turns anything
constexpr std::size_t most_points = 400'000;

struct Open {
    const SampledPlant& plant;
    const Response& controller;
    Complex operator()(double w) const { return controller.at(w) * plant(w); }
};

std::vector<double> frequencies_of(const Open& loop) {
    const double top = loop.plant.nyquist();
    double loud = top;
    while (loud > 1e-6 * top && std::abs(loop(loud)) < quiet) {
        loud /= 1.05;
    }
    const double delay_s = loop.plant.model().delay_s + loop.plant.step_s();
    std::vector<double> frequencies;
    double w = std::min(1e-4 * loop.plant.scale(), loop.controller.from);
    while (std::abs(loop(w)) < 20.0 && w > 1e-9 * top) {  // weak integrals: from where L is large
        w /= 10.0;
    }
    while (w < top && frequencies.size() < most_points) {
        frequencies.push_back(w);
        w += w < 1.06 * loud ? std::min(0.01 * w, 0.05 / delay_s) : 0.05 * w;
    }
    frequencies.push_back(top);
    return frequencies;
}

// Where f changes sign between a and b.
double zero_between(double a, double b, const std::function<double(double)>& f) {
    const bool rises = f(b) > 0.0;
    for (int i = 0; i < 60 && b - a > 1e-12 * b; ++i) {
        const double middle = 0.5 * (a + b);
        ((f(middle) > 0.0) == rises ? b : a) = middle;
    }
    return 0.5 * (a + b);
}

// The largest f near `at`, by golden section between its neighbours.
double peak_near(double a, double b, const std::function<double(double)>& f) {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    for (int i = 0; i < 60; ++i) {
        const double left = b - golden * (b - a);
        const double right = a + golden * (b - a);
        (f(left) > f(right) ? b : a) = f(left) > f(right) ? right : left;
    }
    return 0.5 * (a + b);
}

}  // namespace

Margins margins_of(const Loop& loop) {
    const drive::Gains& gains = loop.gains;
    return margins_of(*loop.plant,
                      {[&](double w) { return loop.controller(w); }, gains.ki != 0.0 ? gains.integral_order : 0.0});
}

Margins margins_of(const SampledPlant& plant, const Response& controller) {
    const Open loop{plant, controller};
    const std::vector<double> frequencies = frequencies_of(loop);
    Margins margins;
    const double integrations = controller.integrations + plant.integrations();
    const Complex first = loop(frequencies.front());
    const bool against = std::cos(std::arg(first) + 0.5 * pi * integrations) < 0.0;
    const double on = against && (integrations > 0.0 || std::abs(first) > 1.0) ? pi : 0.0;
    double phase = -0.5 * pi * integrations;       // of L, followed
    double turned = on - 0.5 * pi * integrations;  // of 1 + L
    Complex before = 0.0;
    double before_phase = phase;
    std::size_t peak = 0;
    double tallest = 0.0;
    bool through = false;
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        const double w = frequencies[i];
        const Complex now = loop(w);
        phase += std::remainder(std::arg(now) - phase, 2.0 * pi);
        turned += std::remainder(std::arg(1.0 + now) - turned, 2.0 * pi);
        through = through || std::abs(1.0 + now) < 1e-9;
        const double sensitivity = 1.0 / std::abs(1.0 + now);
        margins.complementary = std::max(margins.complementary, std::abs(now) * sensitivity);
        if (sensitivity > margins.sensitivity) {
            margins.sensitivity = sensitivity;
            peak = i;
        }
        if (i > 0 && (std::abs(now) > 1.0) != (std::abs(before) > 1.0)) {
            const double at = zero_between(frequencies[i - 1], w, [&](double x) { return std::abs(loop(x)) - 1.0; });
            const double there = before_phase + std::remainder(std::arg(loop(at)) - before_phase, 2.0 * pi);
            ++margins.crossings;
            margins.crossover = at;
            margins.phase_deg = std::min(margins.phase_deg, (there + pi) * 180.0 / pi);
        }
        if (i > 0 && std::floor((phase + pi) / (2.0 * pi)) != std::floor((before_phase + pi) / (2.0 * pi))) {
            const double at = zero_between(frequencies[i - 1], w, [&](double x) { return std::arg(-loop(x)); });
            const double size = std::abs(loop(at));
            if (size < 1.0 && size > tallest) {
                tallest = size;
                margins.gain = 1.0 / size;
                margins.phase_crossover = at;
            }
        }
        before = now;
        before_phase = phase;
    }
    const double low = frequencies[peak == 0 ? 0 : peak - 1];
    const double high = frequencies[std::min(peak + 1, frequencies.size() - 1)];
    const auto sensitivity_at = [&](double x) { return 1.0 / std::abs(1.0 + loop(x)); };
    margins.sensitivity_at = peak_near(low, high, sensitivity_at);
    margins.sensitivity = std::max(margins.sensitivity, sensitivity_at(margins.sensitivity_at));
    if (margins.crossover > 0.0) {
        const double w = margins.crossover;
        margins.phase_slope = std::arg(loop(w * 1.001) / loop(w / 1.001)) / (2.0 * std::log(1.001));
    }
    margins.unstable_poles = through ? -1 : static_cast<int>(std::lround((on - turned) / pi));
    return margins;
}

}  // namespace tune
