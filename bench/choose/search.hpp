// The search: the cheapest kernel and length that meet all limits, and why every other one lost.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/choose/costs.hpp"
#include "bench/choose/errors.hpp"

namespace choose {

/// What may not be exceeded. Cost is in `CostSource::limited_unit()`.
struct Limits {
    double max_error;
    std::optional<double> max_cost;
    std::optional<double> max_bytes;
};

/// A kernel at a length, with everything measured there.
struct Candidate {
    std::string kernel;
    std::size_t taps = 0;
    ErrorAt error;
    Cost cost;
};

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

/// One limit relaxed until something fits, the others kept.
struct Relaxed {
    std::string limit;  ///< "max_error", "max_cost", "max_bytes"
    double from;
    double to;
    Candidate fits;
    [[nodiscard]] double factor() const { return to / from; }
};

struct Choice {
    std::optional<Candidate> chosen;
    std::optional<Candidate> runner_up;
    bool tie = false;              ///< the runner-up's cost is the same within the noise
    std::vector<Fared> kernels;    ///< in the order given
    std::vector<Relaxed> relaxed;  ///< when nothing fits: least relaxation first
};

/// Whether `a` is to be preferred: cheaper, then smaller, then more accurate.
[[nodiscard]] bool better(const Candidate& a, const Candidate& b);

/// How far a kernel gets.
struct Reach {
    std::optional<std::size_t> shortest;  ///< the shortest length found to meet the limit, by measurement
    std::size_t best_taps = 0;            ///< where the error was least, of those measured whole
    ErrorAt best;
};

/// Finds the shortest length that meets the limit. Truncation guides: every length up to the first whose truncation
/// meets it, and that rounding within its bound can bring there, is measured, from the shortest on. If rounding is in
/// the way beyond, a ladder is tried (each rung a quarter longer than the last, up to full memory) and the lengths
/// below the first rung that meets the limit; a kernel that misses it by more than a quarter at every rung is given up.
[[nodiscard]] Reach reach(ErrorSource& errors, const std::string& kernel, double limit);

/// Chooses among `kernels`. \param jobs  threads for the errors \param progress  whether to show it
[[nodiscard]] Choice choose(ErrorSource& errors, CostSource& costs, const std::vector<std::string>& kernels,
                            const Limits& limits, unsigned jobs, bool progress = true);

}  // namespace choose
