// Modes for weights that are no mixture of exponentials but fall like one: poles of the one, weights by least squares.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "glsum/design/mode.hpp"

namespace glsum::design {

/// Sets the weights of given poles by least squares on weights[j] j sqrt(d log j), j >= K, which sees each decade
/// alike: at each index up to 25, then at those 4 % apart. \param near_taps  K >= 1
void fit_weights(std::vector<Mode>& modes, const std::vector<double>& weights, std::size_t near_taps);

/// a_0 ... a_(K-1) as they are and `modes` exponentials behind them, the poles those of the tail of an order whose own
/// weights a_j approaches, from K - 2 on where it has one. Weights of either sign. Fewer modes come back when the tail
/// has no more in it. \param weights    a_0 ... a_N \param order      with has_tail (design.hpp) \param near_taps  K >=
/// least_near_taps(order)
[[nodiscard]] Approximation approximate_fitted(const std::vector<double>& weights, double order, std::size_t near_taps,
                                               std::size_t modes);

/// Of 4, 6, 8, 12, 16, 24 or 32 near taps the cheapest design that keeps sum_{j=K..N} |a_j - approximation| within
/// `error`, and of several that with the fewest; empty if none does.
[[nodiscard]] std::optional<Approximation> design_fitted(const std::vector<double>& weights, double order,
                                                         double error);

}  // namespace glsum::design
