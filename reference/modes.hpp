// The oracle for kernels with modes: what their design stands for, in 50 digits.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "glsum/kernel.hpp"
#include "reference/sums.hpp"

namespace reference {

/// The weights of a design, by definition: a_0 ... a_(K-1) of its order or as it names them, and sum_m w_m (1 -
/// d_m)^(j-K) from j = K on, its decays and weights taken as exact. Of a design with blocks those of blocks.hpp.
[[nodiscard]] std::vector<Real> weights_of(const glsum::Design& design, std::size_t count);

/// S_k of these weights for all k of a record, each exponential by its recursion: a few products a sample. A design
/// without modes ends behind its taps.
[[nodiscard]] Sums sums_of(const glsum::Design& design, std::span<const double> record);

/// The same with near weights of one's own, a_0 included.
[[nodiscard]] std::vector<Real> weights_of(std::span<const Real> near, std::span<const glsum::Mode> modes,
                                           std::size_t count);
[[nodiscard]] Sums sums_of(std::span<const Real> near, std::span<const glsum::Mode> modes,
                           std::span<const double> record);

}  // namespace reference
