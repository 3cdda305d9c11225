// Weights of higher order: those of the backward differentiation formula of p steps, taken to the power v.
//
//   D^v x (t_k) = h^-v sum_j w_j x_(k-j) + O(h^p),   sum_j w_j z^j = P(z)^v,   P(z) = sum_{i=1..p} (1-z)^i / i
//
// of order p where x and its derivatives up to the p-th are 0 at the start, else of order one or less [Lubich1986].
// p = 1 would be Grünwald-Letnikov. From P f' = v P' f, with c the coefficients of P:
//
//   n c_0 w_n = sum_{m=1..min(p,n)} (v m - (n - m)) c_m w_(n-m)
#pragma once

#include <cstddef>
#include <vector>

namespace glsum::design {

inline constexpr unsigned fewest_bdf_steps = 2;
inline constexpr unsigned most_bdf_steps = 4;

/// w_0 = c_0^v: 3/2, 11/6 or 25/12 to the power v. Kernels sum a_j = w_j / w_0, so that the derivative is w_0 h^-v S.
/// \param steps  p, 2 to 4
/// \throws std::out_of_range for another p
[[nodiscard]] double bdf_first_weight(unsigned steps, double order);

/// a_0 = 1, a_1, ... a_(count-1), each within one unit in the last place of w_j / w_0; exactly 0 behind j = p v of
/// whole orders v >= 0. Carried in double-double: the same bits on every machine with IEEE doubles. \param steps  p, 2
/// to 4 \param order  v in (-2, 2] \throws std::out_of_range for another p
[[nodiscard]] std::vector<double> bdf_weights(unsigned steps, double order, std::size_t count);

/// The same for increments x_k - x_(k-1): b_j = a_0 + ... + a_j, of P(z)^v / (1 - z); b_0 = 1.
[[nodiscard]] std::vector<double> bdf_increment_weights(unsigned steps, double order, std::size_t count);

}  // namespace glsum::design
