// The oracle: the step response of a model to many digits, in multi-precision, by Talbot's contour.
#pragma once

#include <string>

#include "drive/model.hpp"

namespace drive {

/// The response at time `t_s` to a unit step at 0, for the model's numbers as the doubles that they are.
struct ExactValue {
    double value;
    std::string digits;  ///< the same with `agreed_digits` significant digits
    int agreed_digits;   ///< in which two runs of different precision agree
};

/// Fixed Talbot method (Abate and Valko, Int. J. Numer. Meth. Engng 60, 2004) with 48, 96, 192, 384 nodes in as many
/// digits, until two runs agree to `wanted_digits`. A dead time shifts; before it the response is 0.
/// \param wanted_digits  1 to 40
/// \throws glsum::Failure (check failed) where no two runs agree: too lightly damped, or unstable, for so late a time.
[[nodiscard]] ExactValue exact_step_response(const Model& model, double t_s, int wanted_digits = 18);

}  // namespace drive
