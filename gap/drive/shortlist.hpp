// Which candidates of many are gone on with.
#pragma once

#include <vector>

#include "gap/drive/ranking.hpp"

namespace gap {

/// Keeps the sets that are fitted to the end: the eight best, beside a form the two best of each lead. What follows any
/// misfit there (a delay that swings, and events, which are located in each record) would fill the list: two with
/// events are kept in all.
/// \param sets  the best first, each a lead's effects and one more
void keep_finalists(std::vector<Candidate>& sets, bool beside_form);

/// What partners are tried with, of so many effects: the two best by what was not fitted, and the two by what was.
/// \param more  five of either \param with_steps  those, too, whose readings are rounded
[[nodiscard]] std::vector<const Ranked*> leads_of(const std::vector<Ranked>& ranking, std::size_t size, bool more,
                                                  bool with_steps);

}  // namespace gap
