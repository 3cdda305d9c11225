// A heated body with losses, perhaps a wall around it, a heater and a thermometer.
//
//   C1 T1' = P - Gc (T1 - T2) - G1 (T1 - Ta) - R ((T1 + 273.15)^4 - (Ta + 273.15)^4) - disturbance
//   C2 T2' = Gc (T1 - T2) - G2 (T2 - Ta)
//
// Runge and Kutta's method of fourth order on a grid far finer than the samples; what switches does so between its
// steps. Shares no code with the diagnosis nor with the other families.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "drive/stand/blind/plant.hpp"

namespace stand::thermal {

inline constexpr double without_bound = std::numeric_limits<double>::infinity();

struct Oven {
    // What it is made of.
    double body_j_per_k = 0.0;  ///< has to be given
    double body_loss_w_per_k = 0.0;
    double wall_j_per_k = 0.0;  ///< 0: there is none
    double wall_loss_w_per_k = 0.0;
    double coupling_w_per_k = 0.0;
    double power_w_per_unit = 0.0;  ///< of the input
    double delay_s = 0.0;
    double heater_tau_s = 0.0;  ///< 0: at once
    double sensor_tau_s = 0.0;
    double ambient_c = 20.0;
    double start_c = 20.0;  ///< of body, wall and thermometer; the heater is off

    // What may be there besides.
    double input_limit = without_bound;
    double dead_zone = 0.0;
    double threshold = 0.0;
    double curvature = 0.0;  ///< of the power over the input, which is as it should be at `curve_reference`
    double curve_reference = 1.0;
    double rate_per_s = without_bound;  ///< of the input, soft start
    double gain_growth_per_s = 0.0;
    double radiation_w_per_k4 = 0.0;
    double ambient_drift_k_per_s = 0.0;
    double ambient_swing_k = 0.0;
    double ambient_period_s = 1.0;
    double disturbance_w = 0.0;  ///< heat that is lost besides, from .. to
    double disturbance_from_s = 0.0;
    double disturbance_to_s = 0.0;
    double falling_tau_s = 0.0;  ///< of the thermometer where it falls; 0: as where it rises
    double mains_share = 0.0;    ///< the power swings by this share
    double mains_period_s = 1.0;
    double fan_share = 0.0;  ///< the body loses so much more while the fan runs
    double fan_on_c = 0.0;
    double fan_off_c = 0.0;
    double melting_share = 0.0;  ///< the body stores so many times more heat where it melts
    double melting_c = 0.0;
    double melting_width_k = 1.0;
};

/// What the thermometer shows. \param at_s  rise \param step_s  of the grid, the largest
[[nodiscard]] std::vector<double> measure(const Oven& oven, const blind::Held& held, std::span<const double> at_s,
                                          double step_s);

/// Loss for each degree in the long run, without radiation.
[[nodiscard]] double static_loss_w_per_k(const Oven& oven);

}  // namespace stand::thermal
