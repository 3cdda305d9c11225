// What a discretisation's sum stands for, in 50 digits. Apart from discretisation.hpp: these numbers' header is the
// longest that the project reads.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/sweep/discretisation.hpp"
#include "reference/real.hpp"

namespace bench {

/// w_0.
[[nodiscard]] reference::Real first_weight(Discretisation discretisation, const reference::Real& order);

/// The lag in steps: v / 2 where shifted, which for v < 0 is a lead, else 0.
[[nodiscard]] reference::Real lag_steps(Discretisation discretisation, const reference::Real& order);

/// a_0 ... a_(count-1), in 50 digits.
[[nodiscard]] std::vector<reference::Real> exact_weights(Discretisation discretisation, const reference::Real& order,
                                                         std::size_t count);

}  // namespace bench
