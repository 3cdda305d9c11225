// The lightly damped poles of a model: what a numerical inversion must resolve, and would not notice by itself.
#pragma once

#include <vector>

#include "drive/model.hpp"

namespace drive {

/// A pair of poles -decay_per_s +- i radians_per_s on the principal sheet.
struct Swing {
    double radians_per_s;
    double decay_per_s;  ///< below 0: it grows
};

/// The zeros of sum a s^alpha that lie within about 20 degrees of the imaginary axis, by Newton's method from points of
/// the axis that are near one.
[[nodiscard]] std::vector<Swing> swings_of(const std::vector<Term>& denominator);

/// The highest frequency, in rad/s, of those that have not decayed to `left` at time t; 0 if none has.
[[nodiscard]] double fastest_left(const std::vector<Swing>& swings, double t, double left);

}  // namespace drive
