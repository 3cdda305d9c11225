#include "gap/drive/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "drive/solve.hpp"
#include "gap/drive/clued_start.hpp"
#include "gap/drive/cost.hpp"
#include "gap/drive/kept_slope.hpp"
#include "gap/drive/own_start.hpp"

namespace gap {
namespace {

// Some of a candidate's free numbers; whether they took a thousandth off the cost.
bool descend_along(const std::vector<std::size_t>& which, const Study& study, Candidate& candidate, bool own_only,
                   const Whitener* whitener, int iterations) {
    const std::vector<FreeParameter*> free = free_numbers(candidate, own_only);
    std::vector<double> values;
    for (const std::size_t i : which) {
        values.push_back(free[i]->value / free[i]->scale);
    }
    ceres::Problem problem;
    problem.AddResidualBlock(new Cost(study, candidate, own_only, which, whitener), nullptr, values.data());
    for (std::size_t k = 0; k < which.size(); ++k) {
        const FreeParameter& parameter = *free[which[k]];
        problem.SetParameterLowerBound(values.data(), static_cast<int>(k), parameter.lower / parameter.scale);
        problem.SetParameterUpperBound(values.data(), static_cast<int>(k), parameter.upper / parameter.scale);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = iterations;
    // Where there are bounds Ceres searches along each step; with gradients that is a whole set of simulations more.
    // A much shorter step would take next to nothing off, and look like the end.
    options.line_search_interpolation_type = ceres::QUADRATIC;
    options.max_line_search_step_contraction = 0.2;
    // Half the sum of squares of some thousand samples is some thousand: a twentieth of a unit of likelihood.
    options.function_tolerance = iterations < 10 ? 5e-4 : 2e-5;
    const ceres::Solver::Summary summary = drive::solve_in_silence(options, problem);
    if (!summary.IsSolutionUsable() || !(summary.final_cost <= candidate.cost)) {
        return false;
    }
    for (std::size_t k = 0; k < which.size(); ++k) {
        free[which[k]]->value = values[k] * free[which[k]]->scale;
    }
    const bool further = summary.final_cost < 0.999 * candidate.cost;
    candidate.cost = summary.final_cost;
    return further;
}

void descend(const Study& study, Candidate& candidate, bool own_only, const Whitener* whitener, int iterations) {
    candidate.cost = cost_of(study, candidate, whitener);
    const std::vector<FreeParameter*> free = free_numbers(candidate, own_only);
    if (free.empty() || !std::isfinite(candidate.cost) || iterations == 0) {
        return;
    }
    descend_along(all_of(free), study, candidate, own_only, whitener, iterations);
    // Ceres cuts a step off at the bounds, and a step that mostly leads beyond one leads nowhere. Those that lie at
    // theirs stay there while the others go on, and are then tried again.
    for (int round = 0; round < 3 && iterations >= 10; ++round) {
        std::vector<std::size_t> inside;
        for (std::size_t i = 0; i < free.size(); ++i) {
            const double margin = 1e-6 * free[i]->scale;
            if (free[i]->value > free[i]->lower + margin && free[i]->value < free[i]->upper - margin) {
                inside.push_back(i);
            }
        }
        if (inside.empty() || inside.size() == free.size() ||
            !descend_along(inside, study, candidate, own_only, whitener, iterations)) {
            return;
        }
        descend_along(all_of(free), study, candidate, own_only, whitener, iterations);
    }
}

// A fitted base first meets what is new as it is: moved all at once from an effect's start, which may be far from any
// good one, the base would leave its place and not find back.
void approach(const Study& study, Candidate& candidate, const Whitener* whitener) {
    if (!study.base.refit) {
        return;
    }
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    std::vector<std::size_t> of_effects;
    for (std::size_t i = 0; i < free.size(); ++i) {
        if (free[i]->name.find('.') != std::string::npos) {
            of_effects.push_back(i);
        }
    }
    candidate.cost = cost_of(study, candidate, whitener);
    if (!of_effects.empty() && std::isfinite(candidate.cost)) {
        constexpr int steps = 5;
        descend_along(of_effects, study, candidate, false, whitener, steps);
    }
}

// Events where the residuals of what is there without them say that they were.
void guess_events(const Study& study, Candidate& attempt) {
    if (std::none_of(attempt.effects.begin(), attempt.effects.end(),
                     [](const Effect* effect) { return effect->guess != nullptr; })) {
        return;
    }
    for (const Effect* effect : attempt.effects) {
        if (effect->guess == nullptr) {
            continue;
        }
        for (std::size_t r = 0; r < study.courses.size(); ++r) {
            std::vector<double> residuals = residuals_of(study, attempt, r);
            for (std::size_t i = 0; i < residuals.size(); ++i) {
                residuals[i] = study.counts[r][i] != 0 && std::isfinite(residuals[i]) ? residuals[i] : 0.0;
            }
            const std::vector<double> values =
                effect->guess({study.courses[r], scenario_of(study, attempt, r), residuals, study.scales});
            std::size_t next = 0;
            for (FreeParameter& parameter : attempt.own[r]) {
                if (parameter.name.starts_with(effect->name + ".")) {
                    parameter.value = std::clamp(values[next++], parameter.lower, parameter.upper);
                }
            }
        }
    }
}

// Own numbers of a record: its state and those of lasting effects as another candidate has them, events at rest.
std::vector<FreeParameter> own_of(const Study& study, std::size_t record, const std::vector<const Effect*>& effects,
                                  const Candidate& start) {
    std::vector<FreeParameter> own = state_of(study, study.courses[record].record());
    if (record < start.own.size()) {
        std::copy_n(start.own[record].begin(), own.size(), own.begin());
    }
    for (const Effect* effect : effects) {
        auto more = own_parameters_of(*effect, study.scales);
        for (std::size_t i = 0; i < more.size(); ++i) {
            if (effect->guess != nullptr) {
                more[i].value = std::clamp(effect->parameters(study.scales)[i].none, more[i].lower, more[i].upper);
            } else if (effect->kind == Kind::lasting && record < start.own.size()) {
                const auto known = std::ranges::find(start.own[record], more[i].name, &FreeParameter::name);
                more[i] = known == start.own[record].end() ? more[i] : *known;
            }
        }
        own.insert(own.end(), more.begin(), more.end());
    }
    return own;
}

void hold_effects(Candidate& candidate) {
    for (auto& numbers : candidate.lasting) {
        for (FreeParameter& number : numbers) {
            number.fixed = true;
        }
    }
}

// A candidate's effects at the values at which they are not there, but for those that the start has, on the start's
// base.
Candidate without_new_effects(const Study& study, const Candidate& of, const Candidate& start) {
    Candidate absent = of;
    absent.base = start.base;
    std::size_t lasting = 0;
    for (const Effect* effect : absent.effects) {
        if (effect->kind != Kind::lasting) {
            continue;
        }
        std::vector<FreeParameter>& numbers = absent.lasting[lasting++];
        if (const auto* known = start.numbers_of(effect)) {
            numbers = *known;
            continue;
        }
        const std::vector<EffectParameter> named = effect->parameters(study.scales);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i].value =
                numbers[i].fixed ? numbers[i].value : std::clamp(named[i].none, numbers[i].lower, numbers[i].upper);
        }
    }
    for (std::size_t r = 0; r < absent.own.size(); ++r) {
        absent.own[r] = own_of(study, r, absent.effects, start);
    }
    return absent;
}

}  // namespace

