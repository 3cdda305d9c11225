// The search: the cheapest kernel and length that meet all limits, and why every other one lost.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/choose/outcome.hpp"
#include "bench/choose/reach.hpp"
#include "bench/choose/relax.hpp"

namespace choose {

struct Choice {
    std::optional<Candidate> chosen;
    std::optional<Candidate> runner_up;
    bool tie = false;              ///< the runner-up's cost is the same within the noise
    std::vector<Outcome> kernels;  ///< in the order given
    std::vector<Relaxed> relaxed;  ///< when nothing fits: least relaxation first
};

/// Chooses among `kernels`. \param jobs  threads for the errors \param progress  whether to show it
[[nodiscard]] Choice choose(ErrorSource& errors, CostSource& costs, const std::vector<std::string>& kernels,
                            const Limits& limits, unsigned jobs, bool progress = true);

}  // namespace choose
