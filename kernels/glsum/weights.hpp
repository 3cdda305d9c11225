// The Grünwald-Letnikov weights a_j and the Horner factors c_j, in double, by recurrence.
#pragma once

#include <cstddef>
#include <span>

#include "glsum/kernel.hpp"

namespace glsum {

/// Walks j = 1, 2, ... and gives, for the order v,
///
///   c_j = (j - 1 - v) / j   (`factor`)   and   a_j = c_1 c_2 ... c_j   (`weight`).
///
/// The recurrence is carried in double-double: `weight` is within one unit in the last place of the exact a_j for
/// j up to 10^6 (checked against 40-digit arithmetic), where the plain recurrence in double loses a digit by
/// j = 10. Never by the Gamma function, which overflows beyond about 170 taps.
/// Plain double operations in a fixed order: the same bits on every machine with IEEE doubles, in software too.
class Weights {
public:
    explicit Weights(double order) : order_(order) {}
    /// The weights that a design names, where it does: then `factor` is the quotient of two of them, 0 behind the last.
    explicit Weights(const Design& design) : order_(design.order), named_(design.weights) {}

    void next();
    [[nodiscard]] double factor() const { return factor_high_; }
    [[nodiscard]] double weight() const { return high_; }
    [[nodiscard]] std::size_t index() const { return index_; }

private:
    double order_;
    std::span<const double> named_ = {};
    std::size_t index_ = 0;
    double factor_high_ = 1.0;
    double high_ = 1.0;
    double low_ = 0.0;
};

/// Whether a kernel may be prepared for this order: v in (-2, 2].
[[nodiscard]] constexpr bool order_in_range(double order) { return order > -2.0 && order <= 2.0; }

/// sum_{j=0..taps-1} |a_j|: by it the sum can exceed the largest input. 2 at most for 0 < v <= 1, 2v for
/// 1 < v <= 2, growing as taps^-v for v < 0.
[[nodiscard]] double absolute_sum(double order, std::size_t taps);
/// The same of a design's first `taps` weights.
[[nodiscard]] double absolute_sum(const Design& design, std::size_t taps);

}  // namespace glsum
