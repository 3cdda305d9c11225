// Samples that were taken at another time than their stamps say: they spread where the output moves.
#pragma once

#include "gap/drive/candidate.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {

/// Of each sample: its deviation over that of the whitener; empty for a candidate without jitter.
[[nodiscard]] std::vector<double> spread_of(const Study& study, const Candidate& candidate, std::size_t record,
                                            std::span<const double> residuals, const Whitener& whitener);

/// Half width and the noise that is left beside it, by greatest likelihood over the study's records.
void fit_jitter(const Study& study, Candidate& candidate, const Whitener& whitener);

/// The residuals without what a shift of each sample's time within the half width most likely makes of them.
[[nodiscard]] std::vector<double> without_jitter(const Study& study, const Candidate& candidate, std::size_t record,
                                                 std::span<const double> residuals, const Whitener& whitener);

}  // namespace gap
