// What a measurement of coverage found, for people and as a file.
#pragma once

#include <string>

#include "drive/coverage.hpp"

namespace drive {

[[nodiscard]] std::string to_text(const Coverage& found, const Model& truth, const Acquisition& acquisition);

/// \param model  the truth's file \param form  what was fitted
[[nodiscard]] std::string to_json(const Coverage& found, const std::string& model, const std::string& form);

/// Whether every fit ended and each parameter lies within its 95 % interval in 90 to 99.5 % of the runs.
[[nodiscard]] bool holds(const Coverage& found);

}  // namespace drive
