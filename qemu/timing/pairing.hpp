// Which two instructions may issue in one cycle. Operands, banks and what the FPU bars for some cycles are not here.
#pragma once

#include "qemu/timing/core_file.hpp"
#include "qemu/timing/decoded.hpp"

namespace timing {

/// Whether an instruction never shares its cycle.
[[nodiscard]] bool issues_alone(const Decoded& decoded, const Figures& figures);

/// \param older_taken  the older is a branch that was taken: the younger stands at its target
[[nodiscard]] bool may_pair(const Decoded& older, const Decoded& younger, bool older_taken, const Figures& figures);

}  // namespace timing
