#include "gap/drive/decide/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gap/drive/determined.hpp"
#include "gap/drive/in_step.hpp"
#include "gap/drive/outside.hpp"

namespace gap {
namespace {

std::vector<Remainder> remainders(const Study& study, const std::vector<std::vector<double>>& residuals) {
    std::vector<Remainder> all;
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        Remainder one{&study.courses[r].record(), study.courses[r].record().output, residuals[r], study.counts[r]};
        for (std::size_t i = 0; i < one.simulated.size(); ++i) {
            one.simulated[i] -= residuals[r][i];
        }
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace

bool contains(const Candidate& wider, const Candidate& narrower) {
    return std::all_of(narrower.effects.begin(), narrower.effects.end(),
                       [&](const Effect* effect) { return wider.has(effect->name); });
}

bool goes_beyond(const Candidate& wider, const Candidate& narrower) {
    return std::ranges::all_of(narrower.effects, [&](const Effect* mine) {
        return std::ranges::any_of(wider.effects,
                                   [&](const Effect* theirs) { return theirs == mine || theirs->covers(*mine); });
    });
}

bool is_clear(const Interval& over) { return over.mean > clear_advantage && over.low > 0.0; }

Evidence::Evidence(const std::vector<Ranked>& ranked, const Whitener& whitener, const Study& trained,
                   const Study& validated, bool same, FoundOut known)
    : ranking(ranked),
      study(trained),
      validation(validated),
      same_records(same),
      whitener_(whitener),
      known_(std::move(known)) {}

std::size_t Evidence::none() const {
    return static_cast<std::size_t>(std::find_if(ranking.begin(), ranking.end(),
                                                 [](const Ranked& ranked) { return ranked.trained.effects.empty(); }) -
                                    ranking.begin());
}

std::optional<std::size_t> Evidence::best_of(std::size_t size) const {
    for (std::size_t i = 0; i < ranking.size(); ++i) {
        if (ranking[i].trained.effects.size() == size && objection(i).empty()) {
            return i;
        }
    }
    return std::nullopt;
}

double Evidence::over_noise(double gap) const {
    return gap::over_noise(validation, gap * output_deviation(validation));
}

bool Evidence::leaves_noise_alone(double left) const {
    constexpr double a_twentieth = 0.05;
    return left < a_twentieth * gap(none()) && !is_no_noise(left);
}

bool Evidence::is_small_of_a_form(double gap) const {
    return gap < small_gap_of_clean_readings || (gap < small_gap_of_a_form && over_noise(gap) < most_sensors);
}

const Flexible& Evidence::remainder(std::size_t i) const {
    const auto known = known_.remainders.find(i);
    if (known != known_.remainders.end()) {
        return known->second;
    }
    std::vector<Remainder> also;
    if (!same_records) {
        also = remainders(study, all_residuals(study, ranking[i].trained));
    }
    std::vector<Remainder> judged = remainders(validation, ranking[i].residuals);
    if (level_share(i) > 0.0) {
        for (Remainder& one : judged) {
            take_off_mean(one);
        }
    }
    return known_.remainders
        .emplace(i, explain(judged, also, model_of(study.base.form).delay_s, study.scales.time_constant_s))
        .first->second;
}

double Evidence::level_share(std::size_t i) const {
    if (!beside_form() || i != none()) {
        return 0.0;
    }
    // Beyond a quarter of the output's deviation something has moved it.
    constexpr double most = 0.25;
    const double least_square = validation.least_deviation * validation.least_deviation;
    const Disturbance left = disturbance_of(remainders(validation, ranking[i].residuals), least_square);
    const double all = left.mean_square + left.rms * left.rms;
    return all > 0.0 && std::sqrt(left.mean_square) < most * output_deviation(validation) ? left.mean_square / all
                                                                                          : 0.0;
}

bool Evidence::leaves_a_disturbance(std::size_t i) const {
    // What follows the input in some blocks alone is not told from what does not.
    constexpr double undecided = 1.0 / 3.0;
    if (!beside_form() || !study.scales.driven || ranking[i].trained.has_events() || remainder(i).certain ||
        remainder(i).explained > undecided) {
        return false;
    }
    const auto left = [&](const Study& of, const std::vector<std::vector<double>>& residuals) {
        return disturbance_of(remainders(of, residuals), of.least_deviation * of.least_deviation);
    };
    return are_one_disturbance(left(study, all_residuals(study, ranking[i].trained)),
                               left(validation, ranking[i].residuals));
}

const std::string& Evidence::objection(std::size_t i) const {
    const auto known = known_.objections.find(i);
    if (known != known_.objections.end()) {
        return known->second;
    }
    std::string what;
    if (!ranking[i].trained.effects.empty()) {
        Candidate trained = ranking[i].trained;
        add_intervals(study, trained, beside_form() ? nullptr : &whitener_);
        what = untold_of(study, trained, [&](const Effect& effect) { return training_needs(i, effect); });
        if (what.empty() && beside_form()) {
            what = linear_of(study, trained);
        }
        if (what.empty() && beside_form()) {
            what = in_step_with_input(study, trained);
        }
        if (what.empty() && beside_form() && trained.has_events()) {
            what = doubt_of_events(study, trained, validation, ranking[i].candidate);
            what = what.empty() ? objection_to_events(trained, ranking[i].candidate, gap(i))
                                : what + ": an event from outside does not";
        }
    }
    return known_.objections.emplace(i, std::move(what)).first->second;
}

bool Evidence::training_needs(std::size_t i, const Effect& effect) const {
    constexpr double many_times = 4.0;
    const Candidate& mine = ranking[i].trained;
    std::vector<const Effect*> others = mine.effects;
    std::erase(others, &effect);
    const auto without = std::ranges::find_if(
        ranking, [&](const Ranked& ranked) { return std::ranges::is_permutation(ranked.trained.effects, others); });
    return beside_form() && mine.cost > 0.0 && without != ranking.end() &&
           without->trained.cost > many_times * mine.cost;
}

bool Evidence::is_open(std::size_t i) const {
    const auto known = known_.open.find(i);
    return known != known_.open.end() ? known->second
                                      : known_.open.emplace(i, leaves_open(study, ranking[i].trained)).first->second;
}

// Of events beside a fitted form. \param trained  with its intervals
std::string Evidence::objection_to_events(const Candidate& trained, Candidate judged, double left) const {
    add_intervals(validation, judged, nullptr);
    for (const Effect* effect : trained.effects) {
        if (effect->kind != Kind::event) {
            continue;
        }
        const double least_size = least_felt(*effect, trained, judged);
        const auto needs = [&](const Study& of, const Candidate& candidate) {
            return std::count_if(candidate.own.begin(), candidate.own.end(),
                                 [&](const auto& own) { return needs_event(of, own, *effect, least_size); });
        };
        const auto fitted = needs(study, trained);
        const auto validated = needs(validation, judged);
        if (validated == 0) {
            return fmt::format("validation does not tell {} from none", effect->name);
        }
        if (!same_records && !leaves_noise_alone(left) &&
            fitted + validated == static_cast<std::ptrdiff_t>(trained.own.size() + judged.own.size())) {
            return fmt::format("every record needs a {} of its own", effect->name);
        }
    }
    return "";
}

}  // namespace gap
