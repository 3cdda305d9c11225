// A verdict on a drive as one page, offline: measured, base and base with the effect; the gap by segment; the ranking.
#pragma once

#include <string>
#include <vector>

#include "gap/verdict/verdict.hpp"

namespace gap {

/// Of one record that was judged, by its stamps.
struct Curve {
    std::string name;
    std::vector<double> time_s;
    std::vector<double> measured;
    std::vector<double> left_by_base;    ///< measured - simulated
    std::vector<double> left_by_chosen;  ///< with what helps most; empty: nothing does
};

/// HTML with inline SVG; follows the reader's light or dark scheme.
[[nodiscard]] std::string to_html(const Verdict& verdict, const OfDrive& of, const std::vector<Curve>& curves);

}  // namespace gap
