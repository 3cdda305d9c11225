// Records as equations between samples take them: evenly spaced.
#pragma once

#include <Eigen/Core>

#include "gap/drive/record.hpp"

namespace gap {

/// What is logged more densely is averaged; of part_of(record).
struct Even {
    double step_s;
    double length_s;        ///< from the first stamp to the last
    Eigen::VectorXd input;  ///< held behind each sample
    Eigen::VectorXd output;
};

[[nodiscard]] Even even_of(const Record& record);

/// The value `by` samples before; before the first one, the first.
[[nodiscard]] Eigen::VectorXd late(const Eigen::VectorXd& values, Eigen::Index by);

}  // namespace gap
