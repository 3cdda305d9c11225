// The oracle for weights of higher order (kernels/glsum/design/bdf.hpp), in 50 digits, by another way: not by their
// recurrence.
//
// P(z) = sum_{i=1..p} (1-z)^i / i = c_0 (1 - z) prod_r (1 - z/r) over its other roots r, all beyond the unit circle. So
// P^v / c_0^v is a product of series that the Grünwald-Letnikov weights a_j of order v give alone: of (1-z)^v these, of
// a real root a_j r^-j, and of a pair of radius s and angle t the Gegenbauer sum
//
//   q_n = s^-n sum_{k=0..n} a_k a_(n-k) cos((n - 2k) t)          (DLMF 18.5.11, its parameter -v)
#pragma once

#include <cstddef>
#include <vector>

#include "reference/real.hpp"

namespace reference {

/// c_0^v, c_0 = 1 + 1/2 + ... + 1/p. \param steps  p >= 1
[[nodiscard]] Real bdf_first_weight(unsigned steps, const Real& order);

/// The weights of P^v / c_0^v: a_0 = 1, ... a_(count-1).
/// \param steps  p, 2 to 4
[[nodiscard]] std::vector<Real> bdf_weights(unsigned steps, const Real& order, std::size_t count);

/// The same over increments, of P^v / (1 - z) / c_0^v.
[[nodiscard]] std::vector<Real> bdf_increment_weights(unsigned steps, const Real& order, std::size_t count);

}  // namespace reference
