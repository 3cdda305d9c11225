// What records tell of the numbers that a candidate shares among them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {

/// Of the numbers that all records share (base, then lasting effects), each in units of its scale and over the
/// readings' noise; the records' own numbers are fitted beside them.
struct Told {
    Eigen::MatrixXd information;
    double variance = 1.0;  ///< of the whitened residuals, at least 1: misfit makes intervals wide, too
};

/// Nothing where the candidate runs away. \param whitener  of what it leaves in training
[[nodiscard]] std::optional<Told> told_by(const Study& study, Candidate candidate, const Whitener& whitener);

/// Standard deviations of the shared numbers in units of their scales. A number cannot be further off than its bounds.
/// \param information  what is told in all, over the noise of `told`
[[nodiscard]] std::vector<double> deviations_from(const Told& told, const Eigen::MatrixXd& information,
                                                  Candidate candidate);

}  // namespace gap
