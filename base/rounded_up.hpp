// Bounds as people read them: a bound that is rounded to nearest no longer is one, half of the time.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace base {

/// `digits` significant ones, the least such number that is not below `bound`. \param bound  at least 0
[[nodiscard]] inline std::string rounded_up(double bound, int digits = 3) {
    std::string text = fmt::format("{:.{}g}", bound, digits);
    if (!(bound > 0.0) || !std::isfinite(bound)) {
        return text;
    }
    const double unit = std::pow(10.0, std::floor(std::log10(bound)) - digits + 1);
    for (double above = bound; std::stod(text) < bound; above += 0.25 * unit) {
        text = fmt::format("{:.{}g}", above, digits);
    }
    return text;
}

}  // namespace base
