// Controller files: a sampled fractional PID with all that its firmware needs, as JSON without loss.
//
//   {"kind": "fopid", "kp": 0.3, "ki": 0.5, "kd": 0.02, "integral_order": 0.9, "derivative_order": 0.7,
//    "filter_s": 0.01, "sample_time_s": 0.001, "low": 0, "high": 1, "setpoint_weight": 0.8}
//
// kp, ki, kd and filter_s may be left out where they are 0, orders and weight where they are 1, low and high where
// nothing limits the output. Other fields are kept.
#pragma once

#include <limits>
#include <string>

#include "drive/controller.hpp"

namespace drive {

/// u = kp (b r - y) + ki D^-integral_order (r - y) + kd D^derivative_order (b r - y) / (filter_s s + 1), within limits.
struct Fopid {
    Gains gains;
    double sample_time_s = 0.0;                             ///< above 0
    double low = -std::numeric_limits<double>::infinity();  ///< of u
    double high = std::numeric_limits<double>::infinity();  ///< above `low`
    double setpoint_weight = 1.0;                           ///< b, in [0, 1]: of r in what acts at once
    std::string notes;                                      ///< the file's further fields, as JSON, handed through
};

/// \throws glsum::Failure (bad input) unless the controller can be stepped: finite gains, one of them other than 0,
/// orders above 0 and at most 1, a filter of 0 s or more, a sample time above 0 s, low below high, a weight of 0 to 1.
/// \param name  begins the message
void check_fopid(const Fopid& controller, const std::string& name);

/// \param name  begins every message
/// \throws glsum::Failure (bad input) naming the file, the line or the field, what was expected and what was found.
[[nodiscard]] Fopid parse_fopid(const std::string& text, const std::string& name);

/// The text of a file: every number in its shortest form that reads back to the same double, further fields included.
[[nodiscard]] std::string to_json(const Fopid& controller);

}  // namespace drive
