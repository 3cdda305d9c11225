// Exact derivatives of real order: what the Grünwald-Letnikov sum tends to, times h^-v, as h tends to 0.
//
// All are Riemann-Liouville derivatives with lower terminal 0 at a time t > 0: x is 0 before t = 0, and a jump there
// counts. Negative orders are integrals; whole orders are the ordinary derivatives at t > 0. They hold for any order,
// and to at least 30 digits, of the amplitude where the result swings about 0, for orders in (-2, 2].
// Units: t in s, w in rad/s, l in 1/s; the result is in the unit of x times s^-v. Safe to call from several threads.
// \throws std::domain_error unless t > 0, where mittag_leffler throws, and as said below.
// Source: the rule for powers, in I. Podlubny, Fractional Differential Equations, 1999; the others are that
// rule on every term of the power series of x.
#pragma once

#include "reference/real.hpp"

namespace reference {

/// D^v t^b = Gamma(b + 1) / Gamma(b + 1 - v) t^(b - v); 0 where the divisor has a pole, as for whole b < v.
/// \throws std::domain_error also unless b > -1, where the power cannot be integrated from 0.
[[nodiscard]] Real derivative_of_power(const Real& b, const Real& v, const Real& t);

/// D^v sin(w t) = w t^(1 - v) E_{2,2-v}(-(w t)^2)
[[nodiscard]] Real derivative_of_sine(const Real& w, const Real& v, const Real& t);

/// D^v cos(w t) = t^-v E_{2,1-v}(-(w t)^2)
[[nodiscard]] Real derivative_of_cosine(const Real& w, const Real& v, const Real& t);

/// D^v exp(-l t) = t^-v E_{1,1-v}(-l t)
[[nodiscard]] Real derivative_of_exponential(const Real& l, const Real& v, const Real& t);

}  // namespace reference
