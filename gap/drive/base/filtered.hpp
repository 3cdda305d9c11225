// First values of a linear description, from the records alone.
#pragma once

#include <vector>

#include "gap/drive/base/structure.hpp"
#include "gap/drive/record.hpp"

namespace gap {

/// The differential equation between input and output holds for both of them filtered alike [Young1981]: filtered by
/// 1 / (1 + filter_s s)^order their derivatives are sums of the filter's stages, and the coefficients are a linear
/// least-squares solution. What the filter had seen before the record, and a constant force or offset of each record,
/// are further columns. Noise biases the result, by more for a faster filter: it is a start for fits of simulations.
/// Empty: the equations have no solution with a finite gain and positive lags.
[[nodiscard]] std::vector<Coefficients> filtered_estimates(const Structure& structure,
                                                           const std::vector<Record>& records, bool driven);

}  // namespace gap
