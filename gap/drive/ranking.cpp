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
double penalty_of(const Candidate& candidate, std::size_t settled, const Study& validation) {
    double samples = 0.0;
    for (const auto& count : validation.counts) {
        samples += static_cast<double>(std::count(count.begin(), count.end(), 1));
    }
    double events = 0.0;
    for (const Effect* effect : candidate.effects) {
        events += effect->kind == Kind::event ? 1.0 : 0.0;
    }
    const double chance = std::log(std::max(samples, 3.0));
    return 0.5 * chance * static_cast<double>(candidate.event_parameters() + settled) +
           events * chance * static_cast<double>(validation.courses.size()) +
           2.0 * static_cast<double>(candidate.effect_parameters() + candidate.effects.size());
}

// The whitener leaves the constant of Student's density out.
constexpr double density_constant = 0.713;

// Of readings that stand for all values within a step: the logarithm of the mass there, over the step, for the noise
// that suits them best. What is left of other candidates says nothing of it. \param outside  by how much the simulation
// misses them
std::vector<double> log_mass(std::span<const double> outside, double step) {
    std::vector<double> best;
    double best_sum = -std::numeric_limits<double>::infinity();
    // From five eighths on it takes nothing more from those within: of these the largest is the best.
    for (const double share : {0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 8.0}) {
        const double noise = share * step;
        std::vector<double> logs;
        double sum = 0.0;
        for (const double miss : outside) {
            const double mass = miss == 0.0 ? std::max(0.5, 1.0 - 0.8 * share)
                                            : 0.5 * std::erfc(std::fabs(miss) / (noise * std::sqrt(2.0)));
            logs.push_back(std::log(std::max(mass, 1e-9) / step) + density_constant);
            sum += logs.back();
        }
        if (sum > best_sum) {
            best_sum = sum;
            best = std::move(logs);
        }
    }
    return best;
}

// What a fitted form of a few coefficients leaves is slow, and the same from sample to sample whatever is added to it:
// whitened, it tells only of kinks. Its size tells, as often as there is anything new in it.
// \param share  of the residuals, that is new
std::vector<double> log_of_slow(std::span<const double> residuals, double deviation, double share) {
    std::vector<double> logs;
    for (const double one : residuals) {
        logs.push_back(-share * (std::log(deviation) + 0.5 * one * one / (deviation * deviation)));
    }
    return logs;
}

}  // namespace

void judge(Ranked& ranked, const Study& validation, const Whitener& whitener) {
    const double step = validation.scales.quantum;
    const bool within_steps = step > 0.0 && ranked.candidate.any(&Effect::rounds);
    ranked.by_sample.clear();
    ranked.log_likelihood = 0.0;
    std::vector<std::vector<double>> left;
    const bool by_size = validation.base.refit && whitener.is_slow();
    const double left_rms = rms_of(validation, ranked.residuals);
    const double size = std::max(left_rms, validation.least_deviation);
    // Whitened residuals hardly know of slow ones. Of those each block of the records counts once.
    constexpr double blocks = 24.0;
    double samples = 0.0;
    for (const auto& count : validation.counts) {
        samples += static_cast<double>(std::count(count.begin(), count.end(), 1));
    }
    const double share_new = std::min(1.0, std::max(blocks / samples, 1.0 / whitener.samples_apart));
    for (std::size_t r = 0; r < ranked.residuals.size(); ++r) {
        const auto& residuals = ranked.residuals[r];
        // What lies within its step is not missed; noise far below a step leaves little else, which is coloured like
        // any other remainder. So is what misses by many steps: no rounding does.
        constexpr double fewest_steps = 0.12;
        constexpr double most_steps = 8.0;
        const bool rounded = within_steps && left_rms >= fewest_steps * step && left_rms <= most_steps * step;
        auto logs = by_size   ? log_of_slow(residuals, size, share_new)
                    : rounded ? log_mass(residuals, step)
                              : whitener.log_likelihood(
                                    residuals, spread_of(validation, ranked.candidate, r, residuals, whitener));
        // No reading tells more than which step it fell on, however well the one before it foresees that it stays
        // there.
        for (double& one : logs) {
            one = step > 0.0 && !by_size ? std::min(one, density_constant - std::log(step)) : one;
        }
        for (std::size_t i = 0; i < logs.size(); ++i) {
            if (validation.counts[r][i] != 0) {
                ranked.by_sample.push_back(std::isfinite(logs[i]) ? logs[i] : -1e6);
                ranked.log_likelihood += ranked.by_sample.back();
            }
        }
        left.push_back(without_jitter(validation, ranked.candidate, r, residuals, whitener));
    }
    ranked.gap_after = rms_of(validation, left) / output_deviation(validation);
    ranked.gap_after = std::isfinite(ranked.gap_after) ? ranked.gap_after : Ranked::ran_away;
    // What ran away has no finite rms, and scores that are no numbers have no order.
    const double slow =
        std::max(std::isfinite(left_rms) ? left_rms : Ranked::ran_away, (within_steps ? 0.05 : 0.29) * step) /
        output_deviation(validation);
    ranked.penalty = penalty_of(ranked.candidate, ranked.settled, validation) +
                     (by_size ? 0.0 : blocks * std::log(std::clamp(slow, 1e-9, Ranked::ran_away)));
}

Ranked validated(const Study& validation, const Candidate& trained, const Whitener& whitener, const Whitener* fits_by,
                 bool same_records, std::size_t settled) {
    Ranked ranked;
    ranked.settled = settled;
    ranked.trained = trained;
    ranked.candidate = same_records ? trained : carried_over(validation, trained, fits_by);
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
