// How long a kernel must be to meet an error.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/choose/errors.hpp"

namespace choose {

/// How far a kernel gets.
struct Reach {
    std::optional<std::size_t> shortest;  ///< the shortest length found to meet the limit, by measurement
    std::size_t best_taps = 0;            ///< where the error was least, of those measured whole
    ErrorAt best;
};

/// The first of a kernel's few lengths that meets the limit, as far as the source's patience goes.
[[nodiscard]] Reach reach_of(ErrorSource& errors, const std::string& kernel, const std::vector<std::size_t>& lengths,
                             double limit);

/// Finds the shortest length that meets the limit. Truncation guides: every length up to the first whose truncation
/// meets it, and that rounding within its bound can bring there, is measured, from the shortest on. If rounding is in
/// the way beyond, a ladder is tried (each rung a quarter longer than the last, up to full memory) and the lengths
/// below the first rung that meets the limit; a kernel that misses it by more than a quarter at every rung is given up.
[[nodiscard]] Reach reach(ErrorSource& errors, const std::string& kernel, double limit);

}  // namespace choose
