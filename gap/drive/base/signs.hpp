// Readings whose sign a sensor may have lost, with the sign that the input says.
#pragma once

#include <vector>

#include "gap/drive/question.hpp"

namespace gap {

/// Whether readings are never below 0 (noise aside) while the input has two signs: a pulse counter's speed.
[[nodiscard]] bool may_have_lost_signs(const std::vector<Record>& records);

/// The readings with the input's sign, which after each change of it begins where they first turn: a plant that follows
/// its input passes 0 there. Good enough for a base to be looked for.
[[nodiscard]] std::vector<Record> with_signs(std::vector<Record> records);

/// Signs that the input says are a start, and those of the lag and oscillator whose magnitudes the readings are another
/// one: what swings at every move of the input passes 0 elsewhere. Those of a base that was fitted to them are better,
/// and so on, while they change; the start that ends with less is taken. \return  the question with readings that have
/// them
[[nodiscard]] Question with_signs_of_a_base(Question question);

}  // namespace gap
