#include "gap/cycles/verdict.hpp"

#include <algorithm>

namespace gap::cycles {
namespace {

Cause cause_of(const Explanation& found, const Step& step) {
    const double most = found.base_gap - found.floor;
    Cause cause{step.effect,
                {},
                step.gap_before,
                step.gap_after,
                most > 0.0 ? (step.gap_before - step.gap_after) / most : 0.0,
                step.confidence};
    for (const auto& [name, value] : step.parameters) {
        cause.parameters.push_back({name, value});
        if (const auto range = step.interval.find(name); range != step.interval.end()) {
            cause.parameters.back().intervals = {{range->second.low, range->second.high}};
        }
    }
    return cause;
}

// What takes off most comes first.
std::vector<Rank> ranking_of(const Explanation& found) {
    std::vector<Rank> ranking;
    for (const auto* steps : {&found.steps, &found.alternatives}) {
        for (const Step& step : *steps) {
            ranking.push_back({step.effect, step.gap_after, step.gap_before - step.gap_after});
        }
    }
    std::stable_sort(ranking.begin(), ranking.end(), [](const Rank& a, const Rank& b) { return a.score > b.score; });
    return ranking;
}

}  // namespace

Verdict verdict_of(const Explanation& found, const std::string& base) {
    OfCycles of{base, found.reference, {}, {}, found.apart, found.where};
    for (const Step& step : found.steps) {
        of.steps.push_back(cause_of(found, step));
    }
    for (const Step& step : found.alternatives) {
        of.alternatives.push_back(cause_of(found, step));
    }
    return {
        found.outcome,
        {"sum of absolute differences over the sum of measured cycles", found.base_gap, found.after_gap, found.floor},
        ranking_of(found),
        std::move(of),
        found.next_experiment,
        found.notes};
}

}  // namespace gap::cycles
