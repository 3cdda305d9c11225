#include "glsum/weights.hpp"

namespace glsum {
namespace {

struct Pair {
    double high;
    double low;
};

// [Knuth] Exact: high + low == a + b.
Pair two_sum(double a, double b) {
    const double high = a + b;
    const double b_part = high - a;
    return {high, (a - (high - b_part)) + (b - b_part)};
}

// [Dekker1971] Exact: high + low == a b. By splitting, not by a fused multiply-add, which a core without a double
// unit has only as a slow library call. The factors here are far below the overflow of the split (2^996).
Pair two_product(double a, double b) {
    constexpr double splitter = 134217729.0;  // 2^27 + 1
    const double a_scaled = splitter * a;
    const double a_high = a_scaled - (a_scaled - a);
    const double a_low = a - a_high;
    const double b_scaled = splitter * b;
    const double b_high = b_scaled - (b_scaled - b);
    const double b_low = b - b_high;
    const double high = a * b;
    return {high, ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

}  // namespace

void Weights::next() {
    ++index_;
    if (!named_.empty()) {
        const double before = high_;
        high_ = index_ <= named_.size() ? named_[index_ - 1] : 0.0;
        factor_high_ = high_ == 0.0 ? 0.0 : high_ / before;
        return;
    }
    const double j = static_cast<double>(index_);
    // The numerator j - 1 - v exactly, as a pair.
    const Pair numerator = two_sum(j - 1.0, -order_);
    // Quotient by one correction step: relative error about 2^-104.
    const double quotient = numerator.high / j;
    const Pair back = two_product(quotient, j);
    const double rest = ((numerator.high - back.high) - back.low) + numerator.low;
    const Pair factor = two_sum(quotient, rest / j);
    factor_high_ = factor.high;
    // weight *= factor
    const Pair product = two_product(high_, factor.high);
    const double cross = high_ * factor.low + low_ * factor.high;
    const Pair weight = two_sum(product.high, product.low + cross);
    high_ = weight.high;
    low_ = weight.low;
}

double absolute_sum(double order, std::size_t taps) { return absolute_sum(Design{order, taps}, taps); }

double absolute_sum(const Design& design, std::size_t taps) {
    Weights weights(design);
    double sum = 1.0;
    for (std::size_t j = 1; j < taps; ++j) {
        weights.next();
        sum += weights.weight() < 0.0 ? -weights.weight() : weights.weight();
    }
    return sum;
}

}  // namespace glsum
