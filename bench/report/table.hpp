// Results as a person reads them.
#pragma once

#include <string>
#include <vector>

#include "bench/rows/groups.hpp"

namespace bench {

/// One table for each order and length, kernels by error. \param colour  for a terminal
[[nodiscard]] std::string to_table(const std::vector<Group>& groups, bool colour);

}  // namespace bench
