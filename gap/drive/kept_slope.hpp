// A fitted base beside an effect that stiffens it.
#pragma once

#include <optional>

#include "gap/drive/candidate.hpp"

namespace gap {

/// The candidate with what of the slope is its new effects' taken out of the base's numbers, so that both together have
/// the slope at the records' mean that the base had alone: a drag's base is its slope at rest, several times as slow as
/// what is seen at speed, and a fit that moves one number after the other finds no way there. None: the base is given,
/// or no effect that the start has not adds to it (Effect::slope).
[[nodiscard]] std::optional<Candidate> with_slope_kept(const Study& study, const Candidate& candidate,
                                                       const Candidate& start);

/// With the operating point at 0, where a new effect counts from (Effect::from_zero), and a gain that keeps the mean
/// output. None: nothing new does.
[[nodiscard]] std::optional<Candidate> counted_from_zero(const Study& study, const Candidate& candidate,
                                                         const Candidate& start);

}  // namespace gap
