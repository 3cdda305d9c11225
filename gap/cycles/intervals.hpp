// How sure the numbers of causes are.
#pragma once

#include <vector>

#include "gap/cycles/evidence.hpp"

namespace gap::cycles {

/// 95 % of what each cost, clock and share of `found` comes out as when rows are drawn again, and to both sides what
/// half a cycle of a row makes of it: counters are whole. A switch is no number, and has none.
void add_intervals(Evidence& evidence, const State& found, std::vector<Step>& steps);

}  // namespace gap::cycles
