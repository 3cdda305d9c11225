#include "drive/solve.hpp"

#include <glog/logging.h>

#include <cstdlib>

namespace drive {

ceres::Solver::Summary solve_in_silence(ceres::Solver::Options options, ceres::Problem& problem) {
    // Whatever its logging_type, Ceres tells glog of each start and step that could not be simulated. These are taken
    // back, and what a descent came to is its caller's to say.
    [[maybe_unused]] static const bool once = [] {
        if (std::getenv("GLOG_minloglevel") == nullptr) {
            FLAGS_minloglevel = google::GLOG_FATAL;
        }
        return true;
    }();
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return summary;
}

}  // namespace drive
