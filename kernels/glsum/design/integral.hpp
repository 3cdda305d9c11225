// Modes of an integral, -1 <= v < 0, the slowest of which does not decay: a running sum.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "glsum/design/mode.hpp"

namespace glsum::design {

/// Whether the order is that of an integral whose weights do not grow: -1 <= v < 0.
[[nodiscard]] bool is_integral(double order);

/// M of a design of L = K + 2M coefficients, the running sum among them: 1 at v = -1, `modes_within` between, 0 for
/// what is no integral.
[[nodiscard]] std::size_t integral_modes_within(double order, std::size_t taps);

/// a_0 ... a_(K-1) as they are, and behind them `modes` exponentials: those of the order's own tail (design.hpp) with
/// the slowest pole moved to 1 (decay 0), weights by least squares (fitted.hpp). Fewer come back when the tail has no
/// more in it.
/// \param weights    a_0 ... a_N of the order or of another discretisation of it
/// \param order      with `is_integral`
/// \param near_taps  K >= 1, and K >= least_near_taps(order) (projection.hpp) \param modes  at least 1
[[nodiscard]] Approximation approximate_integral(const std::vector<double>& weights, double order,
                                                 std::size_t near_taps, std::size_t modes);

/// The smallest L whose `integral_modes_within` keep sum_{j=K..N} |a_j - approximation| within `error`; empty if none
/// does.
[[nodiscard]] std::optional<Approximation> design_integral(const std::vector<double>& weights, double order,
                                                           double error);

}  // namespace glsum::design
