// Candidates by what they leave on data that they have not fitted.
#pragma once

#include "gap/drive/fit.hpp"

namespace gap {

struct Ranked {
    Candidate candidate;                         ///< as it stands on the validation records
    Candidate trained;                           ///< as it was fitted
    std::vector<std::vector<double>> residuals;  ///< of the validation records
    /// In place of a gap that is not finite: the simulation ran away.
    static constexpr double ran_away = 1e6;
    double gap_after = 0.0;         ///< rms of what counts over the deviation of the measured output
    double log_likelihood = 0.0;    ///< over what counts
    std::vector<double> by_sample;  ///< its summands
    std::size_t settled = 0;        ///< numbers of lasting effects that validation told
    double penalty = 0.0;           ///< for what is fitted there, and for effects and their numbers
    [[nodiscard]] double score() const { return log_likelihood - penalty; }
};

/// The candidate on the validation records. \param fits_by  whitens residuals for fits there; null: they stay as they
/// are \param same_records  validation is a part of the records that were fitted \param settled  numbers of its lasting
/// effects that validation told
[[nodiscard]] Ranked validated(const Study& validation, const Candidate& trained, const Whitener& whitener,
                               const Whitener* fits_by, bool same_records, std::size_t settled = 0);

/// Likelihood and gap anew, after another whitener.
void judge(Ranked& ranked, const Study& validation, const Whitener& whitener);

/// A likelihood ratio that chance does not reach among some hundred candidates.
constexpr double clear_advantage = 8.0;

/// By how much a is more likely than b, penalties included, with bounds from redrawn blocks of samples.
[[nodiscard]] Interval advantage(const Ranked& a, const Ranked& b);

/// An autoregressive model of what a candidate leaves on its own records.
[[nodiscard]] Whitener whitener_of(const Study& study, const Candidate& candidate);

}  // namespace gap
