#include "gap/drive/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gap/drive/determined.hpp"
#include "gap/drive/experiment.hpp"
#include "gap/drive/search.hpp"
#include "qemu/failure.hpp"

namespace gap {
namespace {

Where where_of(const Study& validation, const Ranked& none, const std::vector<Record>& records) {
    std::vector<std::vector<double>> residuals = none.residuals;
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        for (std::size_t i = 0; i < residuals[r].size(); ++i) {
            residuals[r][i] = validation.counts[r][i] != 0 && std::isfinite(residuals[r][i]) ? residuals[r][i] : 0.0;
        }
    }
    return locate(records, residuals);
}

std::string next_experiment(const Answer& answer, const Study& study, const Audit& found) {
    const Decision& decision = answer.decision;
    const double noise = std::max(answer.whitener.stationary_deviation, study.least_deviation);
    switch (decision.outcome) {
        case Outcome::no_gap:
            return "none for this gap; another operating profile would tell whether the model holds there";
        case Outcome::attributed:
            return "a record at other levels and speeds, as a test of the size found here";
        case Outcome::unknown:
            return found.levels <= 3
                       ? "a staircase up and down with at least 5 levels, then a pseudo-random sequence about one of "
                         "them: "
                         "the first shows what depends on level and direction, the second what depends on frequency"
                       : "the same record twice more: what repeats is of the drive, what does not came from outside; "
                         "and one "
                         "more signal (speed, current, supply) at the same time";
        case Outcome::ambiguous:
            break;
    }
    std::vector<const Candidate*> alternatives;
    for (const std::size_t i : decision.effects) {
        alternatives.push_back(&answer.ranking[i].trained);
    }
    return part(study, alternatives, noise).text;
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
    std::vector<std::size_t> shown = answer.decision.effects;
    shown.push_back(answer.decision.suspect.value_or(answer.decision.chosen));
    for (const std::size_t i : shown) {
        add_intervals(study, answer.ranking[i].trained, fits_by);
        add_intervals(validation, answer.ranking[i].candidate, fits_by);
    }
    answer.base = answer.model_of(answer.none().trained);
    answer.where = where_of(validation, answer.none(), answer.records);
    say("looking for the next experiment");
    answer.next_experiment = next_experiment(answer, study, ground.found);
    answer.notes = ground.found.notes;
    answer.notes.insert(answer.notes.end(), answer.decision.notes.begin(), answer.decision.notes.end());
    answer.linear_share = linear_share_of(answer.none().gap_after);
    return answer;
}

// What a richer linear description makes of the same candidate.
struct Beside {
    double none;
    double effects;
};

Beside beside(const Described& description, Question question, const std::vector<const Effect*>& effects) {
    question.form = description.form;
    const Ground ground = prepare(question);
    const auto gap_of = [&](const Candidate& trained) {
        const Candidate judged = ground.same_records ? trained : carried_over(ground.validation, trained, nullptr);
        return rms_of(ground.validation, all_residuals(ground.validation, judged)) /
               output_deviation(ground.validation);
    };
    const Candidate none = fit(ground.study, {}, ground.base, nullptr);
    return {gap_of(none), gap_of(fit(ground.study, effects, none, nullptr))};
}

}  // namespace

Answer diagnose(Question question, const std::function<void(const std::string&)>& say) {
    if (!question.find) {
        Answer answer = answer_to(question, say);
        answer.base_name = question.base_name;
        return answer;
    }
    std::vector<Described> found = find_base(question, say);
    const auto begin_with = [&](const Described& description) {
        question.form = description.form;
        question.refit = true;
        if (question.metric_free) {
            question.metric = rests(description.form) ? Metric::simulation : Metric::prediction;
        }
        say(fmt::format("the base: {} ({})", description.name, description.meaning));
    };
    begin_with(found.front());
    Answer answer = answer_to(question, say);
    std::string name = found.front().name;
    // What an effect seems to do may be a lag that the base lacks: a richer linear description is asked with the same
    // effects, and where it goes much further, all of it once more with that.
    if (!answer.chosen().trained.effects.empty()) {
        double left = answer.chosen().gap_after;
        const Described* further = nullptr;
        for (const Described& richer : found) {
            if (richer.numbers <= found.front().numbers || richer.numbers > found.front().numbers + 2 ||
                rests(richer.form) != rests(found.front().form)) {
                continue;
            }
            say(fmt::format("asking {} with the same effects", richer.name));
            const Beside both = beside(richer, question, answer.chosen().trained.effects);
            const double least = std::min(both.none, both.effects);
            constexpr double much_further = 0.85;
            if (least < much_further * left) {
                left = least;
                further = &richer;
            }
        }
        if (further != nullptr) {
            name = further->name;
            begin_with(*further);
            answer = answer_to(question, say);
        }
    }
    answer.base_name = name;
    double best = answer.none().gap_after;
    for (const Described& one : found) {
        best = std::min(best, one.validation);
    }
    answer.linear_share = linear_share_of(best);
    answer.descriptions = std::move(found);
    return answer;
}

}  // namespace gap
