// Where the gap lies: in which kernels and placements, and whether it grows with the length.
#pragma once

#include "gap/cycles/evidence.hpp"

namespace gap::cycles {

/// Shares of the rows that judge, each list by size; they sum to 1.
struct Location {
    std::vector<Share> kernels, placements, lines;  ///< lines: slope and constant
};
[[nodiscard]] Location locate(const Evidence& evidence, const Cycles& base);

}  // namespace gap::cycles
