// Which of some values an effect would best start at: for effects whose misfit has steps in it.
#pragma once

#include <vector>

#include "gap/drive/effect.hpp"

namespace gap {

/// Of the candidates, values in the order of the effect's parameters, that which leaves the smallest sum of squares.
/// \param add_to  the effect's
[[nodiscard]] std::vector<double> best_of(const Clue& clue, const std::vector<std::vector<double>>& candidates,
                                          void (*add_to)(Scenario& scenario, std::span<const double> values));

}  // namespace gap
