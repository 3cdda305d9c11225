#include "gap/drive/decide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "gap/drive/determined.hpp"
#include "gap/drive/outside.hpp"
#include "gap/flexible.hpp"
#include "gap/pattern.hpp"

namespace gap {
namespace {

// A likelihood ratio that chance does not reach among some hundred candidates.
constexpr double clear_advantage = 8.0;
// Below it two explanations are not told apart.
constexpr double parting_advantage = 6.0;
// An effect takes at least so much of the gap: a twentieth of the base's rms; a further one of what can be closed.
constexpr double material_share = 0.04;
// More than so much of the closable squared gap left, and foreseeable: something else is missing.
constexpr double unexplained_share = 0.025;
constexpr double unexplained_share_of_a_form = 0.08;
// More than so much of the gap left, and slow. A given model is the drive's but for what is looked for; a form that was
// fitted to it has a few coefficients, and its own misfit stays.
constexpr double slow_share = 0.1;
constexpr double slow_share_of_a_form = 0.5;
// A fitted form's own misfit: within so much of the rms, or half the noise, it is none of the drive's effects.
constexpr double misfit_share = 0.11;
// Beside a fitted form a first effect takes so much of the gap's rms: less is another form's share.
constexpr double first_share_of_a_form = 0.25;
// What takes so much of the closable squared gap of a fitted form is its cause, though the rest can be foreseen: of
// something else, which is said in per cent.
constexpr double main_share = 0.8;
// A burst so many times louder than what is usual, of a gap of which at least so much is left.
constexpr double burst_ratio = 50.0;
constexpr double burst_share = 0.04;
// A wave that stands out so far in every record, holds so much of what is left there, and is none of the input's.
constexpr double wave_ratio = 300.0;
constexpr double wave_share = 0.25;
constexpr double wave_of_input = 30.0;
// What is left over what differs from sample to sample: sensors' noise is seldom so coloured.
constexpr double usual_ratio = 7.0;
constexpr std::size_t most_effects = 4;
// More alternatives than this say nothing.
constexpr std::size_t most_alternatives = 3;

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

// What a model without physics still takes off the residuals of the validation records.
Flexible remainder_of(const Ranked& ranked, const Study& study, const Study& validation, bool same_records) {
    const drive::Model model = model_of(study.base.form);
    std::vector<Remainder> also;
    if (!same_records) {
        also = remainders(study, all_residuals(study, ranked.trained));
    }
    return explain(remainders(validation, ranked.residuals), also, model.delay_s, study.scales.time_constant_s);
}

bool generalises(const Candidate& general, const Candidate& special) {
    // Where the data hold a number of the wider one fast, it is not wider.
    if (general.effects.size() != special.effects.size() ||
        general.effect_parameters() <= special.effect_parameters()) {
        return false;
    }
    bool more = false;
    for (const Effect* effect : special.effects) {
        const bool same = general.has(effect->name);
        const bool wider = std::any_of(general.effects.begin(), general.effects.end(), [&](const Effect* mine) {
            return std::find(mine->generalises.begin(), mine->generalises.end(), effect->name) !=
                   mine->generalises.end();
        });
        if (!same && !wider) {
            return false;
        }
        more = more || wider;
    }
    return more;
}

bool is_clear(const Interval& over) { return over.mean > clear_advantage && over.low > 0.0; }

// In [0.5, 0.97], by how far the nearest rival is.
double confidence_by(double advantage) { return 0.5 + 0.47 * (1.0 - std::exp(-std::max(0.0, advantage) / 8.0)); }

class Deciding {
public:
    Deciding(const std::vector<Ranked>& ranking, const Whitener& whitener, const Study& study, const Study& validation,
             bool same_records)
        : ranking_(ranking), whitener_(whitener), study_(study), validation_(validation), same_records_(same_records) {}

