// A descent by Ceres that prints nothing by itself.
#pragma once

#include <ceres/ceres.h>

namespace drive {

/// ceres::Solve, without its progress and without glog's lines below a fatal one, unless GLOG_minloglevel is set in the
/// environment. \return its summary
[[nodiscard]] ceres::Solver::Summary solve_in_silence(ceres::Solver::Options options, ceres::Problem& problem);

}  // namespace drive
