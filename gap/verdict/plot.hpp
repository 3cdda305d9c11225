// Lines over time as inline SVG, once for a screen and once for a phone: a drawing that shrinks takes its texts along.
#pragma once

#include <string>
#include <vector>

namespace gap {

struct Trace {
    const char* css;
    std::vector<double> values;
    bool held = false;  ///< from its stamp to the next, in steps
};

struct PlotOf {
    std::string label;
    double height;  ///< in px of a screen's 1100 across
    std::vector<Trace> lines;
    std::vector<double> shade = {};  ///< of equal parts of the time, in 0 to 1; empty: none
};

/// Values that are no numbers are left out, and of more than 4400 samples some. \param time_s  rising; as long as each
/// line
[[nodiscard]] std::string to_svg(const PlotOf& plot, const std::vector<double>& time_s);

/// The squares of a residual in equal parts of its time, over the largest of them.
[[nodiscard]] std::vector<double> shade_of(const std::vector<double>& residual, const std::vector<double>& time_s);

/// As HTML's text and attributes hold it.
[[nodiscard]] std::string escaped(const std::string& text);

}  // namespace gap
