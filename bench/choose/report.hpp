// The answer as a person reads it, and as JSON.
#pragma once

#include <string>

#include "bench/choose/question.hpp"

namespace choose {

/// \param colour  for a terminal
[[nodiscard]] std::string to_table(const Answer& answer, bool colour);

/// {"schema": "glsum-choice-1", ...}
[[nodiscard]] bench::Json to_json(const Answer& answer);

/// What a candidate costs, with its unit.
[[nodiscard]] std::string cost_text(const Answer& answer, const Candidate& candidate);

/// The share of the time between two samples, in words; empty without `clock_hz` and `rate_hz`.
[[nodiscard]] std::string budget_share(const Answer& answer, const Candidate& candidate);

/// The nearest miss in one sentence; empty when something fits.
[[nodiscard]] std::string nearest_miss(const Answer& answer);

}  // namespace choose
