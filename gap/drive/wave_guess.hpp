// Where a wave of unknown rate and phase would start: for effects that go with a sine of the time or of the place.
#pragma once

#include <functional>
#include <span>

#include "gap/drive/effect.hpp"

namespace gap {

struct WaveGuess {
    double size = 0.0;
    double rate = 0.0;
    double phase_rad = 0.0;
};

/// Of the rates the one at which a wave takes most of the residuals' squares, with its size and phase, as far as the
/// readings go with the size. \param add  a wave to a scenario \param small  a size for which they do
[[nodiscard]] WaveGuess guess_wave(const Clue& clue, std::span<const double> rates, double small,
                                   const std::function<void(Scenario& scenario, const WaveGuess& wave)>& add);

}  // namespace gap
