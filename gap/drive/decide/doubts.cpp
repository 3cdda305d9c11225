// What speaks against an answer.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "gap/drive/decide/rule.hpp"
#include "gap/drive/outside.hpp"

namespace gap {
namespace {

void doubt_beside_a_form(const Evidence& evidence, Decision& decision) {
    if (!evidence.beside_form() || decision.effects.empty()) {
        return;
    }
    constexpr double an_event = 0.8;
    constexpr double nearly_nothing = 0.05;  // is left: that was its time and size
    const double after = evidence.gap(decision.chosen);
    const Foreseeable rest = foreseeable(evidence, decision);
    constexpr double most = 0.5;  // what can be foreseen is no noise, however little it is of all
    if (rest.is_too_much || rest.share > most || evidence.over_noise(after) > Evidence::most_sensors) {
        // The more is left the less sure it is, of what can be foreseen twice: a second cause, say.
        const double little = rest.share > most ? 0.05 : 0.1;
        constexpr double a_quarter = 0.25;
        const double left = after / decision.base_gap;
        decision.at_most(left < little ? 0.95 : left < a_quarter ? 0.8 : 0.7);
    }
    // So may what an answer as likely, or a model without physics, closes of the rest.
    constexpr double clearly_more = 1.5;
    constexpr double material = 0.04;
    constexpr double not_alone = 0.85;
    if (after > clearly_more * decision.noise_floor && after > material * decision.base_gap) {
        decision.at_most(not_alone);
    }
    if (evidence.ranking[decision.chosen].trained.has_events() && after > nearly_nothing * decision.base_gap) {
        decision.at_most(an_event);
    }
}

// An event is located where it is judged, so it goes a part of the way of whatever there is: one that is the cause
// leaves little. Empty: it does.
std::string follows_the_rest(const Evidence& evidence, const Decision& decision, std::size_t i) {
    constexpr double little = 0.17;
    const double left = evidence.gap(i) / decision.base_gap;
    const Candidate& trained = evidence.ranking[i].trained;
    return evidence.beside_form() && evidence.study.scales.driven && trained.has_events() && left > little
               ? fmt::format("{} leaves {:.0f} % of the gap, as what is located where it is judged does of any cause",
                             trained.name(), 100.0 * left)
               : "";
}

// What a drive does itself, record after record, is no event from outside: it is the alternative without one, if there
// is any, or something that is not listed.
void doubt_events(const Evidence& evidence, Decision& decision) {
    if (decision.effects.empty()) {
        return;
    }
    const auto doubt_of = [&](std::size_t i) {
        const std::string none_from_outside = doubt_of_events(evidence.study, evidence.ranking[i].trained,
                                                              evidence.validation, evidence.ranking[i].candidate);
        return none_from_outside.empty() ? follows_the_rest(evidence, decision, i)
                                         : none_from_outside + ": an event from outside does not";
    };
    std::string doubt = doubt_of(decision.chosen);
    const bool of_chosen = !doubt.empty();
    std::erase_if(decision.effects, [&](std::size_t i) {
        const bool events = evidence.ranking[i].trained.has_events();
        const std::string own = of_chosen || !events ? "" : doubt_of(i);
        doubt = doubt.empty() ? own : doubt;
        return !own.empty() || (of_chosen && events);
    });
    if (doubt.empty()) {
        return;
    }
    decision.at_most(0.7);
    if (decision.effects.empty()) {
        decision.outcome = Outcome::unknown;
        decision.notes.push_back(fmt::format("{}, and nothing else listed explains it", doubt));
        return;
    }
    decision.chosen = decision.effects.front();
    decision.outcome = decision.effects.size() == 1 ? Outcome::attributed : Outcome::ambiguous;
    decision.notes.push_back(doubt);
}

// What helps it as another base's lag would helps what is named, too: beside that it is asked which goes farther.
bool is_helped_as_far(const Evidence& evidence, const Candidate& chosen, const Ranked& other) {
    std::vector<const Effect*> wanted = chosen.effects;
    std::ranges::copy_if(other.trained.effects, std::back_inserter(wanted),
                         [](const Effect* effect) { return effect->linear_with != nullptr; });
    return wanted.size() > chosen.effects.size() && std::ranges::any_of(evidence.ranking, [&](const Ranked& ranked) {
               return ranked.score() >= other.score() && std::ranges::all_of(wanted, [&](const Effect* effect) {
                          return ranked.trained.has(effect->name);
                      });
           });
}

// What cannot be named, and has nothing of what is named, says that it is none of the two.
void doubt_what_is_outdone(const Evidence& evidence, Decision& decision) {
    const Ranked& chosen = evidence.ranking[decision.chosen];
    constexpr double most = 0.5;  // what can be foreseen is no noise either, however small
    if (!evidence.beside_form() || decision.effects.empty() ||
        !(evidence.is_no_noise(chosen.gap_after) || foreseeable(evidence, decision).share > most)) {
        return;
    }
    constexpr double of_what_is_left = 2.0 / 3.0;
    for (std::size_t i = 0; i < evidence.ranking.size(); ++i) {
        const Ranked& other = evidence.ranking[i];
        if (other.score() > chosen.score() + clear_advantage && other.gap_after < of_what_is_left * chosen.gap_after &&
            !goes_beyond(other.trained, chosen.trained) && !evidence.objection(i).empty() &&
            !is_helped_as_far(evidence, chosen.trained, other)) {
            decision.outcome = Outcome::unknown;
            decision.effects.clear();
            decision.at_most(0.7);
            decision.notes.push_back(fmt::format("{} would bring the gap to {:.4f}, without {}, but {}",
                                                 other.trained.name(), other.gap_after, chosen.trained.name(),
                                                 evidence.objection(i)));
            return;
        }
    }
}

void doubt_what_does_not_belong(const Evidence& evidence, Decision& decision) {
    constexpr double large = 0.6;
    constexpr double half = 0.5;
    if (decision.base_gap > large && evidence.gap(decision.chosen) > half) {
        decision.notes.emplace_back("no candidate explains even half of the output: do model and log belong together?");
        decision.refuse(0.3);
    }
}

void doubt_one_step(const Evidence& evidence, Decision& decision) {
    const auto& courses = evidence.study.courses;
    const bool moves = std::any_of(courses.begin(), courses.end(), [](const Course& course) {
        const auto& input = course.record().input;
        return std::any_of(input.begin(), input.end(), [&](double u) { return u != input.front(); });
    });
    if (!moves && evidence.study.scales.driven) {
        decision.notes.emplace_back(
            "the input never moves within the training records: all that is known is one step at their start");
        decision.at_most(0.5);
    }
}

void name_a_suspect(const Evidence& evidence, Decision& decision) {
    const std::size_t none = evidence.none();
    if (decision.outcome != Outcome::unknown) {
        return;
    }
    if (decision.chosen != none) {
        decision.suspect = decision.chosen;
        return;
    }
    constexpr double at_most = 0.95;  // of the base's gap
    for (std::size_t i = 0; i < evidence.ranking.size() && !decision.suspect; ++i) {
        if (i != none && evidence.gap(i) < at_most * evidence.gap(none) && evidence.objection(i).empty()) {
            decision.suspect = i;
        }
    }
}

}  // namespace

const Rule rule_of_fitted_forms{
    "fitted_forms",
    "Beside a fitted form what is left, if it is no noise, is a cause that is not named or the form's own misfit, and "
    "either may have bent what is named. Events, located where they are judged, explain what others do.",
    doubt_beside_a_form};

const Rule rule_of_events_from_outside{
    "events_from_outside",
    "What begins with the input, record after record, or lasts throughout is the drive's own, no event from outside.",
    doubt_events};

const Rule rule_of_what_is_outdone{
    "what_is_outdone",
    "Where something that cannot be named goes clearly farther, without what is named, these records hold another "
    "cause than that.",
    doubt_what_is_outdone};

const Rule rule_of_logs_of_another_drive{
    "logs_of_another_drive", "Where nothing explains half of the output, model and log may not belong together.",
    doubt_what_does_not_belong};

const Rule rule_of_inputs_that_never_move{"inputs_that_never_move",
                                          "One level tells no curve of the input from another.", doubt_one_step};

const Rule rule_of_suspects{
    "suspects", "Of an unknown the candidate that leads and whose numbers training tells is said.", name_a_suspect};

}  // namespace gap
