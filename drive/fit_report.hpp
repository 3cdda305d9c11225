// A fit for people and as a file.
#pragma once

#include <string>

#include "drive/fit.hpp"
#include "drive/indices.hpp"

namespace drive {

/// Model, estimates with their intervals, correlation, and how it ended. \param indices  of the fit on `record`
[[nodiscard]] std::string to_text(const Fit& fit, const std::string& record, const Indices& indices);

/// The same and its warnings. What is not finite is null.
[[nodiscard]] std::string to_json(const Fit& fit, const std::string& record, const Indices& indices);

}  // namespace drive
