#include "bench/choose/would_do.hpp"

#include <fmt/format.h>

#include <optional>

#include "bench/choose/reach.hpp"

namespace choose {
namespace {

namespace design = glsum::design;

std::string text_of(const design::Band& band) { return fmt::format("--band {:g}..{:g}", band.low_hz, band.high_hz); }

// The cheapest of the kernels, each at the shortest length that meets the error.
std::optional<Candidate> cheapest(const design::DerivativeGoal& goal, const std::vector<std::string>& kernels,
                                  CostSource& costs, const Limits& limits) {
    DerivativeErrors errors(goal);
    std::vector<Candidate> candidates;
    for (const std::string& kernel : kernels) {
        const Reach found = reach_of(errors, kernel, errors.lengths(kernel).value(), limits.max_error);
        if (found.shortest) {
            candidates.push_back({kernel, *found.shortest, found.best, {}});
        }
    }
    std::vector<Candidate*> all;
    for (Candidate& candidate : candidates) {
        all.push_back(&candidate);
    }
    measure(costs, all);
    std::optional<Candidate> best;
    for (const Candidate& candidate : candidates) {
        if (fits(candidate, limits) && (!best || better(candidate, *best))) {
            best = candidate;
        }
    }
    return best;
}

}  // namespace

std::vector<std::pair<std::string, design::DerivativeGoal>> lesser_goals(const design::DerivativeGoal& goal) {
    std::vector<std::pair<std::string, design::DerivativeGoal>> goals;
    const auto add = [&](std::string text, const design::DerivativeGoal& lesser) {
        goals.emplace_back(std::move(text), lesser);
    };
    if (goal.band && goal.step_until_s) {
        design::DerivativeGoal band = goal;
        band.step_until_s.reset();
        add(text_of(*goal.band) + " alone", band);
        design::DerivativeGoal step = goal;
        step.band.reset();
        add(fmt::format("--step-until {:g} alone", *goal.step_until_s), step);
    }
    if (goal.band && goal.band->high_hz >= 2.0 * goal.band->low_hz) {
        design::DerivativeGoal lower = goal;
        lower.band->high_hz *= 0.5;
        add(text_of(*lower.band), lower);
    }
    design::DerivativeGoal faster = goal;
    faster.step_s *= 0.5;
    add(fmt::format("--step-s {:g}", faster.step_s), faster);
    return goals;
}

std::vector<WouldDo> what_would_do(const design::DerivativeGoal& goal, const std::vector<std::string>& kernels,
                                   CostSource& costs, const Limits& limits) {
    std::vector<WouldDo> found;
    for (const auto& [text, lesser] : lesser_goals(goal)) {
        if (const auto candidate = cheapest(lesser, kernels, costs, limits)) {
            found.push_back({text, lesser, *candidate});
        }
    }
    return found;
}

}  // namespace choose
