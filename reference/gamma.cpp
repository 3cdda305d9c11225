#include "reference/gamma.hpp"

namespace reference {
namespace {

// MPFR keeps pi, ln 2 and the like for each thread and frees them for none.
struct ThreadConstants {
    ThreadConstants() = default;
    ThreadConstants(const ThreadConstants&) = delete;
    ThreadConstants& operator=(const ThreadConstants&) = delete;
    ~ThreadConstants() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
};

}  // namespace

Real reciprocal_gamma(const Real& x) {
    static thread_local const ThreadConstants constants;
    if (x <= 0 && floor(x) == x) {
        return 0;
    }
    Real gamma;
    mpfr_gamma(gamma.backend().data(), x.backend().data(), MPFR_RNDN);
    return 1 / gamma;
}

}  // namespace reference
