// The gate: a run held against a baseline, layer by layer.
#pragma once

#include "bench/gate/rules.hpp"
#include "bench/gate/verdict.hpp"
#include "bench/rows/result_file.hpp"

namespace bench::gate {

/// The globs of the rows that a baseline keeps: its context's `baseline_rows`, or everything.
[[nodiscard]] std::vector<std::string> selection_of(const Json& context);

/// Judges `current` by the rules. Status of the verdict: not_comparable where conditions differ that make the numbers
/// mean something else (nothing is judged then), check_failed where a rule that fails is broken, a row is lost or
/// wrong, good otherwise. \throws glsum::Failure (bad input) when no rule speaks of anything in the baseline: such a
/// gate could not fail.
[[nodiscard]] Verdict judge(const Results& baseline, const Results& current, const Rules& rules);

}  // namespace bench::gate
