// The oracle for kernels with blocks (kernels/glsum/logmemory/nested.hpp): what their design stands for, in 50 digits.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "glsum/kernel.hpp"
#include "reference/sums.hpp"

namespace reference {

/// The weights by definition: of the near taps those of the order, or those that the design names, and for every lag of
/// a block the mean of these over the block; 0 beyond.
[[nodiscard]] std::vector<Real> block_weights(const glsum::Design& design, std::size_t count);

/// S_k of these weights for all k of a record, each block's sum as a difference of two sums from the record's
/// beginning.
[[nodiscard]] Sums block_sums(const glsum::Design& design, std::span<const double> record);

}  // namespace reference
