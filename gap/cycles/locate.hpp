// Where the gap lies: in which kernels and placements, and whether it grows with the length.
#pragma once

#include "gap/cycles/evidence.hpp"

namespace gap::cycles {

/// Of the rows that judge; each list sums to 1.
[[nodiscard]] WhereInRows locate(const Evidence& evidence, const Cycles& base);

}  // namespace gap::cycles
