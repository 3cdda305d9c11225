// Scales of training records of which no two are alike, nor products of few of them.
#pragma once

#include <numbers>

#include "gap/drive/effect.hpp"

namespace scales_test {

constexpr double u = 1.7;         // the greatest input
constexpr double low = -1.1;      // of the readings
constexpr double high = 2.9;      //
constexpr double span = 4.0;      //
constexpr double far = 2.9;       // from 0
constexpr double speed = 0.83;    //
constexpr double force = 6.1;     //
constexpr double length = 130.0;  // s
constexpr double dt = 0.07;       // s
constexpr double tc = 0.9;        // s, the time constant
constexpr double pi = std::numbers::pi;

inline gap::Scales scales() {
    gap::Scales all{};
    all.input_max = u;
    all.output_low = low;
    all.output_high = high;
    all.output_span = span;
    all.output_max = far;
    all.speed_max = speed;
    all.force = force;
    all.length_s = length;
    all.interval_s = dt;
    all.time_constant_s = tc;
    all.orders = 2;
    all.input_levels = 9;
    all.steady = true;
    return all;
}

}  // namespace scales_test
