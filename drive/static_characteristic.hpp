// The static characteristic of a plant: where its output comes to rest for each level of the input, from a log with
// holds.
#pragma once

#include <string>
#include <vector>

#include "drive/log.hpp"
#include "drive/pictures.hpp"

namespace drive {

/// One hold of the input, judged by its last quarter.
struct Level {
    double input;
    double output;     ///< mean of the last quarter of the hold
    double deviation;  ///< standard deviation there
    double from_s;     ///< of the hold
    double to_s;
    double drift;  ///< how much the mean of the last eighth differs from that of the eighth before
    bool settled;  ///< the drift is at most a fiftieth of the output's whole range
    bool rising;   ///< the input came from below, or from 0
};

struct StaticCharacteristic {
    std::vector<Level> levels;  ///< in order of time
    double slope = 0.0;         ///< of the straight line through the settled levels, least squares
    double intercept = 0.0;
    double largest_bend = 0.0;  ///< how far a settled level is from that line, over the range of the settled outputs
};

/// \param shortest_s  holds that are shorter are passed over
/// \throws glsum::Failure (bad input) where no hold is long enough or none has settled, or there is no input
[[nodiscard]] StaticCharacteristic static_characteristic(const Log& log, double shortest_s);

/// For people: a line a level, and the straight line.
[[nodiscard]] std::string to_text(const StaticCharacteristic& found);

/// CSV: input, output, deviation, from_s, to_s, settled, rising.
[[nodiscard]] std::string to_csv(const StaticCharacteristic& found);

/// The settled levels, up and down apart, and the line.
[[nodiscard]] base::Picture picture_of_characteristic(const StaticCharacteristic& found, const std::string& title);

}  // namespace drive
