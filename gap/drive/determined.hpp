// What the training records tell of a candidate's numbers: an effect whose size they do not tell is known from nowhere.
#pragma once

#include <functional>
#include <string>

#include "gap/drive/fit.hpp"

namespace gap {

/// Intervals of 95 % of all that was fitted, in `low` and `high` of each number: by least squares; where a number moves
/// nothing close by (a threshold between two levels), as far as half the sum of squares rises by less than 2 units of
/// likelihood; the whole range where nothing tells. \param whitener  as it was fitted by; null: as the residuals are
void add_intervals(const Study& study, Candidate& candidate, const Whitener* whitener);

/// Of the first lasting effect that training does not tell: an interval that holds the value at which the effect is not
/// there, for every number that can take it away. Empty: all are told. \param candidate  with its intervals
/// \param needed  whether training is known to need an effect, whatever its intervals are
[[nodiscard]] std::string untold_of(const Study& study, const Candidate& candidate,
                                    const std::function<bool(const Effect&)>& needed = {});

/// Of the first lasting effect that is linear with what was fitted, and so a part of another base. Empty: there is
/// none. \param candidate  with its intervals
[[nodiscard]] std::string linear_of(const Study& study, const Candidate& candidate);

/// Whether numbers of its effects move with the base's or with a record's own in a direction that training does not
/// tell: others of them leave the same with another base.
[[nodiscard]] bool leaves_open(const Study& study, const Candidate& candidate);

/// Of a record's own numbers of an event: whether its size is told to differ from none. \param own  with intervals
/// \param least_size  a smaller one is none
[[nodiscard]] bool needs_event(const Study& study, const std::vector<FreeParameter>& own, const Effect& effect,
                               double least_size);

}  // namespace gap
