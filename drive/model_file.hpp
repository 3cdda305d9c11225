// Model files: JSON, read with bounds and written back without loss.
//
//   {"kind": "fotf", "gain": 1.0, "numerator": [{"coefficient": 1, "order": 0}],
//    "denominator": [{"coefficient": 0.18234, "order": 1.9909}, ...], "delay_s": 1.0, "sample_time_s": 0.001}
//
// Shorthands: {"kind": "fopdt", "gain": 1, "time_constant_s": 0.4934, "delay_s": 1.2279}; "sopdt" the same, its two
// time constants being equal; "niopdt" as "fotf" without a numerator. gain, delay_s and a numerator of 1 may be left
// out.
#pragma once

#include <cstddef>
#include <string>

#include "drive/model.hpp"

namespace drive {

/// A model file has at most so many bytes.
inline constexpr std::size_t most_model_bytes = 1u << 20;

/// \param name  begins every message
/// \throws glsum::Failure (bad input) naming the file, the line or the field, what was expected and what was found.
[[nodiscard]] Model parse_model(const std::string& text, const std::string& name);

/// A controller: a model as above, or {"kind": "pid", "kp": 2, "ki": 1.5, "kd": 0.1, "filter_s": 0.02}, of which what
/// is 0 may be left out; "integral_order" and "derivative_order" make it fractional. \throws as `parse_model`
[[nodiscard]] Model parse_controller(const std::string& text, const std::string& name);

/// The text of a file: every number in its shortest form that reads back to the same double, further fields included.
[[nodiscard]] std::string to_json(const Model& model);

}  // namespace drive
