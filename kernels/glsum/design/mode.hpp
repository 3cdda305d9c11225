// What the tail is made of.
#pragma once

#include <cstddef>
#include <vector>

#include "glsum/kernel.hpp"

namespace glsum::design {

using glsum::Mode;

/// The first K weights are exact, from j = K on they are sum_m w_m (1 - d_m)^(j-K), nearly.
struct Approximation {
    std::size_t near_taps;    ///< K
    std::vector<Mode> modes;  ///< M of them, slowest first
    double error;             ///< the exact sum_{j=K..N} |weight - approximation|

    /// L = K + 2M: what a design of it counts as its taps.
    [[nodiscard]] std::size_t length() const { return near_taps + 2 * modes.size(); }
    /// A sample: a_0 = 1 needs none, so one less than its length, as of a window.
    [[nodiscard]] std::size_t multiplications() const { return length() - 1; }
};

/// a_0 ... a_N of an order.
[[nodiscard]] std::vector<double> weights_to(double order, std::size_t last);

/// sum_{j=K..N} |weights[j] - sum_m w_m (1 - d_m)^(j-K)|, N the last index of `weights`; it stops once beyond `enough`.
[[nodiscard]] double error_of(const std::vector<double>& weights, std::size_t near_taps, const std::vector<Mode>& modes,
                              double enough);

}  // namespace glsum::design
