#include "drive/solve.hpp"

#include <glog/logging.h>

#include <cstdlib>

namespace drive {

ceres::Solver::Summary solve_in_silence(ceres::Solver::Options options, ceres::Problem& problem) {
    // Whatever its logging_type, Ceres tells glog of each start and step that could not be simulated. These are taken
    // back, and what a descent came to is its caller's to say.
    static const bool asked_for = std::getenv("GLOG_minloglevel") != nullptr;
    if (!asked_for) {
        FLAGS_minloglevel = google::GLOG_FATAL;
    }
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary;
}

}  // namespace drive
