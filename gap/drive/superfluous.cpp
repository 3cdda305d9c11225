#include "gap/drive/superfluous.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "gap/drive/base/jointly.hpp"
#include "gap/drive/decide/evidence.hpp"

namespace gap {
namespace {

constexpr double nearly_as_far = 1.15;
constexpr double sure_of_the_others = 0.8;  // the one that went may have been a cause, and what is left its numbers

// The candidate without one of its effects; none: it was not tried, or cannot be named.
std::optional<std::size_t> place_without(const Evidence& evidence, std::size_t of, const Effect* effect) {
    std::vector<const Effect*> rest = evidence.ranking[of].trained.effects;
    std::erase(rest, effect);
    for (std::size_t i = 0; i < evidence.ranking.size(); ++i) {
        if (std::ranges::is_permutation(evidence.ranking[i].trained.effects, rest) && evidence.objection(i).empty()) {
            return i;
        }
    }
    return std::nullopt;
}

// Those that are left without one of the effects, of alternatives without what they differ by, the one that misses it
// least first. What a log shows by itself, readings that are rounded, held or clipped, stays.
std::vector<std::size_t> narrower(const Evidence& evidence, const Decision& decision) {
    std::vector<std::size_t> found;
    for (const Effect* effect : evidence.ranking[decision.chosen].trained.effects) {
        const auto place = effect->uneven_noise ? std::nullopt : place_without(evidence, decision.chosen, effect);
        if (place && std::ranges::all_of(decision.effects, [&](std::size_t alternative) {
                return contains(evidence.ranking[alternative].trained, evidence.ranking[*place].trained);
            })) {
            found.push_back(*place);
        }
    }
    std::ranges::sort(found, {}, [&](std::size_t i) { return evidence.gap(i); });
    return found;
}

}  // namespace

void drop_superfluous(const Question& question, const Ground& ground, const std::vector<Ranked>& ranking,
                      const Whitener& whitener, Decision& decision) {
    const Evidence evidence(ranking, whitener, ground.study, ground.validation, ground.same_records);
    for (bool further = true; question.find && further;) {
        further = false;
        if (decision.effects.empty() || ranking[decision.chosen].trained.effects.size() < 2) {
            return;
        }
        for (const std::size_t i : narrower(evidence, decision)) {
            const double jointly = joint_gap(question, ranking[i]);
            if (jointly > nearly_as_far * evidence.gap(decision.chosen)) {
                continue;
            }
            decision.notes.push_back(fmt::format(
                "fitted to the validation, too, {} leaves {:.4f}, as {} does: training alone does not tell its numbers",
                ranking[i].trained.name(), jointly, ranking[decision.chosen].trained.name()));
            decision.outcome = Outcome::attributed;
            decision.chosen = i;
            decision.effects = {i};
            decision.confidence = sure_of_the_others;
            further = true;
            break;
        }
    }
}

}  // namespace gap
