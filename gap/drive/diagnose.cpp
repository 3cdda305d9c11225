#include "gap/drive/diagnose.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/base/jointly.hpp"
#include "gap/drive/base/signs.hpp"
#include "gap/drive/base/structure.hpp"
#include "gap/drive/coverage.hpp"
#include "gap/drive/determined.hpp"
#include "gap/drive/experiment.hpp"
#include "gap/drive/search.hpp"

namespace gap {
namespace {

Where where_of(const Study& validation, const Ranked& none, const std::vector<Record>& records) {
    std::vector<std::vector<double>> residuals = none.residuals;
    for (auto& record : residuals) {
        std::replace_if(
            record.begin(), record.end(), [](double value) { return !std::isfinite(value); }, 0.0);
    }
    return locate(records, std::move(residuals), validation.counts);
}

std::vector<std::string> extrapolated_by(const Question& question, const Study& study, const Study& validation) {
    if (!question.validate.empty()) {
        return extrapolated(question.train, question.validate);
    }
    // What is kept aside block by block lies between what was fitted.
    return question.split_s ? extrapolated(counted_stretches(question.train, study.counts),
                                           counted_stretches(question.train, validation.counts))
                            : std::vector<std::string>{};
}

std::string proposed(const Answer& answer, const Study& study, const Audit& found) {
    std::vector<const Candidate*> named;
    for (const std::size_t i : answer.decision.effects) {
        named.push_back(&answer.ranking[i].trained);
    }
    const double noise = std::max(answer.whitener.stationary_deviation, study.least_deviation);
    return next_experiment(
        {answer.decision.outcome, study, std::move(named), answer.whitener, noise, found.levels, answer.extrapolated});
}

double linear_share_of(double gap) { return std::clamp(1.0 - gap * gap, 0.0, 1.0); }

bool rests(const drive::Form& form) { return drive::constant_coefficient(gap::model_of(form).denominator) != 0.0; }

}  // namespace

const Ranked& Answer::none() const {
    return *std::find_if(ranking.begin(), ranking.end(),
                         [](const Ranked& ranked) { return ranked.trained.effects.empty(); });
}

drive::Model Answer::model_of(const Candidate& candidate) const {
    if (!refit) {
        return gap::model_of(*form);
    }
    return gap::model_of(with_values(*form, candidate));
}

namespace {

Answer answer_to(const Question& question, const std::function<void(const std::string&)>& say) {
    const Ground ground = prepare(question);
    const Study& study = ground.study;
    const Study& validation = ground.validation;
    const bool split = ground.same_records;
    Found all = search({ground, question.jobs, say});
    Answer answer{};
    answer.form = question.form;
    answer.refit = question.refit;
    answer.ranking = std::move(all.ranking);
    answer.whitener = all.whitener;
    answer.split = split;
    answer.records = split ? question.train : question.validate;
    answer.metric = study.horizon > 0 ? fmt::format("prediction {:.4g} s ahead",
                                                    static_cast<double>(study.horizon) * study.scales.interval_s)
                                      : "simulation";
    // Against a base without a finite output anything would look like a cause.
    if (answer.none().gap_after >= Ranked::ran_away) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("{}: expected a base that stays finite there, found {}, which runs away: take "
                        "another form, or --metric prediction for a drive that integrates",
                        answer.records.front().name, drive::to_text(answer.model_of(answer.none().trained))));
    }
    say("deciding");
    answer.decision = decide(answer.ranking, answer.whitener, study, validation, split);
    const Whitener* fits_by = question.refit ? nullptr : &answer.whitener;
    if (question.refit) {
        Candidate best = answer.ranking.front().trained;
        add_intervals(study, best, fits_by);
        answer.lag_wanted = !linear_of(best).empty();
    }
    std::vector<std::size_t> shown = answer.decision.effects;
    shown.push_back(answer.decision.suspect.value_or(answer.decision.chosen));
    for (const std::size_t i : shown) {
        add_intervals(study, answer.ranking[i].trained, fits_by);
        add_intervals(validation, answer.ranking[i].candidate, fits_by);
    }
    answer.base = answer.model_of(answer.none().trained);
    answer.where = where_of(validation, answer.none(), answer.records);
    say("looking for the next experiment");
    answer.extrapolated = extrapolated_by(question, study, validation);
    answer.next_experiment = proposed(answer, study, ground.found);
    answer.notes = ground.found.notes;
    answer.notes.insert(answer.notes.end(), answer.decision.notes.begin(), answer.decision.notes.end());
    answer.linear_share = linear_share_of(answer.none().gap_after);
    return answer;
}

// A base with what was found beside it, and what that is worth: the logarithm of the gap, and a price for each number.
struct Tried {
    std::string name;
    Answer answer;
    double price;
};

double price_of(const Answer& answer, int base_numbers, double floor) {
    constexpr double each = 0.08;
    const Candidate& named = answer.chosen().trained;
    return std::log(std::max(answer.chosen().gap_after, floor)) +
           each * (base_numbers + static_cast<double>(named.effect_parameters()));
}

