// What was asked of a derivative, and what it came to, in words and as JSON.
#pragma once

#include <string>

#include "bench/choose/derivative_errors.hpp"
#include "bench/rows/row.hpp"

namespace choose {

/// ", from 0.05 to 80 Hz, a step from 0.01 s until 60 s"
[[nodiscard]] std::string extent(const glsum::design::DerivativeGoal& goal);

/// Two lines: where a choice may be used and within what, rounded up, and what running it gave.
[[nodiscard]] std::string use_of(const DerivativeReport& report, const glsum::design::DerivativeGoal& goal);

/// `band_error`, `worst_hz`, `step_error`, `worst_s`: those that the goal asks for.
[[nodiscard]] bench::Json to_json(const glsum::design::DerivativeError& error,
                                  const glsum::design::DerivativeGoal& goal);

}  // namespace choose
