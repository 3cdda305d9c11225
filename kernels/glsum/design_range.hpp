// What `prepare` asks of a design before it takes anything from it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// What every sum asks of a design before it looks at the rest.
[[nodiscard]] inline Status order_and_taps_in_range(const Design& design) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    return design.taps == 0 ? Status::no_taps : Status::ok;
}

/// Whether buffers of so many elements hold what a design takes. A quarter of the indices that a state has: no sum of
/// a few of them wraps.
[[nodiscard]] inline Status buffers_in_range(const Design& design, std::size_t table, std::size_t table_taken,
                                             std::size_t past, std::size_t past_taken) {
    if (design.taps > std::numeric_limits<std::uint32_t>::max() / 4 || table < table_taken) {
        return Status::table_too_small;
    }
    return past < past_taken ? Status::past_too_small : Status::ok;
}

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

/// What a sum over all weights of its window asks, its buffers included.
template <class Sum, class Technique, class Format>
[[nodiscard]] Status window_in_range(const Design& design, std::size_t table, std::size_t past) {
    if (const Status status = order_and_taps_in_range(design); status != Status::ok) {
        return status;
    }
    if (!weights_in_range<Technique, Format>(design, design.taps - 1)) {
        return Status::weights_out_of_range;
    }
    return buffers_in_range(design, table, Sum::table_count(design.taps), past, Sum::past_count(design.taps));
}

}  // namespace glsum