    Decision decide() {
        const std::size_t none = *best_of(0);
        decision_.base_gap = ranking_[none].gap_after;
        std::size_t chosen = none;
        double least = decision_.base_gap;
        for (const Ranked& ranked : ranking_) {
            // Of those that are as likely as any: others may follow noise.
            if (ranked.score() > ranking_.front().score() - clear_advantage) {
                least = std::min(least, ranked.gap_after);
            }
        }
        for (std::size_t size = 1; size <= most_effects; ++size) {
            const auto wider = best_of(size);
            // The best with one effect less may have been too small a step to be taken; it must be beaten all the same.
            if (const auto narrower = best_of(size - 1);
                wider && is_better(*wider, chosen, least) &&
                (!narrower || is_clear(advantage(ranking_[*wider], ranking_[*narrower])))) {
                chosen = *wider;
            }
        }
        decision_.chosen = chosen;
        const Flexible flexible = remainder_of(ranking_[chosen], study_, validation_, same_records_);
        const double after = ranking_[chosen].gap_after;
        const bool foreseeable = flexible.certain && flexible.explained > 0.1;
        const double left = foreseeable ? after * std::sqrt(1.0 - flexible.explained) : after;
        decision_.noise_floor = std::min(left, least);
        const double closable = square(decision_.base_gap) - square(decision_.noise_floor);
        const double unexplained = closable > 0.0 ? (square(after) - square(left)) / closable : 0.0;
        if (foreseeable) {
            decision_.notes.push_back(fmt::format(
                "of the squared gap that is left, {:.0f} % can be foreseen from input and output by a model "
                "without physics",
                100.0 * flexible.explained));
        }
        const double tolerated = study_.base.refit ? unexplained_share_of_a_form : unexplained_share;
        // Three effects that still leave what can be foreseen are an expansion of something else, not its causes.
        const bool expansion = ranking_[chosen].trained.effects.size() >= 3;
        const bool misfit = study_.base.refit && chosen == none && after - left < misfit_share * after;
        const bool is_main = study_.base.refit && chosen != none && !expansion && 1.0 - unexplained > main_share;
        if (foreseeable && !misfit && !is_main && (unexplained > tolerated || expansion) &&
            after - left > 0.02 * decision_.base_gap) {
            decision_.outcome = Outcome::unknown;
            decision_.confidence = std::clamp(0.5 + 0.5 * unexplained, 0.5, 0.95);
        } else if (chosen == none) {
            decision_.outcome = Outcome::no_gap;
            // How near the best effect came to being named.
            const auto best = best_of(1);
            const double near = best ? std::max(0.0, advantage(ranking_[*best], ranking_[none]).mean) : 0.0;
            decision_.confidence = 0.95 - 0.3 * std::min(1.0, near / clear_advantage);
        } else {
            attribute(chosen, none);
            if (study_.base.refit) {
                doubt_beside_a_form(is_main && unexplained > tolerated);
            }
        }
        if (decision_.outcome == Outcome::no_gap) {
            name_the_quantum(after);
        }
        if (is_no_noise(after)) {
            nothing_listed("slow and many times what differs from sample to sample");
        } else if (const std::string pattern = pattern_of_what_is_left(after); !pattern.empty()) {
            nothing_listed(pattern);
        }
        doubt_events();
        limit_alternatives();
        doubt_what_does_not_belong(after);
        name_a_suspect(none);
        return decision_;
    }

private:
    static double square(double value) { return value * value; }

    // Of those whose numbers training tells.
    [[nodiscard]] std::optional<std::size_t> best_of(std::size_t size) const {
        for (std::size_t i = 0; i < ranking_.size(); ++i) {
            if (ranking_[i].trained.effects.size() == size && objection(i).empty()) {
                return i;
            }
        }
        return std::nullopt;
    }

    // Beside a fitted form what is left, if it is no noise, is a cause that is not named or the form's own misfit, and
    // either may have bent what is named. Events, located where they are judged, explain what others do.
    void doubt_beside_a_form(bool foreseeable) {
        constexpr double not_all = 0.75;
        constexpr double an_event = 0.8;
        const Ranked& named = ranking_[decision_.chosen];
        const bool no_noise = over_noise(validation_, named.gap_after * output_deviation(validation_)) > usual_ratio;
        if (foreseeable || no_noise) {
            decision_.confidence = std::min(decision_.confidence, not_all);
        }
        if (has_events(named.trained)) {
            decision_.confidence = std::min(decision_.confidence, an_event);
        }
    }

    // Why a candidate cannot be named, whatever its likelihood: training leaves it open, or every record needs an event
    // of its own, which none from outside would be. Empty: it can.
    [[nodiscard]] const std::string& objection(std::size_t i) const {
        const auto known = objections_.find(i);
        if (known != objections_.end()) {
            return known->second;
        }
        std::string what;
        if (!ranking_[i].trained.effects.empty()) {
            Candidate trained = ranking_[i].trained;
            add_intervals(study_, trained, study_.base.refit ? nullptr : &whitener_);
            what = untold_of(study_, trained);
            if (what.empty() && study_.base.refit && has_events(trained)) {
                what = objection_to_events(trained, ranking_[i].candidate);
            }
        }
        return objections_.emplace(i, std::move(what)).first->second;
    }

