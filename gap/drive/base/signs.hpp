// Readings whose sign a sensor may have lost, with the sign that the input says.
#pragma once

#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// Whether readings are never below 0 (noise aside) while the input has two signs: a pulse counter's speed.
[[nodiscard]] bool may_have_lost_signs(const std::vector<Record>& records);

/// The readings with the input's sign, which after each change of it begins where they first turn: a plant that follows
/// its input passes 0 there. Good enough for a base to be looked for.
[[nodiscard]] std::vector<Record> with_signs(std::vector<Record> records);

}  // namespace gap
