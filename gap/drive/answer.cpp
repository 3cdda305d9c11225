#include "gap/drive/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/base/idle.hpp"
#include "gap/drive/coverage.hpp"
#include "gap/drive/decide/evidence.hpp"
#include "gap/drive/determined.hpp"
#include "gap/drive/experiment.hpp"
#include "gap/drive/search.hpp"
#include "gap/drive/superfluous.hpp"

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
    const std::vector<Record> train = as_logged(question.train, question.idle_input);
    if (!question.validate.empty()) {
        return extrapolated(train, as_logged(question.validate, question.idle_input));
    }
    // What is kept aside block by block lies between what was fitted.
    return question.split_s
               ? extrapolated(counted_stretches(train, study.counts), counted_stretches(train, validation.counts))
               : std::vector<std::string>{};
}

Proposal proposed(const Answer& answer, const Study& study, const Audit& found) {
    std::vector<const Candidate*> named;
    for (const std::size_t i : answer.decision.effects) {
        named.push_back(&answer.ranking[i].trained);
    }
    const double noise = std::max(answer.whitener.stationary_deviation, study.least_deviation);
    return next_experiment(
        {answer.decision.outcome, study, std::move(named), answer.whitener, noise, found.levels, answer.extrapolated});
}

}  // namespace

double linear_share_of(double gap) { return std::clamp(1.0 - gap * gap, 0.0, 1.0); }

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
    answer.idle_input = question.idle_input;
    answer.records = as_logged(split ? question.train : question.validate, question.idle_input);
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
    drop_superfluous(question, ground, answer.ranking, answer.whitener, answer.decision);
    const Whitener* fits_by = question.refit ? nullptr : &answer.whitener;
    if (question.refit) {
        Candidate best = answer.ranking.front().trained;
        add_intervals(study, best, fits_by);
        answer.lag_wanted = !linear_of(study, best).empty();
    }
    std::vector<std::size_t> shown = answer.decision.effects;
    shown.push_back(answer.decision.chosen);
    if (answer.decision.suspect) {
        shown.push_back(*answer.decision.suspect);
    }
    std::sort(shown.begin(), shown.end());
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    for (const std::size_t i : shown) {
        add_intervals(study, answer.ranking[i].trained, fits_by);
        add_intervals(validation, answer.ranking[i].candidate, fits_by);
    }
    constexpr double least_left = 1.5;
    const double left = over_noise(validation, answer.chosen().gap_after * output_deviation(validation));
    answer.leaves_noise = left < Evidence::usual_ratio;
    answer.place_wanted = left > least_left && speed_hides_effects(question, study.scales);
    answer.base = answer.model_of(answer.none().trained);
    answer.where = where_of(validation, answer.none(), answer.records);
    say("looking for the next experiment");
    answer.extrapolated = extrapolated_by(question, study, validation);
    Proposal proposal = proposed(answer, study, ground.found);
    answer.next_experiment = std::move(proposal.text);
    answer.next_record = std::move(proposal.record);
    answer.notes = ground.found.notes;
    if (answer.idle_input != 0.0) {
        answer.notes.push_back(
            fmt::format("at an input of {:.6g}, the least, the output rests at 0: inputs, and so limits, widths and "
                        "thresholds of causes, are counted from there",
                        answer.idle_input));
    }
    answer.notes.insert(answer.notes.end(), answer.decision.notes.begin(), answer.decision.notes.end());
    answer.linear_share = linear_share_of(answer.none().gap_after);
    return answer;
}

}  // namespace gap
