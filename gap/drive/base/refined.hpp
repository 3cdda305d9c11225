// A start that noise and a filter chosen beforehand have bent, made better.
#pragma once

#include <optional>
#include <vector>

#include "gap/drive/base/structure.hpp"
#include "gap/drive/record.hpp"

namespace gap {

/// The same equation as filtered_estimates', filtered by 1 / A(s) of the last solution, A(s) the denominator, again and
/// again: where it settles, white noise of the readings does not bias it [Steiglitz1965, Young1980]. A plant that
/// swings is found so to a part of its width, where a filter of lags leaves one of another frequency. The dead time
/// stays. Nothing: the structure integrates, is fractional or has nothing to put in, or no iteration has positive,
/// stable lags.
[[nodiscard]] std::optional<Coefficients> refined(const Structure& structure, const std::vector<Record>& records,
                                                  const Coefficients& start);

}  // namespace gap
