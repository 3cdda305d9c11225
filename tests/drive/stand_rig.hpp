// A stand of nothing but inertia and weight, and what the tests of stands ask of its events and errors.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "drive/stand/motion.hpp"
#include "drive/stand/stand.hpp"

namespace test {

// Nothing but inertia, weight and what a test adds.
inline stand::Stand bare() {
    stand::Stand built;
    for (const std::string& effect : stand::effects()) {
        stand::remove_effect(built, effect);
    }
    built.damping_n_m_s = 0.0;
    built.delay_s = 0.0;
    built.spread_s = 0.0;
    return built;
}

inline std::vector<double> times(double until_s, double step_s) {
    std::vector<double> all;
    for (double k = 0; k * step_s <= until_s + 1e-12; ++k) {
        all.push_back(k * step_s);
    }
    return all;
}

inline std::vector<double> times_of(const std::vector<stand::Event>& events, stand::EventKind kind) {
    std::vector<double> found;
    for (const stand::Event& event : events) {
        if (event.kind == kind) {
            found.push_back(event.time_s);
        }
    }
    return found;
}

inline std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "no failure";
}

}  // namespace test