// The base that does best by itself, the best ones of fewer and of more numbers, and the best that integrates where it
// does not, or the other way round: beside an effect a simpler one may do as well, and what seems an effect may be a
// lag that a richer one has.
std::vector<const Described*> worth_asking(const std::vector<Described>& found) {
    const Described& front = found.front();
    std::vector<const Described*> asked = {&front};
    const auto add_first = [&](auto suits) {
        for (const Described& one : found) {  // the best first
            const bool known = std::find(asked.begin(), asked.end(), &one) != asked.end();
            if (!known && suits(one)) {
                asked.push_back(&one);
                return;
            }
        }
    };
    const auto alike = [&](const Described& one) { return (one.integrators > 0) == (front.integrators > 0); };
    // Where it was fitted and where it was not.
    const auto within = [&](const Described& one, double times) {
        return one.aside < times * front.aside && one.validation < times * front.validation;
    };
    // What a richer one makes of a bend fits the training, and elsewhere less well.
    const auto better_elsewhere = [&](const Described& one) {
        constexpr double clearly = 0.8;
        return one.validation < clearly * front.validation;
    };
    add_first([&](const Described& one) {
        return alike(one) && one.numbers < front.numbers && (within(one, 2.0) || better_elsewhere(one));
    });
    // A richer one that says nothing more would only say it again.
    const auto further = [&](const Described& one) {
        constexpr double more = 0.97;
        return one.aside < more * front.aside || one.validation < more * front.validation;
    };
    add_first([&](const Described& one) {
        return alike(one) && one.numbers > front.numbers && within(one, 1.2) && further(one);
    });
    add_first([&](const Described& one) { return !alike(one) && one.integrators < 2 && within(one, 1.6); });
    return asked;
}

const Described* with_one_lag_more(const std::vector<Described>& found, const Described& than) {
    const auto richer = std::find_if(found.begin(), found.end(), [&](const Described& one) {
        return one.integrators == than.integrators && one.numbers == than.numbers + 1;
    });
    return richer == found.end() ? nullptr : &*richer;
}

std::vector<std::string> causes_of(const Answer& answer) {
    std::vector<std::string> names;
    for (const std::size_t i : answer.decision.effects) {
        for (const Effect* effect : answer.ranking[i].trained.effects) {
            names.push_back(effect->name);
        }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

// What the best base does as well when it sees the validation, too, is none of the drive's effects. Of a form that was
// asked for it may be the form's own misfit, as well in one record as in two.
void ask_jointly(Answer& answer, const Question& question) {
    if (answer.decision.outcome == Outcome::no_gap) {
        return;
    }
    constexpr double as_well = 1.15;
    // More than that left, and something is missing; a plant that was only seen on its way up may come down otherwise.
    constexpr double nearly_all = 0.1;
    constexpr double most = 0.25;
    const bool one_way = std::any_of(answer.extrapolated.begin(), answer.extrapolated.end(), [](const auto& what) {
        return what == "falling output" || what == "rising output";
    });
    const double jointly = joint_gap(question);
    if (jointly > as_well * answer.chosen().gap_after ||
        jointly > (one_way ? most : nearly_all) * answer.none().gap_after) {
        return;
    }
    answer.decision.outcome = Outcome::no_gap;
    answer.decision.effects.clear();
    answer.decision.suspect.reset();
    answer.decision.confidence = std::min(answer.decision.confidence, 0.9);
    answer.next_experiment =
        answer.extrapolated.empty()
            ? "none for this gap; a longer training record would tell the base's numbers by itself"
            : fmt::format("train on what validation alone has, too: {}", fmt::join(answer.extrapolated, "; "));
    answer.notes.push_back(fmt::format(
        "fitted to the validation, too, the base leaves {:.4f} without any effect: training alone does not tell "
        "its numbers",
        jointly));
}

// Signs that the input says are a start; those of a base that was fitted to them are better, and so on, while they
// change.
Question with_signs_of_a_base(Question question) {
    question.train = with_signs(std::move(question.train));
    question.validate = with_signs(std::move(question.validate));
    question.refit = true;
    const Structure& structure = *structure_named("third_order");
    constexpr int rounds = 12;
    for (int round = 0; round < rounds; ++round) {
        question.form = starts_of(structure, question.train).whole;
        const Ground ground = prepare(question);
        const Candidate fitted = fit(ground.study, {}, ground.base, nullptr);
        bool changed = false;
        const auto take = [&](std::vector<Record>& records, const Study& study, const Candidate& candidate) {
            for (std::size_t r = 0; r < records.size(); ++r) {
                const std::vector<double> left = residuals_of(study, candidate, r);
                for (std::size_t i = 0; i < left.size(); ++i) {
                    double& z = records[r].output[i];
                    const double now = std::copysign(z, z - left[i]);
                    changed = changed || now != z;
                    z = now;
                }
            }
        };
        Question next = question;
        take(next.train, ground.study, fitted);
        if (!question.validate.empty()) {
            take(next.validate, ground.validation, carried_over(ground.validation, fitted, nullptr));
        }
        question.train = std::move(next.train);
        question.validate = std::move(next.validate);
        if (!changed) {
            break;
        }
    }
    return question;
}

Answer answer_with_found_base(Question question, const std::function<void(const std::string&)>& say) {
    std::vector<Described> found = find_base(question, say);
    question.refit = true;
    // No linear description turns its output's sign: where readings may have lost theirs, one is looked for that
    // follows them with it, and the loss is an effect like others.
    constexpr double poor = 0.5;
    if (found.front().validation > poor && may_have_lost_signs(question.train)) {
        say("looking for signs that the sensor may have lost");
        std::vector<Described> better = find_base(with_signs_of_a_base(question), say);
        if (better.front().validation < 0.5 * found.front().validation) {
            found = std::move(better);
        }
    }
    const double floor = 1e-4;
    std::vector<Tried> tried;
    std::vector<const Described*> asked = worth_asking(found);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const Described* base = asked[i];
        say(fmt::format("the base: {} ({})", base->name, base->meaning));
        question.form = base->form;
        Answer answer = answer_to(question, say);
        const bool closed = answer.decision.outcome == Outcome::no_gap;
        const double price = price_of(answer, base->numbers, floor);
        if (const Described* richer = answer.lag_wanted ? with_one_lag_more(found, *base) : nullptr;
            richer != nullptr && std::find(asked.begin(), asked.end(), richer) == asked.end()) {
            asked.push_back(richer);
        }
        tried.push_back({base->name, std::move(answer), price});
        if (closed && tried.size() == 1) {
            break;
        }
    }
    std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.price < b.price; });
    Answer answer = std::move(tried.front().answer);
    answer.base_name = tried.front().name;
    const std::vector<std::string> causes = causes_of(answer);
    for (std::size_t i = 1; i < tried.size() && !causes.empty(); ++i) {
        constexpr double near = 0.2;
        const std::vector<std::string> theirs = causes_of(tried[i].answer);
        if (tried[i].price < tried.front().price + near && !theirs.empty() && theirs != causes) {
            answer.decision.confidence = std::min(answer.decision.confidence, 0.6);
            answer.notes.push_back(
                fmt::format("beside the base {} {} goes about as far", tried[i].name, fmt::join(theirs, " + ")));
        }
    }
    for (const Described& one : found) {
        if (one.name == answer.base_name) {
            question.form = one.form;
        }
    }
    ask_jointly(answer, question);
    answer.descriptions = std::move(found);
    return answer;
}

