// An answer beside what the user's own simulator gave for the same input.
#pragma once

#include <functional>
#include <string>

#include "gap/drive/answer.hpp"

namespace gap {

/// \param question  whose records have what was simulated; with a form, or one is found that reproduces it
[[nodiscard]] Answer answer_beside_simulation(Question question, const std::function<void(const std::string&)>& say);

/// Says how well a model reproduces the simulation; where that is poorly, no effect is told from what it lacks.
/// \param reproduced  rms of what it misses over the simulation's deviation
void judge_reproduction(Answer& answer, double reproduced);

}  // namespace gap
