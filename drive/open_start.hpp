// A start of a fit to records of an open loop, from nothing but them.
#pragma once

#include <vector>

#include "drive/model.hpp"
#include "drive/record.hpp"

namespace drive {

/// The time constant, the damping and the dead time of a grid whose response, scaled, leaves the least sum of squares.
/// \param kind  fopdt or sopdt; niopdt: a second order of any damping from 0.025 to 1
/// \throws glsum::Failure (bad input) if nothing of the output follows the input
[[nodiscard]] Model search_open_start(Kind kind, const std::vector<Record>& records);

}  // namespace drive
