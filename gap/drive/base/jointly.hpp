// A base fitted to training and validation at once: what it then leaves of the validation needs no further effect.
#pragma once

#include "gap/drive/question.hpp"
#include "gap/drive/ranking.hpp"

namespace gap {

/// The gap on what validates, of the question's form without any effect, when nothing is kept aside. Numbers that
/// training hardly tells (a record that ends before the plant has settled) are told here, and a gap that goes was
/// theirs.
[[nodiscard]] double joint_gap(const Question& question);
/// The same with a candidate's effects, begun from its numbers.
[[nodiscard]] double joint_gap(const Question& question, const Ranked& with);

}  // namespace gap
