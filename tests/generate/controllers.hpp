// Controllers that headers are made of.
#pragma once

#include "bench/steppers/controller/controller_spec.hpp"

namespace controllers {

/// All of its gains times a factor.
inline generate::ControllerSpec fractional(double scale = 1.0) {
    generate::ControllerSpec spec;
    spec.controller.gains = {.kp = 0.3 * scale,
                             .ki = 0.5 * scale,
                             .kd = 0.02 * scale,
                             .filter_s = 0.01,
                             .integral_order = 0.9,
                             .derivative_order = 0.7};
    spec.controller.sample_time_s = 0.001;
    return spec;
}

/// kp + ki / s + kd s / (filter_s s + 1), all powers of two: h ki = 0.5, kd / h = 0.5, and the filter passes a half.
inline generate::ControllerSpec whole() {
    generate::ControllerSpec spec;
    spec.controller.gains = {.kp = 0.5, .ki = 1.0, .kd = 0.25, .filter_s = 0.5};
    spec.controller.sample_time_s = 0.5;
    spec.controller.low = -2.0;
    spec.controller.high = 2.0;
    return spec;
}

}  // namespace controllers