    // Of events beside a fitted form. \param trained  with its intervals
    [[nodiscard]] std::string objection_to_events(const Candidate& trained, Candidate judged) const {
        add_intervals(validation_, judged, nullptr);
        for (const Effect* effect : trained.effects) {
            if (effect->kind != Kind::event) {
                continue;
            }
            const auto needs = [&](const Study& study, const Candidate& candidate) {
                return std::count_if(candidate.own.begin(), candidate.own.end(),
                                     [&](const auto& own) { return needs_event(study, own, *effect); });
            };
            const auto fitted = needs(study_, trained);
            const auto validated = needs(validation_, judged);
            if (validated == 0) {
                return fmt::format("validation does not tell {} from none", effect->name);
            }
            if (!same_records_ &&
                fitted + validated == static_cast<std::ptrdiff_t>(trained.own.size() + judged.own.size())) {
                return fmt::format("every record needs a {} of its own", effect->name);
            }
        }
        return "";
    }

    // Three at most. Beside a given model any effect that equals a gain change is the gain's alternative, which is
    // kept.
    void limit_alternatives() {
        if (decision_.effects.size() <= most_alternatives) {
            return;
        }
        if (study_.base.refit) {
            std::string names;
            for (const std::size_t i : decision_.effects) {
                names += (names.empty() ? "" : ", ") + ranking_[i].trained.name();
            }
            decision_.notes.push_back(
                fmt::format("{} causes explain these records equally well: {}", decision_.effects.size(), names));
            decision_.outcome = Outcome::unknown;
            decision_.effects.clear();
            decision_.confidence = std::min(decision_.confidence, 0.7);
            return;
        }
        const auto gain = std::find_if(decision_.effects.begin(), decision_.effects.end(),
                                       [&](std::size_t i) { return ranking_[i].trained.name() == "gain_error"; });
        if (gain != decision_.effects.end() &&
            gain - decision_.effects.begin() >= static_cast<std::ptrdiff_t>(most_alternatives)) {
            std::iter_swap(gain, decision_.effects.begin() + most_alternatives - 1);
        }
        decision_.effects.resize(most_alternatives);
        decision_.confidence = 0.9 / static_cast<double>(most_alternatives);
    }

    // The leading candidate whose numbers training tells, where nothing is named.
    void name_a_suspect(std::size_t none) {
        if (decision_.outcome != Outcome::unknown) {
            return;
        }
        if (decision_.chosen != none) {
            decision_.suspect = decision_.chosen;
            return;
        }
        for (std::size_t i = 0; i < ranking_.size() && !decision_.suspect; ++i) {
            constexpr double at_least = 0.95;
            if (i != none && ranking_[i].gap_after < at_least * ranking_[none].gap_after && objection(i).empty()) {
                decision_.suspect = i;
            }
        }
    }

    [[nodiscard]] bool is_better(std::size_t wider, std::size_t chosen, double least) const {
        const double before = ranking_[chosen].gap_after;
        const double after = ranking_[wider].gap_after;
        // Beside a gap as large as the output itself, a second effect may be small and still take most of what is left.
        // A third that is small makes up for what the first two are not quite.
        const std::size_t so_far = ranking_[chosen].trained.effects.size();
        const double of_closable = material_share * (decision_.base_gap - least);
        const double material = so_far == 0   ? (study_.base.refit ? first_share_of_a_form : 0.03) * before
                                : so_far == 1 ? std::min(of_closable, 0.25 * before)
                                              : of_closable;
        return is_clear(advantage(ranking_[wider], ranking_[chosen])) && before - after > material;
    }

