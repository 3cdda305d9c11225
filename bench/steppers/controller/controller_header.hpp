// A fractional PID controller as one C99 header: its two sums as `make_header` writes them, and the statements of
// glsum/model/pid.h, in q31 of pid_q31.h, around them.
#pragma once

#include <string>
#include <vector>

#include "bench/steppers/controller/controller_spec.hpp"

namespace generate {

/// Its self-check runs 592 samples: `check_signal` 16 times, as the set point and, five samples on, as what is
/// measured. \param prefix  begins every identifier \param lines  of the opening comment: where it comes from, what was
/// measured \throws glsum::Failure (bad input) for a prefix that is no identifier, (check failed) as `integral_sum`
[[nodiscard]] std::string make_controller_header(const ControllerSpec& spec, const std::string& prefix,
                                                 const std::string& licence, const std::vector<std::string>& lines);

}  // namespace generate
