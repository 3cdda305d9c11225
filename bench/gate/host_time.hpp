// Times of the host, by statistics: a kernel against an anchor of the same run, run against run.
#pragma once

#include <cstddef>
#include <vector>

namespace bench::gate {

/// The repetitions of a kernel and of its anchor in one run, in ns per sample, r-th beside r-th: random interleaving
/// puts them close in time.
struct Timing {
    std::vector<double> kernel;
    std::vector<double> anchor;
};

/// Relative change of the ratio of kernel to anchor from one run to another, with one-sided bounds.
struct TimeChange {
    double estimate = 0.0;
    double low = 0.0;   ///< the change is larger than this with the confidence asked for
    double high = 0.0;  ///< and smaller than this with the same
};

/// Fewer repetitions are not judged.
inline constexpr std::size_t least_repetitions = 20;

/// \pre all four lists hold at least `least_repetitions` positive numbers
/// The bootstrap is seeded: the same files give the same verdict.
[[nodiscard]] TimeChange time_change(const Timing& baseline, const Timing& current, double confidence);

/// Of code that did not change: how far its ratio to the anchor moved, as a share, in the fastest hundredth of the
/// repetitions or in the fastest twentieth, whichever moved more. Beyond a few per cent the two runs met different
/// machines: a neighbour on the same core, another clock. \pre as above
[[nodiscard]] double movement(const Timing& baseline, const Timing& current);

}  // namespace bench::gate
