// What a residual may depend on, whatever causes it: the columns of a model without physics.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/drive/residuals/flexible.hpp"

namespace gap {

/// What the columns are scaled by, over all records.
struct Range {
    double input = 0.0;  ///< largest size
    double low = 0.0;    ///< of the simulated output
    double high = 0.0;
    double speed = 0.0;  ///< of the simulated output: largest size, units/s
    double length_s = 0.0;
};
/// \param all  at least one, of at least one sample
[[nodiscard]] Range range_of(const std::vector<const Remainder*>& all);

/// A row a sample: lagged inputs and simulated outputs, their products, powers, signs and bends, speed, time and waves
/// over the output, which runs from -1 to 1. \param range  of sizes above 0
[[nodiscard]] Eigen::MatrixXd features_of(const Remainder& of, const Range& range, double delay_s,
                                          double time_constant_s);

}  // namespace gap
