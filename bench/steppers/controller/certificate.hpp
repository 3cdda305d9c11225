// Is the loop stable that a generated controller closes around a plant, and how far from not being so?
#pragma once

#include <string>

#include "bench/steppers/controller/controller_spec.hpp"
#include "drive/model.hpp"
#include "drive/tune/margins.hpp"

namespace generate {

/// Of the sampled loop, hold and dead time included, where no limit is met. The controller is the header's: the tables
/// of its sums and its gains as its format holds them, not the orders that they stand for.
/// \param name  of the controller's file \param plant_name  of the plant's
/// \throws glsum::Failure (bad input) for an unstable loop, and for a plant as `tune::SampledPlant`
[[nodiscard]] tune::Margins certify(const ControllerSpec& spec, const drive::Model& plant, const std::string& name,
                                    const std::string& plant_name);

/// On one line: gain margin, the least phase margin and largest |S|.
[[nodiscard]] std::string margins_text(const tune::Margins& margins);

}  // namespace generate
