// The motion of the bar: ordinary differential equations with events, each of which is met at its own time.
#pragma once

#include <span>
#include <vector>

#include "drive/stand/driver.hpp"
#include "drive/stand/stand.hpp"

namespace stand {

enum class EventKind {
    reversal,  ///< the bar's speed passes through 0
    sticks,    ///< it comes to rest, held by friction
    breaks_loose,
    impact,  ///< on a stop; `speed` is the speed before
    rests,   ///< stays on a stop
    leaves_stop,
};

struct Event {
    double time_s;
    EventKind kind;
    double angle_rad;
    double speed_rad_per_s;
};

/// The state at one time.
struct Point {
    double time_s;
    double angle_rad;
    double speed_rad_per_s;
    double rotor;        ///< speed of the first motor, 1 at full duty and full voltage
    double charge;       ///< integral of the duty at the motor
    double reading_rad;  ///< what the encoder's axle shows: backlash, lags and the bar's own swing included
};

struct Motion {
    std::vector<Point> points;
    std::vector<Event> events;
};

/// Where the bar is at the start; at rest, the motors off.
struct Start {
    double angle_rad = 0.0;
    double charge = 0.0;  ///< drawn from the battery by earlier runs
};

/// Integrates from 0 to the last of `times_s` (which do not fall) by Dormand and Prince's method with dense output
/// (Boost.Odeint), local errors of 1e-11; events are located to 1e-13 s on the dense output.
/// \throws glsum::Failure (bad input) for a start beyond a stop, (check failed) beyond 10^6 events.
[[nodiscard]] Motion move(const Stand& stand, std::span<const Piece> pieces, const Start& start,
                          std::span<const double> times_s);

}  // namespace stand
