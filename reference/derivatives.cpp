#include "reference/derivatives.hpp"

#include <stdexcept>

#include "reference/gamma.hpp"
#include "reference/mittag_leffler.hpp"

namespace reference {
namespace {

// t^exponent at a time the derivatives exist at.
Real power_of_time(const Real& t, const Real& exponent) {
    free_constants_with_thread();
    if (!(t > 0)) {
        throw std::domain_error("derivative: expected a time above 0");
    }
    return pow(t, exponent);
}

}  // namespace

Real derivative_of_power(const Real& b, const Real& v, const Real& t) {
    if (!(b > -1)) {
        throw std::domain_error("derivative of a power: expected an exponent above -1");
    }
    return reciprocal_gamma(b + 1 - v) / reciprocal_gamma(b + 1) * power_of_time(t, b - v);
}

Real derivative_of_sine(const Real& w, const Real& v, const Real& t) {
    const Real angle = w * t;
    return w * power_of_time(t, 1 - v) * mittag_leffler(2, 2 - v, -angle * angle);
}

Real derivative_of_cosine(const Real& w, const Real& v, const Real& t) {
    const Real angle = w * t;
    return power_of_time(t, -v) * mittag_leffler(2, 1 - v, -angle * angle);
}

Real derivative_of_exponential(const Real& l, const Real& v, const Real& t) {
    return power_of_time(t, -v) * mittag_leffler(1, 1 - v, -l * t);
}

}  // namespace reference
