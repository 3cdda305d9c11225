// A mechanical plant as it is drawn, moved and read: the stand's own physics, or a linear plant of whole or fractional
// orders.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drive/stand/blind/effects.hpp"
#include "drive/stand/blind/profile.hpp"

namespace stand::blind {

/// A plant without effects, the grid it is stepped on, and how it is written down.
struct Mechanical {
    Setup setup;
    std::string kind;   ///< `stand`, `whole`, `fractional`
    std::string model;  ///< JSON
    double tau_s = 1.0;
    double step_s = 0.001;
    Clock clock;
};

/// \param physical  the stand; otherwise a linear plant, of fractional orders where that is asked for
[[nodiscard]] Mechanical draw_mechanical(bool physical, bool fractional, Chance& chance);

/// A record before the sensor's own faults: when its samples were taken, and what there was to read.
struct Moved {
    std::vector<double> at_s;
    std::vector<double> z;
};

/// \param setup  of the plant `base`, with effects
[[nodiscard]] Moved move_record(const Mechanical& base, const Setup& setup, const Held& held, std::uint64_t seed);

/// What the acquisition makes of it. \param noise  empty: none
[[nodiscard]] std::vector<double> acquire(const Setup& setup, const Moved& moved, const std::vector<double>& noise,
                                          std::uint64_t seed);

}  // namespace stand::blind
