// Where nothing comes near enough to a derivative: which question, asked a little less, has an answer.
#pragma once

#include <string>
#include <vector>

#include "bench/choose/candidate.hpp"
#include "bench/choose/derivative_errors.hpp"

namespace choose {

/// Another goal, and what meets it within the same limits.
struct WouldDo {
    std::string instead;  ///< as options: "--band 0.05..40", "--step-until 60 alone"
    glsum::design::DerivativeGoal goal;
    Candidate fits;
};

/// A goal for less: its band alone and its step alone where both are asked for, half the highest frequency, half the
/// step size. \return with their options' text
[[nodiscard]] std::vector<std::pair<std::string, glsum::design::DerivativeGoal>> lesser_goals(
    const glsum::design::DerivativeGoal& goal);

/// Of those, the ones that some kernel meets, with the cheapest. Shows its progress. \param jobs  threads
[[nodiscard]] std::vector<WouldDo> what_would_do(const glsum::design::DerivativeGoal& goal,
                                                 const std::vector<std::string>& kernels, CostSource& costs,
                                                 const Limits& limits, unsigned jobs = 1);

}  // namespace choose
