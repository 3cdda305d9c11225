// Which effects a core pays, by what the rows say.
#pragma once

#include "gap/cycles/evidence.hpp"

namespace gap::cycles {

/// Whether a gap has fallen by enough to believe in what closed it.
[[nodiscard]] bool better(double now, double before);

/// From a reference that pays everything, without what these rows do not show or speak against; other costs of effects,
/// another clock, others on the bus. One cause for all rows comes before several.
[[nodiscard]] State search(Evidence& evidence, const Question& question);

}  // namespace gap::cycles
