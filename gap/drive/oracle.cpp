#include "gap/drive/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "gap/drive/jitter.hpp"
#include "gap/drive/ranking.hpp"

namespace gap {
namespace {

using Effects = std::vector<const Effect*>;

std::size_t free_count(Candidate candidate) { return free_numbers(candidate, false).size(); }

double sample_count(const Study& study) {
    double count = 0.0;
    for (const auto& record : study.counts) {
        count += static_cast<double>(std::count(record.begin(), record.end(), 1));
    }
    return count;
}

// N log of the variance that is left, and log N for each number.
double plain_bic(const Study& study, const Candidate& candidate) {
    const double count = sample_count(study);
    const double left = std::max(rms_of(study, all_residuals(study, candidate)), study.least_deviation);
    return 2.0 * count * std::log(left) + static_cast<double>(free_count(candidate)) * std::log(count);
}

double whitened_bic(const Study& study, const Candidate& candidate) {
    const double count = sample_count(study);
    const Whitener own = whitener_of(study, candidate);
    return 2.0 * count * std::log(own.deviation) +
           static_cast<double>(free_count(candidate) + own.coefficients.size()) * std::log(count);
}

std::string least(const std::vector<Candidate>& all, const Study& study,
                  double (*criterion)(const Study&, const Candidate&)) {
    double lowest = std::numeric_limits<double>::infinity();
    std::string name = "none";
    for (const Candidate& candidate : all) {
        if (const double value = criterion(study, candidate); value < lowest) {
            lowest = value;
            name = candidate.name();
        }
    }
    return name;
}

// One effect after the other, in whichever order goes further.
Candidate fit_together(const Ground& ground, const Effects& truth, const Candidate& none) {
    Candidate best = none;
    best.cost = std::numeric_limits<double>::infinity();
    Effects order = truth;
    std::sort(order.begin(), order.end());
    do {
        Candidate grown = none;
        for (std::size_t size = 1; size <= order.size(); ++size) {
            const Effects first(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(size));
            grown = fit(ground.study, first, fit(ground.sketch, first, grown, nullptr), nullptr);
        }
        if (grown.cost < best.cost) {
            best = grown;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

}  // namespace

Foresight foresee(const Question& question, const std::vector<std::string>& truth) {
    const Ground ground = prepare(question);
    const Study& study = ground.study;
    const Candidate none = fit(study, {}, fit(ground.sketch, {}, {}, nullptr, {6, 2, 60}), nullptr);
    std::vector<Candidate> all(ground.list.size() + 1, none);
    base::parallel_for(ground.list.size(), question.jobs, [&](std::size_t i) {
        all[i + 1] = fit(study, {ground.list[i]}, fit(ground.sketch, {ground.list[i]}, none, nullptr), nullptr);
    });
    Foresight foresight;
    foresight.by_plain_bic = least(all, study, plain_bic);
    foresight.by_whitened_bic = least(all, study, whitened_bic);

    Effects true_effects;
    for (const Effect* effect : ground.list) {
        if (std::find(truth.begin(), truth.end(), effect->name) != truth.end()) {
            true_effects.push_back(effect);
        }
    }
    Candidate right = true_effects.empty() ? none : fit_together(ground, true_effects, none);
    const Whitener whitener = whitener_of(study, right);
    const Whitener* fits_by = study.base.refit ? nullptr : &whitener;
    const auto judged = [&](const Candidate& candidate) {
        Candidate fitted = fit(study, candidate.effects, candidate, fits_by);
        fit_jitter(study, fitted, whitener);
        return validated(ground.validation, fitted, whitener, fits_by, ground.same_records);
    };
    const Ranked oracle = judged(right);
    foresight.gap_after = oracle.gap_after;
    std::vector<double> likelihoods(all.size(), -std::numeric_limits<double>::infinity());
    base::parallel_for(all.size(), question.jobs, [&](std::size_t i) {
        if (all[i].name() != right.name()) {
            const Ranked other = judged(all[i]);
            likelihoods[i] = other.log_likelihood;
            if (all[i].effects.empty()) {
                foresight.gap_base = other.gap_after;
            }
        }
    });
    if (true_effects.empty()) {
        foresight.gap_base = oracle.gap_after;
        return foresight;
    }
    const auto next = std::max_element(likelihoods.begin(), likelihoods.end());
    foresight.lead = oracle.log_likelihood - *next;
    foresight.nearest = all[static_cast<std::size_t>(next - likelihoods.begin())].name();
    return foresight;
}

}  // namespace gap
