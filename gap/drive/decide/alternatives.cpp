// What these data cannot part.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "gap/drive/decide/rule.hpp"

namespace gap {
namespace {

// Below it two explanations are not told apart; twice that where some blocks of samples say the opposite.
constexpr double parting_advantage = 6.0;
constexpr std::size_t most_alternatives = 3;
constexpr double of_alternatives = 0.9;  // what their confidences add up to

bool is_special_case(const Effect& effect, const Candidate& of) {
    return std::any_of(of.effects.begin(), of.effects.end(), [&](const Effect* mine) { return mine->covers(effect); });
}

// Whether one of the effects is only that one, with the numbers that it has.
bool is_only(const Effect& effect, const Candidate& candidate) {
    return std::ranges::any_of(candidate.effects, [&](const Effect* mine) {
        const std::optional<Special> only = candidate.only(mine);
        return only && only->effect == effect.name;
    });
}

bool generalises(const Candidate& general, const Candidate& special) {
    if (general.effects.size() != special.effects.size()) {
        return false;
    }
    // Where the data hold a number of the wider one fast, it is not wider.
    const bool has_more = general.effect_parameters() > special.effect_parameters();
    bool more = false;
    for (const Effect* effect : special.effects) {
        const bool same = general.has(effect->name);
        const bool wider = (has_more && is_special_case(*effect, general)) || is_only(*effect, general);
        if (!same && !wider) {
            return false;
        }
        more = more || wider;
    }
    return more;
}

// Beside a fitted form whose best candidate leaves more than noise all of them miss something: the likelihoods of
// misfits tell nothing, and what goes about as far is as near to the truth. So it is from four times what differs from
// sample to sample on, which is more than the noise of most sensors, if not of all. Where noise is left a likelihood
// tells, but a law that is not quite the drive's own loses some units of it: two that leave the same are not told
// apart.
bool goes_as_far(const Evidence& evidence, std::size_t i, std::size_t chosen) {
    constexpr double of_a_misfit = 1.2;
    constexpr double of_noise = 1.05;
    constexpr double of_the_way = 0.5;
    const double after = evidence.gap(chosen);
    const double theirs = evidence.gap(i);
    const double about = evidence.over_noise(after) > Evidence::most_sensors ? of_a_misfit : of_noise;
    return evidence.beside_form() && theirs < about * after &&
           theirs < after + of_the_way * (evidence.gap(evidence.none()) - after);
}

// Whether two sets are the same but for one effect of each, of which that holds.
template <class Holds>
bool differ_by_a_pair(const Candidate& one, const Candidate& other, const Holds& holds) {
    const auto without = [](std::vector<const Effect*> all, const Effect* left_out) {
        std::erase(all, left_out);
        return all;
    };
    return std::ranges::any_of(one.effects, [&](const Effect* mine) {
        return std::ranges::any_of(other.effects, [&](const Effect* theirs) {
            return mine != theirs && holds(*mine, *theirs) &&
                   std::ranges::is_permutation(without(one.effects, mine), without(other.effects, theirs));
        });
    });
}

// Whether one has another effect in the place of one of the other's that does the same as long as all moves slowly: a
// play of the input, and friction against a spring. What parts them is how quickly the plant is, which a fitted form
// that leaves more than noise has not in full.
bool looks_alike(const Evidence& evidence, std::size_t i, std::size_t chosen) {
    constexpr double about = 2.0;
    return evidence.beside_form() && evidence.is_no_noise(evidence.gap(chosen)) &&
           evidence.gap(i) < about * evidence.gap(chosen) &&
           differ_by_a_pair(evidence.ranking[chosen].trained, evidence.ranking[i].trained,
                            [](const Effect& mine, const Effect& theirs) { return mine.resembles(theirs); });
}

// Whether one has another curve in the place of one of the other's. A curve is the first term of a series, and the
// drive's own has more of them: of bends on both sides of a fitted lag the right one leaves a quarter of the other, or
// less, and what leaves a third may as well be the wrong one.
bool is_another_curve(const Evidence& evidence, std::size_t i, std::size_t chosen) {
    constexpr double about = 3.0;
    constexpr double of_the_way = 0.5;
    const double after = evidence.gap(chosen);
    return evidence.beside_form() && evidence.gap(i) < about * after &&
           evidence.gap(i) < after + of_the_way * (evidence.gap(evidence.none()) - after) &&
           differ_by_a_pair(evidence.ranking[chosen].trained, evidence.ranking[i].trained,
                            [](const Effect& mine, const Effect& theirs) { return mine.smooth && theirs.smooth; });
}

// In [0.5, 0.97], by how far the nearest rival is.
double confidence_by(double advantage) { return 0.5 + 0.47 * (1.0 - std::exp(-std::max(0.0, advantage) / 8.0)); }

bool is_near(const Evidence& evidence, std::size_t chosen, std::size_t i, const Interval& over) {
    return over.mean < parting_advantage || (over.low < 0.0 && over.mean < 2.0 * parting_advantage) ||
           goes_as_far(evidence, i, chosen) || looks_alike(evidence, i, chosen) ||
           is_another_curve(evidence, i, chosen);
}

// Beside a fitted form a wider candidate follows a part of the misfit with its further number: a tenth of what is left
// is none of the drive's.
bool says_as_much(const Evidence& evidence, std::size_t special, std::size_t chosen) {
    constexpr double as_much = 1.1;
    return is_near(evidence, chosen, special, advantage(evidence.ranking[chosen], evidence.ranking[special])) ||
           (evidence.beside_form() && evidence.gap(special) < as_much * evidence.gap(chosen));
}

// The first special case of a candidate that says as much and may be named, or that may not.
std::optional<std::size_t> special_case(const Evidence& evidence, std::size_t chosen, bool may_be_named) {
    for (std::size_t i = 0; i < evidence.ranking.size(); ++i) {
        if (generalises(evidence.ranking[chosen].trained, evidence.ranking[i].trained) &&
            evidence.objection(i).empty() == may_be_named && says_as_much(evidence, i, chosen)) {
            return i;
        }
    }
    return std::nullopt;
}

// The special case that shows that a candidate's event is none: an event that cannot be named beside the simpler law is
// none beside the wider one either, which has a number more to make room for it.
std::optional<std::size_t> shows_no_event(const Evidence& evidence, std::size_t chosen) {
    const auto simpler = special_case(evidence, chosen, false);
    return evidence.beside_form() && simpler && evidence.ranking[*simpler].trained.has_events() ? simpler
                                                                                                : std::nullopt;
}

void refuse_for(const Evidence& evidence, std::size_t simpler, Decision& decision) {
    decision.notes.push_back(fmt::format("{} says as much as {}, but {}", evidence.ranking[simpler].trained.name(),
                                         evidence.ranking[decision.chosen].trained.name(),
                                         evidence.objection(simpler)));
    decision.chosen = simpler;
    decision.refuse(0.7);
}

void part(const Evidence& evidence, Decision& decision) {
    if (decision.outcome != Outcome::attributed) {
        return;
    }
    if (const auto simpler = special_case(evidence, decision.chosen, true)) {
        decision.chosen = *simpler;
    } else if (const auto without_event = shows_no_event(evidence, decision.chosen)) {
        refuse_for(evidence, *without_event, decision);
        return;
    }
    const std::size_t chosen = decision.chosen;
    decision.effects = {chosen};
    const Candidate& mine = evidence.ranking[chosen].trained;
    double nearest = advantage(evidence.ranking[chosen], evidence.ranking[evidence.none()]).mean;
    for (std::size_t i = 0; i < evidence.ranking.size(); ++i) {
        const Candidate& other = evidence.ranking[i].trained;
        if (i == chosen || other.effects.size() != mine.effects.size()) {
            continue;
        }
        // What is wider says as much with more numbers. Where the base takes up what they differ by (a force in one
        // direction, as an operating point), it is as near to the truth.
        const bool wider = generalises(other, mine);
        if (wider && !(evidence.beside_form() && evidence.is_open(i))) {
            continue;
        }
        const Interval over = advantage(evidence.ranking[chosen], evidence.ranking[i]);
        if (!is_near(evidence, chosen, i, over)) {
            nearest = std::min(nearest, over.mean);
        } else if (wider) {
            decision.effects.push_back(i);
        } else if (!evidence.objection(i).empty()) {
            continue;
        } else if (evidence.beside_form() && other.has_events() && !mine.has_events()) {
            // An event is located where it is judged; what kept its numbers and goes as far says more.
            nearest = std::min(nearest, parting_advantage);
        } else {
            decision.effects.push_back(i);
        }
    }
    if (decision.effects.size() == 1) {
        decision.confidence = confidence_by(nearest);
        return;
    }
    decision.outcome = Outcome::ambiguous;
    decision.confidence = of_alternatives / static_cast<double>(std::min<std::size_t>(decision.effects.size(), 6));
}

void keep_few(const Evidence& evidence, Decision& decision) {
    if (decision.effects.size() <= most_alternatives) {
        return;
    }
    if (evidence.beside_form()) {
        std::string names;
        for (const std::size_t i : decision.effects) {
            names += (names.empty() ? "" : ", ") + evidence.ranking[i].trained.name();
        }
        decision.notes.push_back(
            fmt::format("{} causes explain these records equally well: {}", decision.effects.size(), names));
        constexpr std::size_t too_many = 6;
        if (decision.effects.size() >= too_many) {
            decision.refuse(0.7);
            return;
        }
        std::stable_sort(decision.effects.begin(), decision.effects.end(),
                         [&](std::size_t a, std::size_t b) { return evidence.gap(a) < evidence.gap(b); });
        decision.chosen = decision.effects.front();
    } else {
        // What others equal here, a gain that is wrong, say, is their special case, and is kept.
        const auto gain = std::find_if(decision.effects.begin(), decision.effects.end(), [&](std::size_t i) {
            return std::any_of(decision.effects.begin(), decision.effects.end(), [&](std::size_t other) {
                return is_special_case(*evidence.ranking[i].trained.effects.front(), evidence.ranking[other].trained);
            });
        });
        if (gain != decision.effects.end() &&
            gain - decision.effects.begin() >= static_cast<std::ptrdiff_t>(most_alternatives)) {
            std::iter_swap(gain, decision.effects.begin() + most_alternatives - 1);
        }
    }
    decision.effects.resize(most_alternatives);
    decision.confidence = of_alternatives / static_cast<double>(most_alternatives);
}

}  // namespace

const Rule rule_of_what_cannot_be_parted{
    "what_cannot_be_parted",
    "Others of as many effects that these records do not tell from the chosen one are alternatives. Of two that say as "
    "much the simpler one is named. How sure a single one is depends on its nearest rival.",
    part};

const Rule rule_of_few_alternatives{
    "few_alternatives", "More than three say nothing: of somewhat more the best three are named, of many none.",
    keep_few};

}  // namespace gap
