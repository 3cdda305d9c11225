// The fractional side of a model, sum_i c_i D^(v_i) y, as one table: a few exact taps and a few exponentials for all of
// its orders together, acting on the increments e_k = y_k - y_(k-1).
//
// Increments lower every order by one: the plant's second order becomes a first, whose tail is small, and a constant
// output leaves no error at all. With u = sum_i c_i D^(v_i) y + c y, stepping is
//
//   e_k = (u_k - c y_(k-1) - sum_{j=1..K-1} m_j e_(k-j) - sum_m w_m s_m) / (m_0 + c),    y_k = y_(k-1) + e_k,
//   s_m <- s_m + d_m (e_(k-K) - s_m) in its leaky form, its weight then w_m / d_m.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "glsum/design/mode.hpp"

namespace glsum::design {

/// c D^v, with v in (0, 2]; 0 < v: a term without a derivative is no part of this table.
struct Term {
    double coefficient;
    double order;
};

/// How D^v is discretised, by the generating function of its weights times h^-v.
enum class Discretisation {
    grunwald_letnikov,  ///< (1 - z)^v, first order in h; an input that starts at k = 0 is taken from k = 1 on
    bdf2,               ///< ((3 - 4z + z^2)/2)^v [Lubich1986], second order, with half the input at its jumps
};

/// m_0 ... m_N: the weights on the increments, h^-v_i included.
/// \param step_s   h > 0
/// \param horizon  N
[[nodiscard]] std::vector<double> merged_weights(std::span<const Term> terms, double step_s,
                                                 Discretisation discretisation, std::size_t horizon);

/// The same as `near_taps` exact weights and `modes` exponentials: the poles from the projection of the sum of the
/// terms' densities, the weights (of either sign: the tails differ in theirs) by least squares over j, which sees each
/// decade alike.
/// \pre near_taps >= 2 (Grünwald-Letnikov), >= 4 (bdf2): with fewer the closed loop of a second-order scheme amplifies
/// the error of its near weights and diverges.
[[nodiscard]] Approximation approximate_merged(std::span<const Term> terms, double step_s,
                                               Discretisation discretisation, std::size_t horizon,
                                               std::size_t near_taps, std::size_t modes);

}  // namespace glsum::design
