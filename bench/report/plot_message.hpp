// What the picture of error against memory length shows, in a sentence.
#pragma once

#include <string>
#include <vector>

#include "bench/rows/groups.hpp"

namespace bench {

/// What the longest window forgets, from the order that forgets least to the one that forgets most, and what the best
/// designs leave that have fewer terms than any window; a line for gnuplot's title. Empty where either is not there.
[[nodiscard]] std::string plot_message(const std::vector<Group>& groups);

}  // namespace bench
