// How the residuals of a candidate move with its free numbers.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {

/// The residuals where a candidate stands, of all records one after another, and their slopes by its free numbers over
/// their scales: a row for each residual, a column for each number.
struct Slopes {
    Eigen::VectorXd residuals;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_number;
};

/// Nothing where a simulation runs away.
/// \param free  the candidate's free numbers, its records' own included
[[nodiscard]] std::optional<Slopes> slopes_of(const Study& study, const Candidate& candidate,
                                              const std::vector<FreeParameter*>& free, const Whitener* whitener);

}  // namespace gap
