// A change in per cent, as a person reads it.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace bench::gate {

/// "+2.3 %", "-1234 %": so many digits, or all that stand before the point. \param change  0.01: one per cent
[[nodiscard]] inline std::string percent(double change, int digits) {
    const double value = 100.0 * change;
    return std::fabs(value) < std::pow(10.0, digits) - 0.5 ? fmt::format("{:+.{}g} %", value, digits)
                                                           : fmt::format("{:+.0f} %", value);
}

}  // namespace bench::gate
