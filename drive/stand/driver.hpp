// What reaches the motor: the command as the driver (ESC) passes it on, in pieces of constant slope.
#pragma once

#include <span>
#include <vector>

#include "drive/stand/stand.hpp"

namespace stand {

/// A duty that is commanded from `time_s` on.
struct Command {
    double time_s;
    double duty;
};

/// From `time_s` to the next piece the driver puts out level + slope_per_s (t - time_s).
struct Piece {
    double time_s;
    double level;
    double slope_per_s;
};

/// Delay, start-up, threshold, dead zone, limit and slope of the driver, in that order. The first piece is at 0.
/// \param commands  times rise; 0 before the first
[[nodiscard]] std::vector<Piece> drive_motor(const Stand& stand, std::span<const Command> commands);

}  // namespace stand
