// How far a model is from a measurement: the indices of [Matusiak2020], Tables 2 and 3.
#pragma once

#include <span>
#include <string>

namespace drive {

/// e = measured - modelled; integrals by the trapezoidal rule over the stamps, time counted from the first.
struct Indices {
    double ise = 0.0;                 ///< integral of e^2
    double iae = 0.0;                 ///< integral of |e|
    double itse = 0.0;                ///< integral of t e^2
    double itae = 0.0;                ///< integral of t |e|
    double max_ape = 0.0;             ///< max |e| / |measured|, over samples whose measured value is not 0
    std::size_t max_ape_skipped = 0;  ///< samples left out of it: measured exactly 0
    /// 1 - sqrt(sum e^2) / (T (max - min)) with T the number of samples: the formula that the paper prints.
    double nrmse_printed = 0.0;
    /// 1 - ||e|| / ||measured - mean||: MATLAB's fit, which the paper's values are.
    double nrmse_fit = 0.0;
    double rmse = 0.0;
    double max_error = 0.0;
};

/// Times rise; all three have the same length of at least 2.
/// \throws glsum::Failure (bad input): other lengths, or a measured output that is constant (no NRMSE exists).
[[nodiscard]] Indices compute_indices(std::span<const double> time_s, std::span<const double> measured,
                                      std::span<const double> modelled);

}  // namespace drive
