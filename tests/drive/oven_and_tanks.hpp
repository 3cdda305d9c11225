// What an oven's thermometer and a tank's gauge show of an input that is held.
#pragma once

#include <utility>
#include <vector>

#include "drive/stand/blind/hydraulic/tanks.hpp"
#include "drive/stand/blind/thermal/oven.hpp"

namespace oven_and_tanks {

using stand::blind::Held;
using stand::hydraulic::Tanks;
using stand::thermal::Oven;

/// Levels from their times on, held.
inline Held levels(const std::vector<std::pair<double, double>>& changes) {
    Held held;
    for (const auto& [time_s, level] : changes) {
        held.time_s.push_back(time_s);
        held.input.push_back(level);
    }
    return held;
}

inline double warmed(const Oven& oven, const Held& held, double at_s, double step_s = 0.005) {
    return stand::thermal::measure(oven, held, std::vector{at_s}, step_s).front();
}
inline double filled(const Tanks& tanks, const Held& held, double at_s, double step_s = 0.002) {
    return stand::hydraulic::gauge(tanks, held, std::vector{at_s}, step_s).front();
}

}  // namespace oven_and_tanks
