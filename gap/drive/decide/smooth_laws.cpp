// Two smooth laws that are none of the causes.
#include <fmt/format.h>

#include <algorithm>

#include "gap/drive/decide/rule.hpp"

namespace gap {
namespace {

// Whether more effects beside these go clearly farther, whatever is said against naming them.
bool is_outdone_with_more(const Evidence& evidence, std::size_t chosen) {
    constexpr double farther = 0.8;  // of what is left
    const Ranked& mine = evidence.ranking[chosen];
    return std::ranges::any_of(evidence.ranking, [&](const Ranked& other) {
        return other.trained.effects.size() > mine.trained.effects.size() && contains(other.trained, mine.trained) &&
               other.gap_after < farther * mine.gap_after && is_clear(advantage(other, mine));
    });
}

void doubt_smooth_laws(const Evidence& evidence, Decision& decision) {
    const Ranked& chosen = evidence.ranking[decision.chosen];
    const auto is_smooth = [](const Effect* effect) { return effect->smooth; };
    if (!evidence.beside_form() || decision.effects.empty() || chosen.trained.effects.size() != 2 ||
        !std::ranges::all_of(chosen.trained.effects, is_smooth)) {
        return;
    }
    // Of causes little is left, and that is noise.
    constexpr double little = 0.15;
    constexpr double a_third = 1.0 / 3.0;
    const double share = foreseeable(evidence, decision).share;
    if (chosen.gap_after > little * decision.base_gap &&
        (share > a_third || is_outdone_with_more(evidence, decision.chosen))) {
        decision.notes.push_back(
            fmt::format("{} leaves {:.0f} % of the gap, and that is no noise: two smooth laws, which "
                        "follow what is neither, too",
                        chosen.trained.name(), 100.0 * chosen.gap_after / decision.base_gap));
        decision.refuse(0.7);
    }
}

}  // namespace

const Rule rule_of_smooth_laws{
    "smooth_laws",
    "A curve of a command, of a spring or of a drag is the first term of a series. Two of them together follow much "
    "that is neither, a spring's hysteresis, say: where they leave what is no noise they are not named.",
    doubt_smooth_laws};

}  // namespace gap
