// When nothing fits: how far each limit must give way until something does, the others kept.
#pragma once

#include <string>
#include <vector>

#include "bench/choose/outcome.hpp"

namespace choose {

/// One limit relaxed until something fits, the others kept.
struct Relaxed {
    std::string limit;  ///< "max_error", "max_cost", "max_bytes"
    double from;
    double to;
    Candidate fits;
    [[nodiscard]] double factor() const { return to / from; }
};

/// \param kernels  what became of them; costs that are missing are measured and kept there
/// \return least relaxation first
[[nodiscard]] std::vector<Relaxed> relax(ErrorSource& errors, CostSource& costs, const Limits& limits,
                                         std::vector<Outcome>& kernels);

}  // namespace choose
