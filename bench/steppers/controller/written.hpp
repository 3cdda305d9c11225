// A controller's header as it was written, with what it is checked over.
#pragma once

#include <string>
#include <vector>

#include "bench/steppers/controller/stepped.hpp"
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

/// \param text  the header of `spec` with this prefix
[[nodiscard]] WrittenStepper written(const ControllerSpec& spec, const std::string& prefix, std::string text);

/// The same gains and limits with orders (1, 1).
[[nodiscard]] ControllerSpec whole_orders(const ControllerSpec& spec);

}  // namespace generate
