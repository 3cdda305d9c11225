// How well what was fitted is known.
#pragma once

#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {

/// Standard deviations of all that was fitted, from the slopes of the residuals, whitened or not as they were fitted;
/// infinite where nothing tells.
void add_deviations(const Study& study, Candidate& candidate, const Whitener* whitener);

/// Of each free number how much of it, 0 to 1, lies in directions along which numbers move together and residuals do
/// not: of each direction, the square of its part. \param untold  they move less, as squares, than so much of what the
/// direction does that moves them most; at least what rounding is
[[nodiscard]] std::vector<double> untold_shares(const Study& study, Candidate candidate, double untold = 0.0);

}  // namespace gap
