#include "drive/stand/blind/profile.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace stand::blind {
namespace {

using Shape = std::function<double(double t)>;  // t since the rest at the beginning; 1 is the highest

// Levels that are held for the times given, over and over.
Shape held_levels(std::vector<double> from_s, std::vector<double> level) {
    return [from_s = std::move(from_s), level = std::move(level)](double t) {
        const auto after = std::upper_bound(from_s.begin(), from_s.end(), t);
        return level[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - from_s.begin(), 1) - 1)];
    };
}

Shape shape_of(const std::string& kind, double until_s, double tau_s, Chance& chance) {
    std::vector<double> from_s;
    std::vector<double> level;
    if (kind == "step") {
        return [](double) { return 1.0; };
    }
    if (kind == "ramp") {
        const double turns = 1.0 + static_cast<double>(chance.below(3));
        return [=](double t) { return 1.0 - std::fabs(2.0 * std::fmod(turns * t / until_s, 1.0) - 1.0); };
    }
    if (kind == "chirp") {
        const double from_hz = 0.02 / tau_s;
        const double rate = std::log(chance.between(8.0, 20.0)) / until_s;
        const double swing = chance.between(0.3, 0.5);
        return [=](double t) {
            const double turns = from_hz * std::expm1(rate * t) / rate;
            return 1.0 - swing - swing * std::cos(2.0 * std::numbers::pi * turns);
        };
    }
    const double low = kind == "prbs" ? chance.between(0.2, 0.5) : 0.0;
    const double bit_s = tau_s * chance.between(0.7, 2.0);
    const int stairs = 4 + static_cast<int>(chance.below(3));
    const double on_s = std::min(tau_s * chance.between(6.0, 14.0), 0.4 * until_s);
    double t = 0.0;
    for (int k = 0; t < until_s; ++k) {
        double value = 0.0;
        double for_s = 0.0;
        if (kind == "on_off") {
            value = k % 2 == 0 ? 1.0 : 0.0;
            for_s = on_s;
        } else if (kind == "staircase") {
            const int place = k % (2 * stairs) + 1;
            value = static_cast<double>(std::min(place, 2 * stairs - place)) / stairs;
            for_s = std::min(until_s / (2.0 * stairs), std::max(8.0 * tau_s, until_s / (6.0 * stairs)));
        } else if (kind == "levels") {
            value = chance.happens(0.15) ? 0.0 : 0.01 * std::round(chance.between(15.0, 100.0));
            for_s = tau_s * chance.between(3.0, 8.0);
        } else {
            value = chance.happens(0.5) ? 1.0 : low;
            for_s = bit_s;
        }
        from_s.push_back(t);
        level.push_back(value);
        t += for_s;
    }
    return held_levels(std::move(from_s), std::move(level));
}

}  // namespace

const std::vector<std::string>& profile_kinds() {
    static const std::vector<std::string> kinds{"step", "on_off", "staircase", "levels", "ramp", "chirp", "prbs"};
    return kinds;
}

bool has_one_level(const std::string& kind) { return kind == "step" || kind == "on_off"; }

Held make_profile(const std::string& kind, const Clock& clock, double high, double tau_s, Chance& chance) {
    Held held;
    const double rest_s = chance.between(0.01, 0.04) * clock.until_s;
    const Shape shape = shape_of(kind, clock.until_s - rest_s, tau_s, chance);
    const auto count = static_cast<std::size_t>(std::floor(clock.until_s / clock.interval_s + 1e-9)) + 1;
    for (std::size_t k = 0; k < count; ++k) {
        const double spread_s = chance.around(clock.spread_s);
        const double t = static_cast<double>(k) * clock.interval_s + (k == 0 ? 0.0 : spread_s);
        held.time_s.push_back(std::round(t * 1e6) / 1e6);
        const double u = held.time_s.back() < rest_s ? 0.0 : shape(held.time_s.back() - rest_s);
        held.input.push_back(high * std::round(1e4 * u) / 1e4);
    }
    return held;
}

}  // namespace stand::blind
