// How a kernel fared in the search.
#pragma once

#include <optional>
#include <string>

#include "bench/choose/candidate.hpp"

namespace choose {

enum class Fate {
    chosen,
    runner_up,
    dominated,   ///< fits, but another kernel is at least as good in error, cost and bytes
    dearer,      ///< fits, and costs more
    too_dear,    ///< beyond the cost limit
    too_large,   ///< beyond the bytes limit
    inaccurate,  ///< no length meets the error
    wrong,       ///< its answer is wrong or missing
};
[[nodiscard]] std::string to_text(Fate fate);

/// How one kernel fared.
struct Fared {
    std::string kernel;
    Fate fate = Fate::wrong;
    std::optional<Candidate> best;      ///< its shortest, cheapest length that meets the error
    std::optional<Candidate> short_of;  ///< `inaccurate`: its most accurate length of those that were measured
    std::optional<Candidate> already;   ///< too dear at this length already, which is shorter than it needs
    std::string why;
};

}  // namespace choose
