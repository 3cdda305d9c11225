#include "gap/drive/question.hpp"

#include <algorithm>
#include <cmath>

#include "gap/drive/ends.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/plausible.hpp"
#include "gap/drive/released.hpp"

namespace gap {
namespace {

std::vector<const Effect*> list_of(const Question& question, const Scales& scales) {
    std::vector<const Effect*> list;
    for (const Effect* effect : effects()) {
        const bool off =
            std::find(question.without.begin(), question.without.end(), effect->name) != question.without.end();
        const bool elsewhere = question.domain && !effect->domains.contains(*question.domain);
        const bool of_input = effect->place == Place::command || effect->place == Place::actuator;
        if (!off && !elsewhere && !(of_input && !scales.driven) && !(question.refit && effect->of_fitted_base) &&
            !(question.refit && !question.given_form && effect->linear) && applies(*effect, scales)) {
            list.push_back(effect);
        }
    }
    return list;
}

// The user's own simulation is the base to the last digit; the model says what an effect would change of it.
void agree_with(Course& course, const Scenario& plain, const std::vector<double>& simulated) {
    const std::vector<double> reading = simulate(plain, course);
    std::vector<double> correction = course.correction();
    for (std::size_t i = 0; i < correction.size(); ++i) {
        correction[i] += simulated[i] - reading[i];
    }
    course.correct(std::move(correction));
}

Study make_study(const Question& question, const std::vector<Record>& records, std::vector<std::vector<char>> counts,
                 const Scales& scales, const Audit& found) {
    const double least = std::max(0.29 * found.quantum, 2e-4 * scales.output_span);
    Study study{{question.form, question.refit}, scales, {}, std::move(counts), found.noise, least, 0};
    Scenario plain;
    plain.model = model_of(question.form);
    plain.operating_output = question.operating_output;
    study.base.operating_output = question.operating_output;
    study.base.from_no_input = question.from_no_input;
    study.base.idle_input = question.idle_input;
    const double allowed = 0.3 * std::max(found.noise, least);
    for (const Record& record : records) {
        // Nobody drives a free motion: it moves from where it is let go, and from rest it would not tell any steps.
        Scenario moving = plain;
        if (question.refit && !scales.driven) {
            const std::vector<FreeParameter> state = state_of(study, record);
            moving.operating_output = scales.steady ? state[0].value : 0.0;
            moving.initial_output = state[1].value - moving.operating_output;
        }
        study.courses.push_back(make_course(record, moving, allowed));
        if (!record.simulated.empty()) {
            agree_with(study.courses.back(), plain, record.simulated);
        }
    }
    if (question.metric == Metric::prediction) {
        const double ahead_s = question.horizon_s.value_or(0.02 * scales.length_s);
        study.horizon = std::max<std::size_t>(1, static_cast<std::size_t>(ahead_s / scales.interval_s));
    }
    return study;
}

// Refitted, the steps are off by what the fitted model makes of them, not by what the start did.
void correct_for(Study& study, const Candidate& fitted) {
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        const Record& record = study.courses[r].record();
        const double per_interval = record.usual_interval_s / study.courses[r].grid().step_s;
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

// How many samples of a record tell no more than one: beside a given model each counts.
std::size_t thinning_of(const Study& study, const Record& record) {
    constexpr double enough = 1200.0;
    constexpr double of_time_constant = 0.1;
    if (!study.base.refit) {
        return 1;
    }
    const double most = of_time_constant * study.scales.time_constant_s / record.usual_interval_s;
    return static_cast<std::size_t>(std::max(1.0, std::min(static_cast<double>(record.size()) / enough, most)));
}

// How many readings show what it takes: of what swings several nodes to a reading, a thousand swings and more are left.
std::size_t enough_of(const Course& course) {
    constexpr std::size_t nodes = 6000;
    const std::size_t readings = course.record().size();
    const std::size_t count = course.grid().count;
    return count > std::max(nodes, 2 * readings) ? readings * nodes / count : readings;
}

// Good to about the noise, or to a part of what the base leaves, before it is corrected: enough to see which candidates
// are worth a finer grid. \param thin  takes the records that it is of
Study sketch_of(const Study& study, const Candidate& base, std::vector<Record>& thin) {
    constexpr double of_what_is_left = 0.05;
    Study sketch{study.base, study.scales, {}, {}, study.noise, study.least_deviation, study.horizon};
    thin.clear();
    thin.reserve(study.courses.size());
    double allowed = std::max(study.noise, study.least_deviation);
    if (const double left = rms_of(study, all_residuals(study, base)); study.base.refit && std::isfinite(left)) {
        allowed = std::max(allowed, of_what_is_left * left);
    }
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        const Record& record = study.courses[r].record();
        const std::size_t every = thinning_of(study, record);
        thin.push_back(thinned(record, every));
        Course course = make_sketch(study.courses[r], thin.back(), every, scenario_of(study, base, r), allowed);
        if (const std::size_t beginning = enough_of(course); beginning < thin.back().size()) {
            thin.back() = up_to(thin.back(), thin.back().time_s[beginning]);
            course = make_sketch(study.courses[r], thin.back(), every, scenario_of(study, base, r), allowed);
        }
        sketch.courses.push_back(std::move(course));
        sketch.counts.emplace_back();
        for (std::size_t i = 0; i < thin.back().size(); ++i) {
            sketch.counts.back().push_back(study.counts[r][i * every]);
        }
        sketch.horizon = std::max<std::size_t>(study.horizon > 0 ? 1 : 0, study.horizon / every);
    }
    return sketch;
}

// The base at its start.
Candidate start_of(const Study& study) {
    Candidate start;
    start.base = base_of(study);
    for (const Course& course : study.courses) {
        start.own.push_back(state_of(study, course.record()));
    }
    return start;
}

}  // namespace

bool speed_hides_effects(const Question& question, Scales scales) {
    const std::size_t listed = list_of(question, scales).size();
    scales.maybe_speed = false;
    return list_of(question, scales).size() > listed;
}

Ground prepare(const Question& question) {
    const std::vector<Record>& train = question.train;
    const bool split = question.validate.empty();
    const std::vector<Record>& validate = split ? train : question.validate;
    Audit found = audit(train);
    Scales scales = scales_of(model_of(question.form), train, found);
    const bool let_go = question.refit && !scales.driven;
    if (let_go) {
        say_releases(train, found.notes);
        say_releases(question.validate, found.notes);
    }
    scales.drains = question.domain != Domain::mechanical;
    const auto counted = [&](std::vector<std::vector<char>> counts, const std::vector<Record>& records) {
        counts = question.past_ends ? without_ends(std::move(counts), records) : std::move(counts);
        return let_go ? from_release(std::move(counts), records) : counts;
    };
    Study study = make_study(question, train,
                             counted(split ? part_counts(train, question.split_s, false) : all_count(train), train),
                             scales, found);
    Study validation = make_study(
        question, validate, counted(split ? part_counts(train, question.split_s, true) : all_count(validate), validate),
        scales, found);
    check_plausible(study);
    check_plausible(validation);
    Candidate base = start_of(study);
    if (question.refit) {
        std::vector<Record> thin;
        base = fit(sketch_of(study, base, thin), {}, {}, nullptr, {6, 2, 40});
        correct_for(study, base);
        correct_for(validation, split ? base : carried_over(validation, base, nullptr));
    }
    std::vector<Record> thin;
    Study sketch = sketch_of(study, base, thin);
    return {std::move(found),          std::move(study), std::move(sketch),
            std::move(validation),     std::move(base),  split,
            list_of(question, scales), std::move(thin)};
}

}  // namespace gap