    // The chosen one, and those that these data cannot part from it.
    void attribute(std::size_t chosen, std::size_t none) {
        decision_.effects.push_back(chosen);
        double nearest = advantage(ranking_[chosen], ranking_[none]).mean;
        for (std::size_t i = 0; i < ranking_.size(); ++i) {
            const Candidate& other = ranking_[i].trained;
            if (i == chosen || other.effects.size() != ranking_[chosen].trained.effects.size() ||
                generalises(other, ranking_[chosen].trained)) {
                continue;
            }
            const Interval over = advantage(ranking_[chosen], ranking_[i]);
            const bool near = over.mean < parting_advantage || (over.low < 0.0 && over.mean < 2.0 * parting_advantage);
            if (near && !objection(i).empty()) {
                continue;
            }
            // An event is located where it is judged; what kept its numbers and goes as far says more.
            if (near && study_.base.refit && has_events(other) && !has_events(ranking_[chosen].trained)) {
                nearest = std::min(nearest, parting_advantage);
                continue;
            }
            if (near) {
                if (generalises(ranking_[chosen].trained, other) && decision_.effects.front() == chosen) {
                    decision_.effects.front() = decision_.chosen = i;  // the simpler one says as much
                } else {
                    decision_.effects.push_back(i);
                }
            } else {
                nearest = std::min(nearest, over.mean);
            }
        }
        const bool alone = decision_.effects.size() == 1;
        decision_.outcome = alone ? Outcome::attributed : Outcome::ambiguous;
        decision_.confidence = alone ? confidence_by(nearest)
                                     : 0.9 / static_cast<double>(std::min<std::size_t>(decision_.effects.size(), 6));
    }

    // Whether what is left can be no sensor's, so that something is missing whatever was found beside it.
    [[nodiscard]] bool is_no_noise(double after) const {
        const double ratio = over_noise(validation_, after * output_deviation(validation_));
        if (decision_.outcome == Outcome::no_gap) {
            return ratio > (after > 0.05 ? usual_ratio : 15.0);
        }
        const double share = study_.base.refit ? slow_share_of_a_form : slow_share;
        if (ratio < usual_ratio || after < share * decision_.base_gap) {
            return false;
        }
        // A cause whose size the training hardly tells may miss elsewhere; one that leaves much where it was fitted,
        // too, is not the only one. Events are fitted to each record.
        const Candidate& trained = ranking_[decision_.chosen].trained;
        return has_events(trained) || over_noise(study_, rms_of(study_, all_residuals(study_, trained))) > 4.0;
    }

    void nothing_listed(std::string_view what_is_left) {
        decision_.outcome = Outcome::unknown;
        decision_.effects.clear();
        decision_.confidence = std::min(decision_.confidence, 0.7);
        decision_.notes.push_back(
            fmt::format("what is left is {}: no noise of a sensor, and nothing listed explains it", what_is_left));
    }

    // What a drive does itself, record after record, is no event from outside: it is the alternative without one, if
    // there is any, or something that is not listed.
    void doubt_events() {
        std::string doubt = doubt_of(decision_.chosen);
        const bool of_chosen = !doubt.empty();
        std::erase_if(decision_.effects, [&](std::size_t i) {
            const std::string own = of_chosen || !has_events(ranking_[i].trained) ? "" : doubt_of(i);
            doubt = doubt.empty() ? own : doubt;
            return !own.empty() || (of_chosen && has_events(ranking_[i].trained));
        });
        if (doubt.empty()) {
            return;
        }
        decision_.confidence = std::min(decision_.confidence, 0.7);
        if (decision_.effects.empty()) {
            decision_.outcome = Outcome::unknown;
            decision_.notes.push_back(
                fmt::format("{}: an event from outside does not, and nothing else listed explains it", doubt));
            return;
        }
        decision_.chosen = decision_.effects.front();
        decision_.outcome = decision_.effects.size() == 1 ? Outcome::attributed : Outcome::ambiguous;
        decision_.notes.push_back(fmt::format("{}: an event from outside does not", doubt));
    }

    // What speaks against an alternative's events; empty: nothing, or there is none to name.
    [[nodiscard]] std::string doubt_of(std::size_t i) const {
        return decision_.effects.empty()
                   ? ""
                   : doubt_of_events(study_, ranking_[i].trained, validation_, ranking_[i].candidate);
    }

    static bool has_events(const Candidate& candidate) {
        return std::any_of(candidate.effects.begin(), candidate.effects.end(),
                           [](const Effect* effect) { return effect->kind == Kind::event; });
    }

