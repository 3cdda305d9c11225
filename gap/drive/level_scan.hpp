// Where among the input's levels something begins to act.
#pragma once

#include <functional>

#include "gap/drive/effect.hpp"

namespace gap {

struct LevelPlace {
    double level;    ///< |u|
    double squares;  ///< what the reading leaves there
};

/// Of the places half-way between neighbouring levels of |u|, 0 among them, that one where the reading is told best by
/// the response with a gain and an offset of its own: those of the base were fitted without the effect, and take part
/// of it up. Of more than 24 places as many, spread evenly over the samples. \param add  puts the effect at a level
/// into a scenario
[[nodiscard]] LevelPlace scan_levels(const Clue& clue, const std::function<void(Scenario&, double)>& add);

}  // namespace gap
