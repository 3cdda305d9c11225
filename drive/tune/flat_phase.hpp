// Gains from what the loop is to be at one frequency.
#pragma once

#include <optional>

#include "drive/tune/loop.hpp"

namespace tune {

/// |L| = 1 at `crossover`, arg L = -pi + `margin_rad`, and d arg L / d ln w = `slope_rad` there; a slope of 0 is the
/// flat phase of [Monje2008].
struct Target {
    double crossover;  ///< rad/s, at most Nyquist's
    double margin_rad;
    double slope_rad;
};

/// The plant at one frequency; kept, since many orders are tried there.
struct PlantPoint {
    double w;
    Complex value;
    double phase_slope;  ///< d arg P* / d ln w
};
[[nodiscard]] PlantPoint point_of(const SampledPlant& plant, double w);

/// For given orders and filter all three conditions are linear in kp, ki and kd, so that there is one solution or none.
/// \param orders  its gains are not read  \return with their gains; nothing where the equations have no solution
[[nodiscard]] std::optional<drive::Gains> gains_for(const Target& target, drive::Gains orders, const PlantPoint& plant,
                                                    double step_s);

}  // namespace tune
