// Intervals by profile likelihood.
#pragma once

#include <vector>

#include "drive/fit.hpp"

namespace drive {

/// Replaces the straight intervals of the parameters that the records tell. \param values  of all parameters, at the
/// least sum of squares  \param least  that sum, whitened  \return false where a profile has met a lower one
[[nodiscard]] bool profile_intervals(Fit& fit, const Form& form, const std::vector<Record>& records,
                                     const std::vector<double>& values, const FitOptions& options, double least);

}  // namespace drive
