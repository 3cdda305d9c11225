// How far a predicted figure may be from silicon.
#pragma once

#include <cstdint>
#include <span>

#include "qemu/timing/core_file.hpp"

namespace timing {

struct Band {
    std::int64_t low;
    std::int64_t high;
};

/// From what the rule sets of a core say of the same call: the spread of those that fit silicon, and to both sides what
/// predictions missed silicon by: `band.published_permille` where published rules decide alone, up to
/// `band.fitted_permille` as far as fitted rules change the figure and branches are guessed wrong. In whole units, no
/// wider than twice that, of the nominal figure, which lies inside; of a short figure a unit to either side.
/// \param figures  any unit, under each set of the core, in their order
/// \param guessed  of the nominal figure, what wrong guesses of branches cost: the real predictor is not published
[[nodiscard]] Band band_of(const CoreFile& core, std::span<const std::int64_t> figures, std::int64_t guessed = 0);

}  // namespace timing
