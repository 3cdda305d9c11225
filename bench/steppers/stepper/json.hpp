// What was found of a written header, as fields of a file.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bench/steppers/stepper/verify.hpp"

namespace generate {

[[nodiscard]] nlohmann::ordered_json cost_json(const StepCost& cost);

/// Appends `checked`: where, how many steps, the first wrong one (0: none), good. Nothing where nothing was checked.
void add_checks(nlohmann::ordered_json& json, const std::vector<CheckedBits>& checked);

}  // namespace generate
