// The exact derivatives of the signals that have one in closed form.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "reference/real.hpp"

namespace bench {

/// D^v x(t): the order v in (-2, 2], t > 0 in s; Riemann-Liouville with lower terminal 0, in s^-v.
using Derivative = std::function<reference::Real(const reference::Real& v, const reference::Real& t)>;

/// Of the continuous signal that `make_signal(name, samples, ...)` samples at t = k h; `samples` sets the ramp's slope.
/// Empty for a signal without a formula: `noise`, `drive`, unknown names and a ramp of less than 2 samples.
[[nodiscard]] Derivative derivative_of_signal(std::string_view name, std::size_t samples);

}  // namespace bench
