// Whether what comes again by itself does so with the input. A network's wave, a queue's, does not wait for the input:
// what is in step with it is something that the drive does at its moves.
#pragma once

#include <optional>
#include <string>

#include "gap/drive/candidate.hpp"

namespace gap {

/// After how long an input makes the same moves again, from one level to another: two of them or more, all as far apart
/// to a fiftieth. Nothing: it does not.
[[nodiscard]] std::optional<double> input_period_s(const Record& record);

/// Of the first effect with a period (Effect::period_s) that is, to a fiftieth, the input's in a training record.
/// Empty: there is none.
[[nodiscard]] std::string in_step_with_input(const Study& study, const Candidate& trained);

}  // namespace gap
