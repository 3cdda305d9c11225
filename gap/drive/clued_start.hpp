// Where an effect would start by what the residuals without it tell.
#pragma once

#include "gap/drive/candidate.hpp"

namespace gap {

/// The effect's parameters at a start that the residuals of a candidate without it tell, of the study's longest record;
/// none for an effect that looks for none (Effect::start), or where the candidate runs away.
[[nodiscard]] std::vector<FreeParameter> clued_start(const Study& study, const Candidate& without,
                                                     const Effect& effect);

}  // namespace gap
