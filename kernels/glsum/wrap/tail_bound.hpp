// What rounding costs the carried weights of wrap/tail.hpp, by a walk over the record. With u the roundoff:
//   T   e <- |1 - v/k| e                               the error there was, through A + T
//          + |v|/k (4 u |A| + u |T|)                   A: its quotient in double and its rounding; T without its carry
//          + 6 u |a_k|                                 A + T, v, the product, k, the quotient, step + lost
//          + u^2 |T|                                   the rounding of step + lost, of what was lost
//   H   e <- (1 - 1/n) e + (e of T + u |T| + u |H| + 4 u |T - H|)/n + u^2 |H|
// The carry words themselves add exactly. Each weight is then rounded to its value without its carry (u), multiplied
// (u), and added (u; before another term 2 u), and its sample was rounded (u).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/error_bound.hpp"
#include "glsum/weights.hpp"
#include "glsum/window/window_bound.hpp"
#include "glsum/wrap/tail_sum.hpp"

namespace glsum {

/// The largest error, for |x| <= 1, of the terms behind the window, over a record of so many samples.
template <class K>
[[nodiscard]] double tail_error(const Design& design, std::size_t samples) {
    constexpr double u = K::FormatPart::data_roundoff;
    constexpr bool to_first = K::HistoryPart::to_first;
    const double v = design.order;
    const auto taps = static_cast<double>(design.taps);
    Weights weights(design.order);
    while (weights.index() < design.taps) {
        weights.next();
    }
    const double in_window = v == 0.0 ? 1.0 : -weights.weight() * taps / v;
    double tail = 0.0;
    double mean = 0.0;
    double of_tail = 0.0;
    double of_mean = 0.0;
    double largest = 0.0;
    for (std::size_t i = design.taps; i < samples; ++i) {
        const auto k = static_cast<double>(i);
        if constexpr (to_first) {
            const double n = k - taps + 1.0;
            of_mean +=
                (of_tail + u * (std::fabs(tail) + std::fabs(mean) + 4.0 * std::fabs(tail - mean)) - of_mean) / n +
                u * u * std::fabs(mean);
            mean += (tail - mean) / n;
        }
        const double weight = -(in_window + tail) * v / k;
        of_tail =
            std::fabs(1.0 - v / k) * of_tail + u * (std::fabs(v) / k * (4.0 * std::fabs(in_window) + std::fabs(tail)) +
                                                    6.0 * std::fabs(weight) + u * std::fabs(tail));
        tail += weight;
        double error = of_tail + 4.0 * u * std::fabs(tail);
        if constexpr (to_first) {
            error = of_mean + 5.0 * u * std::fabs(mean)                            // of x_(k-L+1)
                    + of_tail + of_mean + u * (std::fabs(tail) + std::fabs(mean))  // of x_0: U = T - H
                    + 4.0 * u * std::fabs(tail - mean);
        }
        largest = std::max(largest, error);
    }
    return 1.001 * largest;  // products of errors
}

template <bool to_first, class Technique, class Format>
struct ErrorBound<Sum<Guess<to_first>, Technique, Format>> {
    using K = Sum<Guess<to_first>, Technique, Format>;

    static double of(const Design& design, const typename K::State&, double peak, std::size_t samples) {
        constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
        return window_error_bound<K>(design, peak, to_first ? 2 : 1) + peak * tail_error<K>(design, samples) +
               8.0 * denormal;
    }
};

}  // namespace glsum
