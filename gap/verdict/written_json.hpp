// Numbers in JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "gap/verdict/written.hpp"

namespace gap {

/// Their values by their names.
[[nodiscard]] nlohmann::ordered_json values_json(const std::vector<Written>& numbers);

}  // namespace gap
