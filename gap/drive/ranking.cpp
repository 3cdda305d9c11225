#include "gap/drive/ranking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gap/drive/jitter.hpp"

namespace gap {
namespace {

constexpr std::size_t most_coefficients = 8;

// A number that was fitted where it is judged costs what chance gains by it; where an event happened was searched for
// besides.
double penalty_of(const Candidate& candidate, const Study& validation) {
    double samples = 0.0;
    for (const auto& count : validation.counts) {
        samples += static_cast<double>(std::count(count.begin(), count.end(), 1));
    }
    double events = 0.0;
    for (const Effect* effect : candidate.effects) {
        events += effect->kind == Kind::event ? 1.0 : 0.0;
    }
    const double chance = std::log(std::max(samples, 3.0));
    return 0.5 * chance * static_cast<double>(candidate.event_parameters()) +
           events * chance * static_cast<double>(validation.courses.size()) +
           2.0 * static_cast<double>(candidate.effect_parameters() + candidate.effects.size());
}

}  // namespace

void judge(Ranked& ranked, const Study& validation, const Whitener& whitener) {
    ranked.by_sample.clear();
    ranked.log_likelihood = 0.0;
    std::vector<std::vector<double>> left;
    for (std::size_t r = 0; r < ranked.residuals.size(); ++r) {
        const auto& residuals = ranked.residuals[r];
        const auto logs =
            whitener.log_likelihood(residuals, spread_of(validation, ranked.candidate, r, residuals, whitener));
        for (std::size_t i = 0; i < logs.size(); ++i) {
            if (validation.counts[r][i] != 0) {
                ranked.by_sample.push_back(std::isfinite(logs[i]) ? logs[i] : -1e6);
                ranked.log_likelihood += ranked.by_sample.back();
            }
        }
        left.push_back(without_jitter(validation, ranked.candidate, r, residuals, whitener));
    }
    ranked.gap_after = rms_of(validation, left) / output_deviation(validation);
    ranked.gap_after = std::isfinite(ranked.gap_after) ? ranked.gap_after : 1e6;  // it ran away
    ranked.penalty = penalty_of(ranked.candidate, validation);
}

Ranked validated(const Study& validation, const Candidate& trained, const Whitener& whitener, bool same_records) {
    Ranked ranked;
    ranked.trained = trained;
    ranked.candidate = same_records ? trained : carried_over(validation, trained, &whitener);
    ranked.residuals = all_residuals(validation, ranked.candidate);
    judge(ranked, validation, whitener);
    return ranked;
}

Interval advantage(const Ranked& a, const Ranked& b) {
    std::vector<double> difference(a.by_sample.size());
    for (std::size_t i = 0; i < difference.size(); ++i) {
        difference[i] = a.by_sample[i] - b.by_sample[i];
    }
    Interval over = bootstrap_sum(difference, difference.size() / 40);
    const double penalty = a.penalty - b.penalty;
    return {over.mean - penalty, over.low - penalty, over.high - penalty};
}

Whitener whitener_of(const Study& study, const Candidate& candidate) {
    std::vector<std::vector<double>> residuals = all_residuals(study, candidate);
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        std::vector<double> kept;
        for (std::size_t i = 0; i < residuals[r].size(); ++i) {
            if (study.counts[r][i] != 0 && std::isfinite(residuals[r][i])) {
                kept.push_back(residuals[r][i]);
            }
        }
        residuals[r] = std::move(kept);
    }
    return fit_whitener(residuals, most_coefficients, study.least_deviation);
}

}  // namespace gap
