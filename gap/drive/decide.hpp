// From a ranking to a verdict.
#pragma once

#include "gap/drive/decide/decision.hpp"
#include "gap/drive/ranking.hpp"

namespace gap {

/// All rules (decide/rule.hpp), one after the other.
/// \param ranking  the best first, `none` among them
/// \param whitener  of the ranking's likelihoods
[[nodiscard]] Decision decide(const std::vector<Ranked>& ranking, const Whitener& whitener, const Study& study,
                              const Study& validation, bool same_records);

}  // namespace gap
