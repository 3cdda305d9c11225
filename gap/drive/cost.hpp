// What fits minimise: residuals as they count, and their differences by free numbers.
#pragma once

#include <vector>

#include "drive/solve.hpp"
#include "gap/drive/candidate.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {

// Residuals of all records in units that make them comparable, and their differences by each free number.
class Cost : public ceres::CostFunction {
public:
    /// \param which  of the candidate's free numbers are the parameters
    Cost(const Study& study, Candidate candidate, bool own_only, std::vector<std::size_t> which,
         const Whitener* whitener);
    bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

private:
    const Study& study_;
    Candidate candidate_;
    bool own_only_;
    std::vector<std::size_t> which_;
    const Whitener* whitener_;
};

/// The places of all free numbers.
[[nodiscard]] std::vector<std::size_t> all_of(const std::vector<FreeParameter*>& free);

/// Half the sum of squares of what counts; infinite where a simulation runs away.
[[nodiscard]] double cost_of(const Study& study, const Candidate& candidate, const Whitener* whitener);

}  // namespace gap
