// One descent to the least sum of squares that is near, by Ceres.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "drive/predictor.hpp"

namespace drive {

struct Attempt {
    std::vector<double> values;                                       ///< of the free parameters
    double sum_of_squares = std::numeric_limits<double>::infinity();  ///< that if no step could be simulated
    int iterations = 0;
    bool ended = true;    ///< false: at its number of iterations it was still on its way
    std::string stopped;  ///< why
};

struct Descent {
    double accepted_error = 0.0;  ///< stop when the sum of squares is at most this
    int iterations = 200;
    double tolerance = 1e-10;  ///< stop when a step lowers the sum of squares by less, as a part of it
};

/// Trust region (Levenberg-Marquardt) within the form's bounds. \param start  of the free parameters
/// \param noise_model  whitens the residuals; empty: they are as they are
[[nodiscard]] Attempt descend(const Form& form, const Predictor& predictor, std::vector<double> start,
                              const std::vector<double>& noise_model, const Descent& how);

}  // namespace drive
