#include "bench/signals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "glsum/weights.hpp"

namespace bench {
namespace {

std::vector<double> sine(double hz, std::size_t samples) {
    std::vector<double> x(samples);
    for (std::size_t k = 0; k < samples; ++k) {
        x[k] = signal_peak * std::sin(2.0 * std::numbers::pi * hz * static_cast<double>(k) * step_s);
    }
    return x;
}

std::vector<double> noise(std::size_t samples, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::vector<double> x(samples);
    for (double& sample : x) {
        // Not std::uniform_real_distribution: its result is the library's choice.
        const double unit = static_cast<double>(generator() >> 11) * 0x1p-53;
        sample = signal_peak * (2.0 * unit - 1.0);
    }
    return x;
}

std::vector<double> weights(double order, std::size_t count) {
    glsum::Weights walk(order);
    std::vector<double> a(count, 1.0);
    for (std::size_t j = 1; j < count; ++j) {
        walk.next();
        a[j] = walk.weight();
    }
    return a;
}

// G(s) = 1 / (0.18234 s^1.9909 + 0.65536 s^0.98319 + 0.9992), stepped by the Grünwald-Letnikov scheme with full memory;
// y_0 = 0 and the forcing from the second sample, which leaves 5.4e-4 to the exact response: a fifteenth of a count.
std::vector<double> drive(std::size_t samples) {
    constexpr double counts_per_unit = 1000.0 / 8.0;  // 45 degrees is an eighth of a turn
    const double high = 0.18234 * std::pow(step_s, -1.9909);
    const double low = 0.65536 * std::pow(step_s, -0.98319);
    const std::vector<double> high_weights = weights(1.9909, samples);
    const std::vector<double> low_weights = weights(0.98319, samples);
    std::vector<double> y(samples, 0.0);
    for (std::size_t k = 1; k < samples; ++k) {
        double past = 0.0;
        for (std::size_t j = k; j > 0; --j) {  // oldest first: the small terms before the large ones
            past += (high * high_weights[j] + low * low_weights[j]) * y[k - j];
        }
        y[k] = (1.0 - past) / (high + low + 0.9992);
    }
    double peak = 0.0;
    for (double& sample : y) {
        sample = std::round(sample * counts_per_unit) / counts_per_unit;
        peak = std::max(peak, sample);
    }
    for (double& sample : y) {
        sample *= peak > 0.0 ? signal_peak / peak : 1.0;
    }
    return y;
}

}  // namespace

std::optional<double> sine_hz(std::string_view name) {
    if (name == "sine1") {
        return 1.0;
    }
    if (name == "sine5") {
        return 5.0;
    }
    return name == "sine50" ? std::optional(50.0) : std::nullopt;
}

std::vector<double> make_signal(std::string_view name, std::size_t samples, std::uint64_t seed) {
    if (name == "step") {
        return std::vector<double>(samples, signal_peak);
    }
    if (name == "ramp") {
        std::vector<double> x(samples, 0.0);
        for (std::size_t k = 1; k < samples; ++k) {
            x[k] = signal_peak * static_cast<double>(k) / static_cast<double>(samples - 1);
        }
        return x;
    }
    if (const auto hz = sine_hz(name)) {
        return sine(*hz, samples);
    }
    if (name == "noise") {
        return noise(samples, seed);
    }
    if (name == "drive") {
        return drive(samples);
    }
    throw std::out_of_range("no signal " + std::string(name));
}

}  // namespace bench
