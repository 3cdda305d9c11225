// A controller's header as it was written, with what it is checked over.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/steppers/controller/controller_spec.hpp"
#include "bench/steppers/stepper/check_source.hpp"

namespace generate {

/// Set points and readings, of equal length.
struct CheckRecord {
    std::vector<float> setpoint;
    std::vector<float> measured;
};

/// 4000 samples: steps of the set point, a reading that follows late and noisily; the last quarter is a hundred times
/// as large, so that limits are met.
[[nodiscard]] CheckRecord check_record();

/// A value of the record in q31: of 16 as full scale, where the last quarter saturates.
[[nodiscard]] std::int32_t to_fraction(float value);

/// \param text  the header of `spec` with this prefix
[[nodiscard]] WrittenStepper written(const ControllerSpec& spec, const std::string& prefix, std::string text);

/// The same gains and limits with orders (1, 1).
[[nodiscard]] ControllerSpec whole_orders(const ControllerSpec& spec);

}  // namespace generate
