// Closed forms of the Grünwald-Letnikov sum, by the Gamma function: none of them uses the recurrence.
#pragma once

#include "reference/real.hpp"

namespace closed_form {

using reference::Real;

/// a_k of order v, not a whole number: (-1)^k binomial(v, k) = Gamma(k - v) / (Gamma(-v) k!)
inline Real weight(const Real& v, unsigned k) { return tgamma(Real(k) - v) / (tgamma(-v) * tgamma(Real(k) + 1)); }
/// S_k of x = 1: a_k of order v - 1. Also the sum of a window of k + 1 taps.
inline Real of_step(const Real& v, unsigned k) { return weight(v - 1, k); }
/// S_k of x_k = k
inline Real of_ramp(const Real& v, unsigned k) { return k == 0 ? Real(0) : weight(v - 2, k - 1); }
/// S_k of x_k = binomial(k + m, m)
inline Real of_binomial(const Real& v, unsigned m, unsigned k) { return weight(v - m - 1, k); }

}  // namespace closed_form
