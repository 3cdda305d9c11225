// What training alone says, where validation goes where training never was.
#pragma once

#include "gap/drive/answer.hpp"

namespace gap {

/// Whether an answer leaves open what is missing and its validation has what training lacks.
[[nodiscard]] bool goes_elsewhere(const Answer& across);

/// The question of the training alone: parts of it are kept aside to judge by.
[[nodiscard]] Question of_training_alone(Question question);

/// What the training alone names, if its parts that were kept aside bear it out: lasting causes that leave a quarter of
/// the gap there, or less. At 0.7 at most, since elsewhere they do not explain the gap. Otherwise the answer across.
[[nodiscard]] Answer told_by_training(Answer across, Answer within);

}  // namespace gap
