#include "reference/gamma.hpp"

namespace reference {

Real reciprocal_gamma(const Real& x) {
    free_constants_with_thread();
    if (x <= 0 && floor(x) == x) {
        return 0;
    }
    Real gamma;
    mpfr_gamma(gamma.backend().data(), x.backend().data(), MPFR_RNDN);
    return 1 / gamma;
}

}  // namespace reference
