// What is left, and whether that can be a sensor's noise.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "gap/drive/decide/rule.hpp"
#include "gap/drive/residuals/pattern.hpp"

namespace gap {
namespace {

double square(double value) { return value * value; }

void nothing_listed(Decision& decision, std::string_view what_is_left) {
    decision.refuse(0.7);
    decision.notes.push_back(
        fmt::format("what is left is {}: no noise of a sensor, and nothing listed explains it", what_is_left));
}

void look_for_more(const Evidence& evidence, Decision& decision) {
    const double after = evidence.gap(decision.chosen);
    const Foreseeable rest = foreseeable(evidence, decision);
    decision.noise_floor = std::min(rest.left, decision.noise_floor);
    if (rest.share > 0.0) {
        decision.notes.push_back(
            fmt::format("of the squared gap that is left, {:.0f} % can be foreseen from input and output by a model "
                        "without physics",
                        100.0 * rest.share));
    }
    constexpr double moved = 0.5;  // of the gap: worth a line
    if (const double level = std::sqrt(evidence.level_share(decision.chosen)) * after; level > moved * after) {
        decision.notes.push_back(fmt::format(
            "the level has moved by {:.4f} of the deviation since the base was fitted: the operating point's", level));
    }
    const bool none = decision.chosen == evidence.none();
    // Three effects that still leave what can be foreseen are an expansion of something else, not its causes. So are
    // two beside a fitted form that leave a quarter, most of which can be foreseen.
    constexpr double a_quarter = 0.25;
    constexpr double most = 0.5;
    const std::size_t effects = evidence.ranking[decision.chosen].trained.effects.size();
    const bool expansion = effects >= 3 || (effects == 2 && evidence.beside_form() &&
                                            after > a_quarter * decision.base_gap && rest.share > most);
    // A fitted form's own misfit: within so much of the rms, or small, it is none of the drive's effects.
    constexpr double misfit_share = 0.11;
    const bool misfit = evidence.beside_form() && none &&
                        (after - rest.left < misfit_share * after || evidence.is_small_of_a_form(after));
    const bool is_main = evidence.beside_form() && !none && !expansion && rest.is_minor();
    constexpr double material = 0.02;  // of the base's
    if (rest.share > 0.0 && !misfit && !is_main && (rest.is_too_much || expansion) &&
        after - rest.left > material * decision.base_gap) {
        decision.outcome = Outcome::unknown;
        decision.effects.clear();
        decision.confidence = std::clamp(0.5 + 0.5 * rest.of_closable, 0.5, 0.95);
    }
}

bool is_slow(const Evidence& evidence, const Decision& decision) {
    const double after = evidence.gap(decision.chosen);
    if (decision.outcome == Outcome::no_gap) {
        if (evidence.beside_form() && evidence.is_small_of_a_form(after)) {
            return false;
        }
        constexpr double small = 0.05;
        constexpr double ratio_of_small = 15.0;
        return evidence.over_noise(after) > (after > small ? Evidence::usual_ratio : ratio_of_small);
    }
    // A given model is the drive's but for what is looked for; a form that was fitted to it has a few coefficients, and
    // its own misfit stays. What was let go gathers it: of a period that is a little off the phase is more so each
    // time.
    constexpr double share_of_a_model = 0.1;
    constexpr double rest_of_free_motion = 0.4;
    const double rest = evidence.study.scales.driven ? rest_of_a_main_cause : rest_of_free_motion;
    const double share = evidence.beside_form() ? std::sqrt(rest) : share_of_a_model;
    if (!evidence.is_no_noise(after) || after < share * decision.base_gap) {
        return false;
    }
    // A cause whose size the training hardly tells may miss elsewhere; one that leaves much where it was fitted, too,
    // is not the only one. Events are fitted to each record. And beside a form what leaves half of the gap is not its
    // cause, whatever training tells.
    constexpr double much = 4.0;
    constexpr double half = 0.5;
    const Candidate& trained = evidence.ranking[decision.chosen].trained;
    return trained.has_events() || (evidence.beside_form() && after > half * decision.base_gap) ||
           over_noise(evidence.study, rms_of(evidence.study, all_residuals(evidence.study, trained))) > much;
}

// What the plant integrates grows without end, and in a loop, where predictions are judged, the output itself is what
// the loop leaves of disturbances. Else one of a quarter of all that the output does is more than noise: something acts
// on the plant that the model lacks.
bool is_small_for_a_disturbance(const Evidence& evidence, double gap) {
    constexpr double a_quarter = 0.25;
    const bool gathers = !evidence.study.scales.steady || evidence.study.horizon > 0;
    return gathers || gap < a_quarter;
}

// Noise that the plant filters is slow. What a cause makes follows the input, or something listed takes a part of it.
bool is_disturbance(const Evidence& evidence, const Decision& decision) {
    constexpr double a_part = 0.15;
    const double after = evidence.gap(decision.chosen);
    return decision.noise_floor > (1.0 - a_part) * after && is_small_for_a_disturbance(evidence, after) &&
           evidence.leaves_a_disturbance(decision.chosen);
}

void ask_for_noise(const Evidence& evidence, Decision& decision) {
    if (!is_slow(evidence, decision)) {
        return;
    }
    if (is_disturbance(evidence, decision)) {
        constexpr double sure = 0.7;
        decision.disturbed = true;
        decision.at_most(sure);
        decision.notes.push_back(
            fmt::format("what is left ({:.4f}) is slow, as large where it was fitted, and nothing of input or output "
                        "foresees it: a disturbance of the plant, no error of the model",
                        evidence.gap(decision.chosen)));
        return;
    }
    nothing_listed(decision, "slow and many times what differs from sample to sample");
}

std::string burst_of(const Evidence& evidence, const Decision& decision) {
    const Ranked& chosen = evidence.ranking[decision.chosen];
    const Study& validation = evidence.validation;
    // A fitted form's own misfit follows the input. These effects make noise uneven by nature: readings that are held,
    // clipped, rounded, or taken at other times, far off only where the output moves.
    const bool uneven = evidence.beside_form() || evidence.study.scales.held_share > 0.0 ||
                        std::any_of(chosen.trained.effects.begin(), chosen.trained.effects.end(),
                                    [](const Effect* effect) { return effect->uneven_noise; });
    constexpr double loud = 50.0;   // over the usual stretch
    constexpr double share = 0.04;  // of the base's gap that is left at least
    const double step = 0.29 * validation.scales.quantum;
    const double least = square(std::max(step, validation.least_deviation));
    for (std::size_t r = 0; r < chosen.residuals.size() && !uneven; ++r) {
        const Burst burst = loudest_burst(validation.courses[r].record(), chosen.residuals[r], validation.counts[r],
                                          0.5 * validation.scales.time_constant_s, least);
        if (burst.ratio > loud && chosen.gap_after > share * decision.base_gap) {
            return fmt::format("{:.0f} times as loud from {:.4g} s on as in the usual stretch", std::sqrt(burst.ratio),
                               burst.at_s);
        }
    }
    return "";
}

std::string wave_of(const Evidence& evidence, const Decision& decision) {
    constexpr double stands_out = 300.0;  // over its neighbours
    constexpr double share = 0.25;        // of what is left
    constexpr double of_input = 30.0;
    const Ranked& chosen = evidence.ranking[decision.chosen];
    // What was let go swings by itself: a simulation that lags behind leaves a wave.
    if (!evidence.study.scales.driven) {
        return "";
    }
    const Wave wave = clearest_wave(evidence.validation.courses.front().record(), chosen.residuals.front());
    const auto everywhere = [&](const Study& study, const std::vector<std::vector<double>>& residuals) {
        for (std::size_t r = 0; r < residuals.size(); ++r) {
            const Record& record = study.courses[r].record();
            const Wave left = wave_at(record, residuals[r], wave.hz);
            if (left.over_neighbours < stands_out || left.share < share ||
                wave_at(record, record.input, wave.hz).over_neighbours > of_input) {
                return false;
            }
        }
        return true;
    };
    const bool found = wave.over_neighbours > stands_out && everywhere(evidence.validation, chosen.residuals) &&
                       everywhere(evidence.study, all_residuals(evidence.study, chosen.trained));
    return found ? fmt::format(
                       "a wave of {:.3g} Hz, {:.0f} % of its squares, in every record, and the input has none "
                       "there",
                       wave.hz, 100.0 * wave.share)
                 : "";
}

void ask_for_patterns(const Evidence& evidence, Decision& decision) {
    if (decision.outcome == Outcome::unknown) {
        return;
    }
    std::string pattern = burst_of(evidence, decision);
    pattern = pattern.empty() ? wave_of(evidence, decision) : pattern;
    if (!pattern.empty()) {
        nothing_listed(decision, pattern);
    }
}

}  // namespace

Foreseeable foreseeable(const Evidence& evidence, const Decision& decision) {
    constexpr double least = 0.1;
    const double after = evidence.gap(decision.chosen);
    const Flexible& flexible = evidence.remainder(decision.chosen);
    Foreseeable rest;
    const double of_level = evidence.level_share(decision.chosen);
    rest.share = flexible.certain && flexible.explained > least ? (1.0 - of_level) * flexible.explained : 0.0;
    rest.left = after * std::sqrt(1.0 - rest.share);
    const double closable = square(decision.base_gap) - square(std::min(rest.left, decision.noise_floor));
    rest.of_closable = closable > 0.0 ? (square(after) - square(rest.left)) / closable : 0.0;
    // A form that is fitted has a misfit of its own.
    constexpr double tolerated_of_a_model = 0.025;
    constexpr double tolerated_of_a_form = 0.08;
    rest.is_too_much = rest.of_closable > (evidence.beside_form() ? tolerated_of_a_form : tolerated_of_a_model);
    return rest;
}

const Rule rule_of_what_can_be_foreseen{
    "what_can_be_foreseen",
    "Noise cannot be foreseen. Where a model without physics foresees a material part of what is left, something else "
    "is missing, unless the cause found takes nearly all that can be closed beside a fitted form.",
    look_for_more};

const Rule rule_of_what_is_no_noise{
    "what_is_no_noise",
    "What is left and differs little from sample to sample is no sensor's: much of it says that something unlisted is "
    "missing.",
    ask_for_noise};

const Rule rule_of_patterns{"patterns", "A burst, or a wave that the input has not, is no noise either, however small.",
                            ask_for_patterns};

}  // namespace gap
