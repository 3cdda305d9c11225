// What `prepare` asks of a design before it takes anything from it.
#pragma once

#include <limits>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

namespace glsum {

[[nodiscard]] inline bool is_magnitude_at_most(double real, double limit) { return real <= limit && real >= -limit; }

/// Whether the weights that a design names serve its first `count` taps behind a_0.
template <class Technique, class Format>
[[nodiscard]] bool weights_in_range(const Design& design, std::size_t count) {
    if (design.weights.empty()) {
        return true;
    }
    // How far Horner forms of any weights reach is not known beforehand, as it is for those of an order.
    if (design.weights.size() < count || (Technique::horner_form && Format::fixed_point)) {
        return false;
    }
    Weights weights(design);
    for (std::size_t j = 1; j <= count; ++j) {
        weights.next();
        constexpr double largest = std::numeric_limits<double>::max();
        if (!is_magnitude_at_most(Technique::horner_form ? weights.factor() : weights.weight(), largest)) {
            return false;
        }
    }
    return true;
}

}  // namespace glsum
