// Sums of squares and products about the means.
#pragma once

#include <span>

namespace gap {

struct Moments {
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
};

/// \param y  as many as x
[[nodiscard]] Moments moments_of(std::span<const double> x, std::span<const double> y);

}  // namespace gap
