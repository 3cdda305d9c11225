// One or two tanks in a row, a pump or a valve that fills the first, outflow at the bottom, a gauge on the last.
//
//   A1 h1' = inflow - out(h1)            out(h) = k H ((1 - r) h/H + r sqrt(h/H))
//   A2 h2' = out(h1) - out(h2) + disturbance
//
// r = 0 is a long pipe, whose outflow is proportional to the level, r = 1 a hole (Torricelli's law); both are the same
// at the level H. Stepped by Heun's method on a grid far finer than the samples; a tank that is full or empty stays so
// at its bound. Shares no code with the diagnosis nor with the other families.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "drive/stand/blind/plant.hpp"

namespace stand::hydraulic {

inline constexpr double brimless = std::numeric_limits<double>::infinity();

struct Tanks {
    // What they are made of.
    bool two = false;
    double first_area_cm2 = 0.0;
    double area_cm2 = 0.0;  ///< has to be given; of the last, which is the only one without a second
    double first_outflow_cm2_per_s = 0.0;
    double outflow_cm2_per_s = 0.0;
    double reference_cm = 0.0;     ///< H, has to be given
    double inflow_per_unit = 0.0;  ///< cm^3/s for each unit of the input
    double pump_tau_s = 0.0;       ///< 0: at once
    double delay_s = 0.0;
    double sensor_tau_s = 0.0;
    double start_cm = 0.0;  ///< of all levels

    // What may be there besides.
    double input_limit = brimless;
    double dead_zone = 0.0;
    double threshold = 0.0;
    double curvature = 0.0;  ///< of the inflow over the input
    double curve_reference = 1.0;
    double rate_per_s = brimless;
    double stiction_band = 0.0;  ///< the valve moves when the input is so far from it, and then all the way
    double play_width = 0.0;     ///< of the valve's linkage
    double play_share = 0.0;     ///< of the flow that the linkage moves
    double delay_depth_s = 0.0;  ///< the delay swings up to this above `delay_s`
    double delay_period_s = 1.0;
    double gain_growth_per_s = 0.0;
    double root_share = 0.0;             ///< r
    double overflow_cm = brimless;       ///< of the last tank
    double disturbance_cm3_per_s = 0.0;  ///< what leaks besides, from .. to
    double disturbance_from_s = 0.0;
    double disturbance_to_s = 0.0;
    double upper_area_share = 0.0;  ///< the last tank is so much wider above `wider_from_cm`
    double wider_from_cm = 0.0;
    double siphon_cm3_per_s = 0.0;  ///< drains from `siphon_on_cm` until `siphon_off_cm`
    double siphon_on_cm = 0.0;
    double siphon_off_cm = 0.0;
    double pulsing_cm3_per_s = 0.0;  ///< somebody else's inflow, which swings
    double pulsing_period_s = 1.0;
    double priming_s = 0.0;      ///< the pump runs dry so long whenever it starts
    double bubbles_share = 0.0;  ///< the flow falls by this while bubbles pass, at random times
    double bubbles_s = 1.0;      ///< how long, on average, with and without
    std::uint64_t bubbles_seed = 0;
};

/// What the gauge on the last tank shows. \param at_s  rise \param step_s  of the grid, the largest
[[nodiscard]] std::vector<double> gauge(const Tanks& tanks, const blind::Held& held, std::span<const double> at_s,
                                        double step_s);

}  // namespace stand::hydraulic
