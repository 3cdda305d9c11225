// How well what was fitted is known.
#pragma once

#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {

/// Standard deviations of all that was fitted, from the slopes of the residuals, whitened or not as they were fitted;
/// infinite where nothing tells.
void add_deviations(const Study& study, Candidate& candidate, const Whitener* whitener);

/// Of each free number how much of it, 0 to 1, lies in directions along which numbers move together and no residual
/// does: of each direction, the square of its part.
[[nodiscard]] std::vector<double> untold_shares(const Study& study, Candidate candidate);

}  // namespace gap
