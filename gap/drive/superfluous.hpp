// Causes that stand in for numbers which training hardly tells.
#pragma once

#include "gap/drive/decide/decision.hpp"
#include "gap/drive/question.hpp"
#include "gap/drive/ranking.hpp"

namespace gap {

/// Beside a base that was found: of several causes one goes if the others do as well once they are fitted to the
/// validation, too. What it took was what their numbers were off by. So do the causes that alternatives differ by, if
/// what they share does as well.
void drop_superfluous(const Question& question, const Ground& ground, const std::vector<Ranked>& ranking,
                      const Whitener& whitener, Decision& decision);

}  // namespace gap
