// Fits candidates: the base, the effects and each record's own numbers together, by bounded least squares.
#pragma once

#include <limits>
#include <optional>

#include "gap/drive/candidate.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {

struct Effort {
    int first_iterations = 6;  ///< from each of the starts
    std::size_t keep = 2;      ///< the best of them go on, the second only if it is half as good
    int iterations = 25;
    /// Those that are not below this cost by then go no further.
    double hopeless = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> only_start = {};  ///< of an effect's starts
};

/// By which variants of the same effects are compared: one with more numbers has to leave so much less for each of
/// them.
[[nodiscard]] double weighed_cost(const Candidate& candidate);

/// From `start` for all that it has and, for other effects, from each of their starts; where residuals are whitened,
/// those count. Every candidate gets the same effort.
[[nodiscard]] Candidate fit(const Study& study, const std::vector<const Effect*>& effects, const Candidate& start,
                            const Whitener* whitener, const Effort& effort = {});

/// The same candidate on other records: base and lasting parameters stay, the records' own are fitted afresh.
[[nodiscard]] Candidate carried_over(const Study& study, const Candidate& fitted, const Whitener* whitener);

}  // namespace gap
