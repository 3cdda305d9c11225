// A controller by its gains, as a transfer function.
#pragma once

#include <string>

#include "drive/model.hpp"

namespace drive {

/// Gains of a controller kp + ki / s^integral_order + kd s^derivative_order / (filter_s s + 1).
struct Gains {
    double kp = 0.0;
    double ki = 0.0;
    double kd = 0.0;
    double filter_s = 0.0;
    double integral_order = 1.0;
    double derivative_order = 1.0;
};

/// The controller as a transfer function. \throws glsum::Failure (bad input) naming what is wrong: no gain, a
/// derivative without a filter, orders that are not above 0, \param name begins the message
[[nodiscard]] Model to_model(const Gains& gains, const std::string& name);

/// What a held unit error puts out at once: the ratio of the leading coefficients, 0 if the controller is strictly
/// proper.
[[nodiscard]] double direct_gain(const Model& controller);

}  // namespace drive
