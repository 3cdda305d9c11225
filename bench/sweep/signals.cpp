#include "bench/sweep/signals.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <iterator>
#include <random>
#include <stdexcept>

#include "glsum/weights.hpp"
#include "reference/real.hpp"

namespace bench {
namespace {

using reference::Real;

// Sines and powers in 50 digits, rounded once: the last bit of the C library's own depends on which of its variants a
// processor gets, and so would every accuracy that is measured on the record.
std::vector<double> sine(double hz, std::size_t samples, double h_s) {
    reference::free_constants_with_thread();
    const Real turn = 2 * boost::math::constants::pi<Real>();
    const double period = std::round(1.0 / (hz * h_s));
    // A step that divides the period repeats, to the last bit.
    const bool whole = std::fabs(period * hz * h_s - 1.0) < 1e-12;
    const auto repeat = whole ? static_cast<std::size_t>(period) : samples;
    const Real phase = whole ? turn / repeat : turn * Real(hz) * Real(h_s);
    std::vector<double> x(samples);
    for (std::size_t k = 0; k < samples; ++k) {
        x[k] = k < repeat ? static_cast<double>(Real(signal_peak) * sin(phase * k)) : x[k - repeat];
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

// a_1 upwards, each at its place; of a_0 nobody asks.
std::vector<double> weights(double order, std::size_t count) {
    glsum::Weights walk(order);
    std::vector<double> a(count);
    for (std::size_t j = 1; j < count; ++j) {
        walk.next();
        a[j] = walk.weight();
    }
    return a;
}

// G(s) = 1 / (0.18234 s^1.9909 + 0.65536 s^0.98319 + 0.9992), stepped by the Grünwald-Letnikov scheme with full memory;
// y_0 = 0 and the forcing from the second sample, which leaves 5.4e-4 to the exact response at 1 ms: a fifteenth of a
// count. The scheme errs by its step, so that a record of larger steps is taken from one of at most 1 ms.
std::vector<double> step_response(std::size_t samples, double h_s) {
    reference::free_constants_with_thread();
    const double high = 0.18234 * static_cast<double>(pow(Real(h_s), Real(-1.9909)));
    const double low = 0.65536 * static_cast<double>(pow(Real(h_s), Real(-0.98319)));
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
    return y;
}

std::vector<double> drive(std::size_t samples, double h_s) {
    constexpr double counts_per_unit = 1000.0 / 8.0;  // 45 degrees is an eighth of a turn
    constexpr double rest_s = 20.0;                   // the count changes no more after 3 s
    h_s = std::min(h_s, rest_s);
    const auto finer = static_cast<std::size_t>(std::ceil(h_s / step_s * (1.0 - 1e-9)));
    const double fine_s = h_s / static_cast<double>(finer);
    const double needed = std::min(static_cast<double>(samples * finer), rest_s / fine_s);
    const std::vector<double> fine = step_response(static_cast<std::size_t>(needed), fine_s);
    std::vector<double> y(samples);
    double peak = 0.0;
    for (std::size_t k = 0; k < samples; ++k) {
        y[k] = std::round(fine[std::min(k * finer, fine.size() - 1)] * counts_per_unit) / counts_per_unit;
        peak = std::max(peak, y[k]);
    }
    for (double& sample : y) {
        sample *= peak > 0.0 ? signal_peak / peak : 1.0;
    }
    return y;
}

}  // namespace

std::string_view meaning_of_signal(std::string_view name) {
    // In the order of the names.
    constexpr std::string_view meanings[] = {
        "0.9 from the first sample on",
        "from 0 to 0.9 at the last sample",
        "a sine of 1 Hz, 0.9 high",
        "a sine of 5 Hz, 0.9 high",
        "a sine of 50 Hz, 0.9 high",
        "white noise, uniform on [-0.9, 0.9), the same on every machine",
        "the step response of the seed paper's drive, as its encoder counts it",
    };
    static_assert(std::size(meanings) == std::size(signal_names));
    const auto found = std::find(std::begin(signal_names), std::end(signal_names), name);
    if (found == std::end(signal_names)) {
        throw std::out_of_range("no signal is called " + std::string(name));
    }
    return meanings[found - std::begin(signal_names)];
}

std::optional<double> sine_hz(std::string_view name) {
    if (name == "sine1") {
        return 1.0;
    }
    if (name == "sine5") {
        return 5.0;
    }
    return name == "sine50" ? std::optional(50.0) : std::nullopt;
}

bool can_be_sampled(std::string_view name, double h_s) { return sine_hz(name).value_or(0.0) * h_s < 0.5; }

std::vector<double> make_signal(std::string_view name, std::size_t samples, std::uint64_t seed, double h_s) {
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
        return sine(*hz, samples, h_s);
    }
    if (name == "noise") {
        return noise(samples, seed);
    }
    if (name == "drive") {
        return drive(samples, h_s);
    }
    throw std::out_of_range("no signal " + std::string(name));
}

}  // namespace bench
