// How near the reference must come to what is known of a number.
#pragma once

#include <string>

#include "reference/real.hpp"

namespace digits {

using reference::Real;

/// Whether the two agree within 1e-30 of the expected number.
void expect_thirty(const Real& found, const Real& expected, const std::string& what);

/// Whether `found` is within `units` of the last printed digit: half a unit for a rounded print, one for a cut one.
void expect_printed(const Real& found, const std::string& printed, double units, const std::string& what = "");

}  // namespace digits
