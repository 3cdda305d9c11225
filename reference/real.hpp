// The numbers of the reference: 50 decimal digits by MPFR, on the stack.
#pragma once

#include <boost/multiprecision/mpfr.hpp>

namespace reference {

using Real =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

/// total += a x with one rounding and no temporary: by far the most frequent operation of a run.
inline void add_product(Real& total, const Real& a, const Real& x) {
    mpfr_fma(total.backend().data(), a.backend().data(), x.backend().data(), total.backend().data(), MPFR_RNDN);
}

/// MPFR keeps pi, ln 2 and its scratch numbers for each thread and frees them for none: what takes a power, a sine or a
/// function like them says so first, as it may be run on a thread that ends.
inline void free_constants_with_thread() {
    struct Constants {
        Constants() = default;
        Constants(const Constants&) = delete;
        Constants& operator=(const Constants&) = delete;
        ~Constants() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
    };
    static thread_local const Constants constants;
}

/// A Real as the sum of two doubles: 106 bits, enough to see the error of any kernel in double.
struct Exact {
    double high;
    double low;
    explicit Exact(const Real& real) : high(static_cast<double>(real)), low(static_cast<double>(Real(real - high))) {}
    /// value - this, rounded once or twice.
    [[nodiscard]] double error_of(double value) const { return (value - high) - low; }
};

}  // namespace reference
