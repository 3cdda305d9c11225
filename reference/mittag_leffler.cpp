#include "reference/mittag_leffler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/gamma.hpp"

namespace reference {
namespace {

// A number of a width chosen at run time: Real has one width, and Boost's variable one takes it from a global.
class Wide {
public:
    Wide(mpfr_prec_t bits, const Real& value) {
        mpfr_init2(number_, bits);
        mpfr_set(number_, value.backend().data(), MPFR_RNDN);
    }
    Wide(const Wide&) = delete;
    Wide& operator=(const Wide&) = delete;
    ~Wide() { mpfr_clear(number_); }
    [[nodiscard]] mpfr_ptr get() { return number_; }

private:
    mpfr_t number_;
};

// sum_{j>=0} z^j Gamma(b) / Gamma(a j + b) for b > 0. Without the Gamma in common, all of a term is a product.
Real normalised_series(unsigned a, const Real& b, const Real& z) {
    const double reach = std::pow(std::fabs(static_cast<double>(z)), 1.0 / a);  // the largest term is about e^reach
    if (!(reach <= 1e5)) {
        throw std::domain_error("Mittag-Leffler function: expected |z|^(1/a) up to 1e5");
    }
    // The sum can be as small as e^-reach for a = 1; for larger a it falls no faster than a power of z.
    const double cancelled = (a == 1 ? 2.0 : 1.0) * reach / std::numbers::ln2;
    const auto bits = static_cast<mpfr_prec_t>(256.0 + cancelled);
    Wide sum(bits, 1);
    Wide term(bits, 1);
    Wide argument(bits, b);
    Wide divisor(bits, 1);
    mpfr_exp_t largest = 1;
    do {
        mpfr_set(divisor.get(), argument.get(), MPFR_RNDN);
        mpfr_add_ui(argument.get(), argument.get(), 1, MPFR_RNDN);
        for (unsigned i = 1; i < a; ++i) {
            mpfr_mul(divisor.get(), divisor.get(), argument.get(), MPFR_RNDN);
            mpfr_add_ui(argument.get(), argument.get(), 1, MPFR_RNDN);
        }
        mpfr_mul(term.get(), term.get(), z.backend().data(), MPFR_RNDN);
        mpfr_div(term.get(), term.get(), divisor.get(), MPFR_RNDN);
        mpfr_add(sum.get(), sum.get(), term.get(), MPFR_RNDN);
        if (mpfr_zero_p(term.get()) != 0) {
            break;
        }
        largest = std::max(largest, mpfr_get_exp(term.get()));
        // Terms fall once the argument is beyond the reach, and not always before.
    } while (mpfr_cmp_d(argument.get(), reach) < 0 || mpfr_get_exp(term.get()) + bits > largest);
    Real result;
    mpfr_set(result.backend().data(), sum.get(), MPFR_RNDN);
    return result;
}

}  // namespace

Real mittag_leffler(unsigned a, const Real& b, const Real& z) {
    if (a == 0) {
        throw std::domain_error("Mittag-Leffler function: expected a of at least 1");
    }
    Real sum = 0;
    Real power = 1;
    Real argument = b;
    for (; argument <= 0; argument += a) {  // no product leads from one side of a pole of Gamma to the other
        sum += power * reciprocal_gamma(argument);
        power *= z;
    }
    return sum + power * reciprocal_gamma(argument) * normalised_series(a, argument, z);
}

}  // namespace reference
