#include "glsum/weights.hpp"

#include "glsum/double_double.hpp"

namespace glsum {

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
    const DoubleDouble numerator = two_sum(j - 1.0, -order_);
    // Quotient by one correction step: relative error about 2^-104.
    const double quotient = numerator.high / j;
    const DoubleDouble back = two_product(quotient, j);
    const double rest = ((numerator.high - back.high) - back.low) + numerator.low;
    const DoubleDouble factor = two_sum(quotient, rest / j);
    factor_high_ = factor.high;
    // weight *= factor
    const DoubleDouble product = two_product(high_, factor.high);
    const double cross = high_ * factor.low + low_ * factor.high;
    const DoubleDouble weight = two_sum(product.high, product.low + cross);
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
