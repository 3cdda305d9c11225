// The Mittag-Leffler function, in which the derivatives of sines and exponentials are written.
#pragma once

#include "reference/real.hpp"

namespace reference {

/// E_{a,b}(z) = sum_{k>=0} z^k / Gamma(a k + b), for real b and z, by this series in as many digits as its terms
/// cancel. At least 30 digits, of the amplitude where the function swings about 0. Safe to call from several threads.
/// Time and digits grow with |z|^(1/a): 2 ms at 1571, the largest angle of a record.
/// \throws std::domain_error for a = 0, and unless |z|^(1/a) <= 1e5.
/// Source: I. Podlubny, Fractional Differential Equations, 1999.
[[nodiscard]] Real mittag_leffler(unsigned a, const Real& b, const Real& z);

}  // namespace reference
