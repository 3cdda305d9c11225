// What a loop's frequency response says: is it stable, and how far from not being so?
#pragma once

#include "drive/tune/loop.hpp"

namespace tune {

struct Margins {
    int unstable_poles = 0;        ///< of the closed loop, by the argument principle; -1: L passes through -1
    int crossings = 0;             ///< of |L| = 1
    double crossover = 0.0;        ///< rad/s: the highest with |L| = 1; 0 without one
    double phase_deg = 180.0;      ///< the least phase margin of all crossings
    double gain = INFINITY;        ///< the least factor above 1 that L may be raised by, where its phase is -180
    double phase_crossover = 0.0;  ///< rad/s, of that
    double sensitivity = 0.0;      ///< max |1 / (1 + L)|
    double sensitivity_at = 0.0;   ///< rad/s
    double complementary = 0.0;    ///< max |L / (1 + L)|
    double phase_slope = 0.0;      ///< d arg L / d ln w at the crossover, rad
    [[nodiscard]] bool stable() const { return unstable_poles == 0; }
};

/// From a dense sweep: steps of a hundredth of the frequency and of 0.05 rad of the dead time's phase, as long as |L|
/// can matter. Peaks and crossings are found between them to 1e-9.
///
/// Unstable poles: the turn of arg (1 + L) along the axis, from -pi/2 times the integrations at 0 to Nyquist's
/// frequency, over -pi. Where 1 + L is below 0 just right of z = 1, for gains against the plant's sign, it begins half
/// a turn on. Plant and controller have no poles outside the circle of their own.
[[nodiscard]] Margins margins_of(const SampledPlant& plant, const Response& controller);
[[nodiscard]] Margins margins_of(const Loop& loop);

}  // namespace tune
