// How far the exact sums of a run are from the derivatives that they stand for, as a person reads it.
#pragma once

#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

/// One line for each order, one column for each signal with a formula: `discretisation_error_max`, which no kernel and
/// no length changes; and `discretisation_error_late_max`. Of none that no row has. Rows that are not ours are passed
/// over.
[[nodiscard]] std::string discretisation_table(const Json& context, const std::vector<Json>& rows);

}  // namespace bench
