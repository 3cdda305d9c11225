#include "bench/choose/would_do.hpp"

#include <fmt/format.h>

#include <optional>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/choose/reach.hpp"

namespace choose {
namespace {

namespace design = glsum::design;

std::string text_of(const design::Band& band) { return fmt::format("--band {:g}..{:g}", band.low_hz, band.high_hz); }

// Each of the kernels that meets the error, at the shortest length that does.
std::vector<Candidate> shortest_of(const design::DerivativeGoal& goal, const std::vector<std::string>& kernels,
                                   const Limits& limits) {
    DerivativeErrors errors(goal);
    std::vector<Candidate> candidates;
    for (const std::string& kernel : kernels) {
        const Reach found = reach_of(errors, kernel, errors.lengths(kernel).value(), limits.max_error);
        if (found.shortest) {
            candidates.push_back({kernel, *found.shortest, found.best, {}});
        }
    }
    return candidates;
}

std::optional<Candidate> cheapest(std::vector<Candidate> candidates, CostSource& costs, const Limits& limits) {
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
                                   CostSource& costs, const Limits& limits, unsigned jobs) {
    const auto lesser = lesser_goals(goal);
    std::vector<std::vector<Candidate>> candidates(lesser.size());
    {
        base::Progress progress("what would do", lesser.size());
        base::parallel_for(lesser.size(), jobs, [&](std::size_t i) {
            candidates[i] = shortest_of(lesser[i].second, kernels, limits);
            progress.advance();
        });
    }
    std::vector<WouldDo> found;
    for (std::size_t i = 0; i < lesser.size(); ++i) {
        if (const auto candidate = cheapest(candidates[i], costs, limits)) {
            found.push_back({lesser[i].first, lesser[i].second, *candidate});
        }
    }
    return found;
}

}  // namespace choose
