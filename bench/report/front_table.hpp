// What a run ends with on a terminal: the answer, on one screen.
#pragma once

#include <string>
#include <vector>

#include "bench/report/curves.hpp"

namespace bench::report {

/// For each order the cheapest kernel within each decade of error, over all lengths, and what that saves beside the
/// cheapest window, within 1e-2 and 1e-4; by the cost that decides (`deciding_cost`). Lines of at most 120 columns.
/// Empty for a run without errors or costs.
[[nodiscard]] std::string front_table(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs);

}  // namespace bench::report
