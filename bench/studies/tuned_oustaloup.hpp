// Oustaloup's filter as its users tune it: the band and the mapping that err least on given records.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "bench/studies/oustaloup.hpp"

namespace bench {

/// A record, and what a filter should make of some of its samples.
struct FilterTarget {
    std::vector<double> record;
    std::vector<std::pair<std::size_t, double>> wanted;  ///< sample and output; samples rising
    double peak;                                         ///< above 0; errors are relative to it
};

struct TunedOustaloup {
    Band band;
    Mapping mapping;
    double error;  ///< of the worst of the targets
};

/// The largest error of a filter on a target; infinite where an output is no number.
[[nodiscard]] double error_of(Oustaloup filter, const FilterTarget& target);

/// One band and mapping for all targets, of least error on the worst of them: the best of a grid, two and four points a
/// decade, are moved in ever smaller steps to 0.2 % of both edges. Deterministic.
/// \param order, step_s, poles  as Oustaloup's  \throws std::invalid_argument as Oustaloup, and for no target
[[nodiscard]] TunedOustaloup tune_oustaloup(double order, double step_s, std::size_t poles,
                                            std::span<const FilterTarget> targets);

}  // namespace bench
