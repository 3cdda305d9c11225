// 1/Gamma, which has no poles.
#pragma once

#include "reference/real.hpp"

namespace reference {

/// 1/Gamma(x), correctly rounded twice; exactly 0 at x = 0, -1, -2, ..., where Gamma has its poles.
[[nodiscard]] Real reciprocal_gamma(const Real& x);

}  // namespace reference
