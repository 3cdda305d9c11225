#include "gap/drive/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

}  // namespace

const Ranked& Answer::none() const {
    return *std::find_if(ranking.begin(), ranking.end(),
                         [](const Ranked& ranked) { return ranked.trained.effects.empty(); });
}

drive::Model Answer::model_of(const Candidate& candidate) const {
    if (!refit) {
        return gap::model_of(*form);
    }
    std::vector<double> values;
    for (const drive::Parameter& parameter : form->parameters()) {
        const auto mine = std::find_if(candidate.base.begin(), candidate.base.end(),
                                       [&](const FreeParameter& free) { return free.name == parameter.name; });
        values.push_back(mine == candidate.base.end() ? parameter.value : mine->value);
    }
    return form->to_model(values);
}

Answer diagnose(const Question& question, const std::function<void(const std::string&)>& say) {
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
    answer.decision = decide(answer.ranking, study, validation, split);
    for (const std::size_t i : answer.decision.effects) {
        add_deviations(study, answer.ranking[i].trained, answer.whitener);
        add_deviations(validation, answer.ranking[i].candidate, answer.whitener);
    }
    answer.base = answer.model_of(answer.none().trained);
    answer.where = where_of(validation, answer.none(), answer.records);
    say("looking for the next experiment");
    answer.next_experiment = next_experiment(answer, study, ground.found);
    answer.notes = ground.found.notes;
    answer.notes.insert(answer.notes.end(), answer.decision.notes.begin(), answer.decision.notes.end());
    return answer;
}

}  // namespace gap
