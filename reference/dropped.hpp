// The oracle for kernels that do not take what leaves their window as 0: what each history stands for, by definition,
// in 50 digits.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "glsum/family.hpp"
#include "reference/modes.hpp"

namespace reference {

/// What a history takes for the samples behind its window. A design's modes or blocks stand for zero's, those of order
/// v - 1 for the increments'.
using Dropped = glsum::Forgotten;

/// The weights of x_k, x_(k-1), ... x_0 in S_k; as many as samples, k + 1.
[[nodiscard]] std::vector<Real> weights_of(Dropped dropped, const glsum::Design& design, std::size_t samples);

/// S_k for all k of a record.
[[nodiscard]] Sums sums_of(Dropped dropped, const glsum::Design& design, std::span<const double> record);

/// The same for windows of several lengths (rising; without modes or blocks), in one pass over the record at most.
/// \param ended  the sums of windows that end: `Dropped::zero`, of the same lengths
[[nodiscard]] std::vector<Sums> sums_of_windows(Dropped dropped, double order, std::span<const double> record,
                                                std::span<const std::size_t> lengths, std::span<const Sums> ended);

}  // namespace reference