    // A burst or a wave that stands out; empty: neither.
    [[nodiscard]] std::string pattern_of_what_is_left(double after) const {
        const Ranked& chosen = ranking_[decision_.chosen];
        // A fitted form's own misfit follows the input. These effects make noise uneven by nature: readings that are
        // held, clipped, rounded, or taken at other times, far off only where the output moves.
        const bool uneven = study_.base.refit || study_.scales.held_share > 0.0 ||
                            chosen.trained.has("sampling_jitter") || chosen.trained.has("encoder_quantisation") ||
                            chosen.trained.has("dropped_samples") || chosen.trained.has("sensor_saturation");
        const double step = 0.29 * validation_.scales.quantum;
        const double least = square(std::max(step, validation_.least_deviation));
        for (std::size_t r = 0; r < chosen.residuals.size() && !uneven; ++r) {
            const Burst burst = loudest_burst(validation_.courses[r].record(), chosen.residuals[r],
                                              validation_.counts[r], 0.5 * validation_.scales.time_constant_s, least);
            if (burst.ratio > burst_ratio && after > burst_share * decision_.base_gap) {
                return fmt::format("{:.0f} times as loud from {:.4g} s on as in the usual stretch",
                                   std::sqrt(burst.ratio), burst.at_s);
            }
        }
        return wave_of_what_is_left(chosen);
    }

    [[nodiscard]] std::string wave_of_what_is_left(const Ranked& chosen) const {
        const Wave wave = clearest_wave(validation_.courses.front().record(), chosen.residuals.front());
        const auto everywhere = [&](const Study& study, const std::vector<std::vector<double>>& residuals) {
            for (std::size_t r = 0; r < residuals.size(); ++r) {
                const Record& record = study.courses[r].record();
                const Wave left = wave_at(record, residuals[r], wave.hz);
                if (left.over_neighbours < wave_ratio || left.share < wave_share ||
                    wave_at(record, record.input, wave.hz).over_neighbours > wave_of_input) {
                    return false;
                }
            }
            return true;
        };
        const bool found = wave.over_neighbours > wave_ratio && everywhere(validation_, chosen.residuals) &&
                           everywhere(study_, all_residuals(study_, chosen.trained));
        return found ? fmt::format(
                           "a wave of {:.3g} Hz, {:.0f} % of its squares, in every record, and "
                           "the input has none there",
                           wave.hz, 100.0 * wave.share)
                     : "";
    }

    // That readings are multiples of a step is a fact of the log; here it is also most of what is left.
    void name_the_quantum(double after) {
        const double step = study_.scales.quantum / output_deviation(validation_);
        const auto candidate = std::find_if(ranking_.begin(), ranking_.end(), [](const Ranked& ranked) {
            return ranked.trained.name() == "encoder_quantisation";
        });
        if (candidate == ranking_.end() || step * step / 12.0 < 0.5 * square(after)) {
            return;
        }
        decision_.chosen = static_cast<std::size_t>(candidate - ranking_.begin());
        decision_.effects = {decision_.chosen};
        decision_.outcome = Outcome::attributed;
        decision_.noise_floor = std::min(decision_.noise_floor, candidate->gap_after);
        decision_.confidence = 0.9;
    }

    void doubt_what_does_not_belong(double after) {
        if (decision_.base_gap > 0.6 && after > 0.5) {
            decision_.notes.emplace_back(
                "no candidate explains even half of the output: do model and log belong together?");
            decision_.outcome = Outcome::unknown;
            decision_.effects.clear();
            decision_.confidence = std::min(decision_.confidence, 0.3);
        }
        const bool moves = std::any_of(study_.courses.begin(), study_.courses.end(), [](const Course& course) {
            const auto& input = course.record().input;
            return std::any_of(input.begin(), input.end(), [&](double u) { return u != input.front(); });
        });
        if (!moves && study_.scales.driven) {
            decision_.notes.emplace_back(
                "the input never moves within the training records: all that is known is one step at "
                "their start");
            decision_.confidence = std::min(decision_.confidence, 0.5);
        }
    }

    const std::vector<Ranked>& ranking_;
    const Whitener& whitener_;
    mutable std::map<std::size_t, std::string> objections_;
    const Study& study_;
    const Study& validation_;
    bool same_records_;
    Decision decision_;
};

}  // namespace

Decision decide(const std::vector<Ranked>& ranking, const Whitener& whitener, const Study& study,
                const Study& validation, bool same_records) {
    return Deciding(ranking, whitener, study, validation, same_records).decide();
}

}  // namespace gap
