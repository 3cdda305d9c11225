// What a sensor's noise does not do: come in bursts, or as a wave.
#pragma once

#include <cstddef>
#include <span>

#include "gap/drive/record.hpp"

namespace gap {

struct Burst {
    double ratio = 0.0;  ///< mean square of the loudest stretch over that of the median one; 0: too few stretches
    double at_s = 0.0;   ///< where the loudest begins
};

/// Stationary noise, white or with neighbours that correlate by 0.97, stays below 20.
/// \param counts  whether a sample counts: a stretch in which one does not is left out
/// \param stretch_s  how long each is; at least ten samples
/// \param least_square  what each holds at least: of a quantum, or of rounding
[[nodiscard]] Burst loudest_burst(const Record& record, std::span<const double> residuals, std::span<const char> counts,
                                  double stretch_s, double least_square);

struct Wave {
    double hz = 0.0;
    /// Power of its line over the median of the third to the fifteenth below or above, the greater; 0: too short a
    /// record.
    double over_neighbours = 0.0;
    double share = 0.0;  ///< of the squares, the mean left out
};

/// The line of the spectrum that stands out most, of at least six waves in the record. Noise of any colour stays below
/// 50. Stamps are taken as even.
[[nodiscard]] Wave clearest_wave(const Record& record, std::span<const double> values);
/// The same at a given frequency, or a line beside it.
[[nodiscard]] Wave wave_at(const Record& record, std::span<const double> values, double hz);

}  // namespace gap
