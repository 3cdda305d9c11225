// What is left of each kernel along its length: a cause must explain slopes and constants of all of them.
#pragma once

#include <string>
#include <vector>

#include "gap/cycles/evidence.hpp"

namespace gap::cycles {

/// The rows of one kernel in one placement, less what is predicted for them, as a line along the length.
struct LineLeft {
    std::string kernel;
    std::string placement;
    /// Share of the measured slope; of calls of nearly one length, which determine no line, 0.
    double slope;
    double constant;  ///< cycles, at the shortest call
    double shortest;  ///< measured cycles of such a call
};

/// By medians (Theil and Sen), as counts have outliers to one side.
[[nodiscard]] std::vector<LineLeft> lines_left(const Evidence& evidence, const Cycles& predicted);

/// Whether a prediction meets a kernel: its slope to 5 %, its shortest calls to 5 % or 8 cycles, as `qemu::misses`.
[[nodiscard]] bool is_met(const LineLeft& line);
/// The same where causes are parted: 2 % and 8 cycles.
[[nodiscard]] bool is_met_closely(const LineLeft& line);

}  // namespace gap::cycles
