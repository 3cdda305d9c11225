// From the base to what was found: which step takes how much of the gap.
#pragma once

#include "gap/cycles/evidence.hpp"

namespace gap::cycles {

/// The step that takes off most comes first. \param fitted  whose costs beside the call are resampled
/// \param cost_worth  cycles that a call's cost must differ by to be a step
[[nodiscard]] std::vector<Step> steps_to(Evidence& evidence, const State& found, State now, const State& fitted,
                                         double cost_worth);

}  // namespace gap::cycles
