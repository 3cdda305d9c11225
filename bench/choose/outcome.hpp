// What became of a kernel in the search.
#pragma once

#include <optional>
#include <string>

#include "bench/choose/candidate.hpp"

namespace choose {

enum class Standing {
    chosen,
    runner_up,
    dominated,   ///< fits, but another kernel is at least as good in error, cost and bytes
    costlier,    ///< fits, and costs more
    too_costly,  ///< beyond the cost limit
    too_large,   ///< beyond the bytes limit
    inaccurate,  ///< no length meets the error
    wrong,       ///< its answer is wrong or missing
};
[[nodiscard]] std::string to_text(Standing standing);

/// What became of one kernel.
struct Outcome {
    std::string kernel;
    Standing standing = Standing::wrong;
    std::optional<Candidate> best;      ///< its shortest, cheapest length that meets the error
    std::optional<Candidate> short_of;  ///< `inaccurate`: its most accurate length of those that were measured
    std::optional<Candidate> already;   ///< too costly at this length already, which is shorter than it needs
    std::string why;
};

}  // namespace choose
