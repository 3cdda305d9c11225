// Of which order the design is that a kernel's cost is counted on.
#pragma once

#include <string>

#include "bench/sweep/designs.hpp"

namespace choose {

/// A cost depends on how many coefficients there are of each kind, and on nothing else that an order decides (but for
/// double precision in software). Designs of a sum keep the more near taps the nearer v is to 1; a filter that is
/// fitted to a derivative needs them for no order, and on a Cortex-M7 a near tap beside modes costs what a mode costs.
struct CountedOrder {
    CountedOrder(double order_asked, bool is_fitted = false) : order(order_asked), fitted(is_fitted) {}

    double order;  ///< v that is asked for
    bool fitted;   ///< filters are fitted to its derivative

    /// v itself; of fitted modes half an order of the same sign, whose designs have one near tap, or two.
    [[nodiscard]] double of(const std::string& kernel) const {
        return fitted && bench::has_modes(kernel) ? (order > 0.0 ? 0.5 : -0.5) : order;
    }
    /// \param taps     coefficients in all: K + 2M \param samples  of the record that blocks are parted for
    [[nodiscard]] bench::Length length(const std::string& kernel, std::size_t taps, std::size_t samples) const {
        return bench::length_of(kernel, of(kernel), taps, samples);
    }
};

}  // namespace choose