double weighed_cost(const Candidate& candidate) {
    constexpr double each = 0.85;
    return candidate.cost / std::pow(each, static_cast<double>(candidate.effect_parameters()));
}

Candidate fit(const Study& study, const std::vector<const Effect*>& effects, const Candidate& start,
              const Whitener* whitener, const Effort& effort) {
    std::size_t count = 1;
    for (const Effect* effect : effects) {
        if (start.numbers_of(effect) == nullptr) {
            count = std::max(count, starts_of(*effect, study.scales));
        }
    }
    // One start more, where an effect can tell from what is left without it.
    const bool clued = std::any_of(effects.begin(), effects.end(), [&](const Effect* effect) {
        return effect->start != nullptr && start.numbers_of(effect) == nullptr;
    });
    count += clued ? 1 : 0;
    const bool in_stages = count > 1 || std::isfinite(effort.hopeless);
    std::vector<Candidate> attempts;
    for (std::size_t s = effort.only_start.value_or(0); s < count && s <= effort.only_start.value_or(count); ++s) {
        Candidate attempt;
        attempt.effects = effects;
        attempt.base = start.base.empty() ? base_of(study) : start.base;
        for (const Effect* effect : effects) {
            if (effect->kind == Kind::lasting) {
                // What another candidate knows of the same effect is a better start than any.
                const auto* known = start.numbers_of(effect);
                std::vector<FreeParameter> told;
                if (known == nullptr && clued && s + 1 == count && !start.own.empty()) {
                    told = clued_start(study, start, *effect);
                }
                attempt.lasting.push_back(known != nullptr ? *known
                                          : told.empty()   ? parameters_of(*effect, study.scales, s)
                                                           : std::move(told));
            }
        }
        for (std::size_t r = 0; r < study.courses.size(); ++r) {
            attempt.own.push_back(own_of(study, r, effects, start));
        }
        guess_events(study, attempt);
        begin_own(study, attempt);
        // A base that was fitted to readings which hide it leads nowhere near the form's own values, nor do its
        // records' states.
        if (study.base.refit && std::any_of(effects.begin(), effects.end(), [&](const Effect* effect) {
                return effect->hides_base && !start.has(effect->name);
            })) {
            Candidate afresh = attempt;
            afresh.base = base_of(study);
            for (std::size_t r = 0; r < afresh.own.size(); ++r) {
                std::ranges::copy(state_of(study, study.courses[r].record()), afresh.own[r].begin());
            }
            descend(study, afresh, true, whitener, effort.first_iterations);
            descend(study, afresh, false, whitener, in_stages ? effort.first_iterations : effort.iterations);
            attempts.push_back(std::move(afresh));
        }
        // What only shifts the operating point as long as no input lies within it cannot leave none by itself: the base
        // follows first, while it stays where it starts.
        if (study.base.refit && std::any_of(effects.begin(), effects.end(), [&](const Effect* effect) {
                return effect->leads_base && !start.has(effect->name);
            })) {
            Candidate led = attempt;
            hold_effects(led);
            descend(study, led, false, whitener, effort.first_iterations);
            led.lasting = attempt.lasting;
            descend(study, led, false, whitener, in_stages ? effort.first_iterations : effort.iterations);
            attempts.push_back(std::move(led));
        }
        for (std::optional<Candidate>& other :
             std::array{with_slope_kept(study, attempt, start), counted_from_zero(study, attempt, start)}) {
            if (other) {
                descend(study, *other, false, whitener, in_stages ? effort.first_iterations : effort.iterations);
                attempts.push_back(std::move(*other));
            }
        }
        // What bends a swing changes its period: alone, before the base may follow, it would only be driven back to
        // none.
        if (study.base.refit && study.scales.swings && !effects.empty()) {
            Candidate at_once = attempt;
            descend(study, at_once, false, whitener, in_stages ? effort.first_iterations : effort.iterations);
            attempts.push_back(std::move(at_once));
        }
        approach(study, attempt, whitener);
        descend(study, attempt, false, whitener, in_stages ? effort.first_iterations : effort.iterations);
        attempts.push_back(std::move(attempt));
    }
    if (in_stages) {
        std::ranges::stable_sort(attempts, {}, weighed_cost);
        attempts.resize(std::min(effort.keep, attempts.size()));
        const double worst = std::min(effort.hopeless, 2.0 * attempts.front().cost);
        for (Candidate& attempt : attempts) {
            if (attempt.cost < worst) {
                descend(study, attempt, false, whitener, effort.iterations);
            }
        }
    }
    Candidate& best = *std::ranges::min_element(attempts, {}, weighed_cost);
    take_first_records(best);
    if (study.base.refit && !effects.empty() && start.own.size() == study.courses.size()) {
        // Any effect may be absent: then it goes as far as what it was begun from.
        Candidate absent = without_new_effects(study, best, start);
        absent.cost = cost_of(study, absent, whitener);
        return absent.cost < best.cost ? absent : best;
    }
    return best;
}

Candidate carried_over(const Study& study, const Candidate& fitted, const Whitener* whitener) {
    Candidate carried = fitted;
    carried.own.clear();
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        carried.own.push_back(own_of(study, r, fitted.effects, {}));
    }
    if (study.base.refit && fitted.event_parameters() > 0) {
        // The state first: what an event is guessed from must not be an initial transient.
        Candidate resting = carried;
        descend(study, resting, true, whitener, 10);
        if (std::isfinite(resting.cost)) {
            for (std::size_t r = 0; r < carried.own.size(); ++r) {
                std::copy_n(resting.own[r].begin(), state_of(study, study.courses[r].record()).size(),
                            carried.own[r].begin());
            }
        }
    }
    guess_events(study, carried);
    begin_own(study, carried);
    descend(study, carried, true, whitener, 25);
    return carried;
}

}  // namespace gap