// The base is what the user's own simulator gave; a model that reproduces it, without noise and so to a thousandth,
// says what each effect would change.
Answer answer_beside_simulation(Question question, const std::function<void(const std::string&)>& say) {
    double reproduced = 0.0;
    if (question.find) {
        Question of_simulation = question;
        double offset = 0.0;
        for (auto* records : {&of_simulation.train, &of_simulation.validate}) {
            for (Record& record : *records) {
                record.output = record.simulated;
                record.simulated.clear();
            }
        }
        const std::vector<Described> found = find_base(of_simulation, say);
        of_simulation.form = found.front().form;
        of_simulation.refit = true;
        const Ground ground = prepare(of_simulation);
        const Candidate fitted = fit(ground.study, {}, ground.base, nullptr);
        if (rests(found.front().form)) {
            offset = fitted.own.front().front().value;
        }
        reproduced = rms_of(ground.study, all_residuals(ground.study, fitted)) / output_deviation(ground.study);
        question.form = with_values(found.front().form, fitted);
        question.operating_output = offset;
        question.base_name = fmt::format("the simulation, as a {}", found.front().name);
    } else {
        question.base_name = "the simulation, with the given model";
    }
    question.find = question.refit = false;
    Answer answer = answer_to(question, say);
    answer.base_name = question.base_name;
    constexpr double poorly = 0.1;
    answer.notes.push_back(
        fmt::format("a model reproduces the simulation but for {:.2g} % of its deviation", 100.0 * reproduced));
    if (reproduced > poorly && answer.decision.outcome != Outcome::no_gap) {
        answer.decision.outcome = Outcome::unknown;
        answer.decision.suspect = answer.decision.chosen;
        answer.decision.effects.clear();
        answer.decision.confidence = std::min(answer.decision.confidence, 0.5);
        answer.notes.emplace_back("too poorly for effects to be told apart: where the gap lies is told all the same");
    }
    return answer;
}

void check_simulated(const Question& question) {
    std::size_t with = 0;
    for (const auto* records : {&question.train, &question.validate}) {
        for (const Record& record : *records) {
            with += record.simulated.empty() ? 0 : 1;
        }
    }
    if (with != 0 && with != question.train.size() + question.validate.size()) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("expected what was simulated in every log, found it in {} of {}", with,
                                         question.train.size() + question.validate.size()));
    }
}

}  // namespace

Answer diagnose(Question question, const std::function<void(const std::string&)>& say) {
    check_simulated(question);
    if (!question.train.front().simulated.empty()) {
        return answer_beside_simulation(std::move(question), say);
    }
    if (question.find) {
        return answer_with_found_base(std::move(question), say);
    }
    Answer answer = answer_to(question, say);
    answer.base_name = question.base_name;
    return answer;
}

}  // namespace gap
