// The picture of what was chosen for a derivative: gain and phase over frequency, and a step's response.
#pragma once

#include <filesystem>

#include "bench/choose/derivative_errors.hpp"

namespace choose {

/// Errors of gain (%) and phase (degrees) from a tenth of the band to half the sampling rate, the band shaded, and of
/// the step's response (%), each beside the same of the full-memory sum. Panels of what the goal does not ask for are
/// left out. Writes `stem`.svg and `stem`.png. \throws as base::draw
void plot_derivative(const DerivativeReport& report, const glsum::design::DerivativeGoal& goal, double limit,
                     const std::filesystem::path& stem);

}  // namespace choose
