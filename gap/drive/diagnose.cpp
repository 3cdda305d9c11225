#include "gap/drive/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gap/drive/experiment.hpp"
#include "gap/drive/plausible.hpp"
#include "gap/drive/search.hpp"

namespace gap {
namespace {

// A refitted base has these already.
bool is_of_the_base(const Effect& effect) {
    static const std::vector<std::string> theirs = {"gain_error",       "time_scale_error", "dead_time_error",
                                                    "order_error",      "sensor_offset",    "finite_memory",
                                                    "single_precision", "fixed_point"};
    return std::find(theirs.begin(), theirs.end(), effect.name) != theirs.end();
}

std::vector<const Effect*> list_of(const Question& question, const Scales& scales) {
    std::vector<const Effect*> list;
    for (const Effect* effect : effects()) {
        const bool off =
            std::find(question.without.begin(), question.without.end(), effect->name) != question.without.end();
        if (!off && !(question.refit && is_of_the_base(*effect)) && applies(*effect, scales)) {
            list.push_back(effect);
        }
    }
    return list;
}

Study make_study(const Question& question, const std::vector<Record>& records, std::vector<std::vector<char>> counts,
                 const Scales& scales, const Audit& found) {
    const double least = std::max(0.29 * found.quantum, 2e-4 * scales.output_span);
    Study study{{question.form, question.refit}, scales, {}, std::move(counts), found.noise, least, 0};
    Scenario plain;
    plain.model = model_of(question.form);
    for (const Record& record : records) {
        study.courses.push_back(make_course(record, plain, 0.3 * std::max(found.noise, least)));
    }
    if (question.metric == Metric::prediction) {
        study.horizon = std::max<std::size_t>(1, static_cast<std::size_t>(0.02 * scales.length_s / scales.interval_s));
    }
    return study;
}

// Refitted, the steps are off by what the fitted model makes of them, not by what the start did.
void correct_for(Study& study, const Candidate& fitted) {
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        const Record& record = study.courses[r].record();
        const auto per_interval =
            static_cast<unsigned>(std::max(1.0, std::round(record.usual_interval_s / study.courses[r].grid().step_s)));
        const Scenario scenario = scenario_of(study, fitted, r);
        const std::vector<double> coarse = simulate(scenario, Course(record, per_interval));
        const std::vector<double> fine = simulate(scenario, Course(record, 2 * per_interval));
        std::vector<double> off(record.size());
        for (std::size_t i = 0; i < off.size(); ++i) {
            off[i] = (fine[i] - coarse[i]) * 4.0 / 3.0;
        }
        if (std::all_of(off.begin(), off.end(), [](double value) { return std::isfinite(value); })) {
            study.courses[r].correct(std::move(off));
        }
    }
}

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
    const std::vector<Record>& train = question.train;
    const bool split = question.validate.empty();
    const std::vector<Record>& validate = split ? train : question.validate;
    const Audit found = audit(train);
    const Scales scales = scales_of(model_of(question.form), train, found);
    Study study = make_study(question, train, split ? part_counts(train, question.split_s, false) : all_count(train),
                             scales, found);
    Study validation = make_study(
        question, validate, split ? part_counts(train, question.split_s, true) : all_count(validate), scales, found);
    check_plausible(study);
    check_plausible(validation);
    if (question.refit) {
        const Candidate rough = fit(study, {}, {}, nullptr, {6, 2, 40});
        correct_for(study, rough);
        correct_for(validation, split ? rough : carried_over(validation, rough, nullptr));
    }
    Found all = search({study, validation, split, list_of(question, scales), question.jobs, say});
    Answer answer{};
    answer.form = question.form;
    answer.refit = question.refit;
    answer.ranking = std::move(all.ranking);
    answer.whitener = all.whitener;
    answer.split = split;
    answer.records = validate;
    answer.metric = study.horizon > 0 ? fmt::format("prediction {:.4g} s ahead",
                                                    static_cast<double>(study.horizon) * scales.interval_s)
                                      : "simulation";
    say("deciding");
    answer.decision = decide(answer.ranking, study, validation, split);
    for (const std::size_t i : answer.decision.effects) {
        add_deviations(study, answer.ranking[i].trained, answer.whitener);
        add_deviations(validation, answer.ranking[i].candidate, answer.whitener);
    }
    answer.base = answer.model_of(answer.none().trained);
    answer.where = where_of(validation, answer.none(), validate);
    say("looking for the next experiment");
    answer.next_experiment = next_experiment(answer, study, found);
    answer.notes = found.notes;
    answer.notes.insert(answer.notes.end(), answer.decision.notes.begin(), answer.decision.notes.end());
    return answer;
}

}  // namespace gap
