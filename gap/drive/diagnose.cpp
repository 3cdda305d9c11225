#include "gap/drive/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/parallel.hpp"
#include "qemu/failure.hpp"

namespace gap {
namespace {

constexpr std::size_t whitener_order = 8;

// How long the model takes to most of its way: the time at which a step's response has made 63 % of where it is after
// the record, simulated.
double time_constant_of(const drive::Model& model, const Record& record) {
    double sum = 0.0;
    double weight = 0.0;
    for (const drive::Term& term : model.denominator) {
        if (term.order > 0.0 && drive::constant_coefficient(model.denominator) != 0.0) {
            sum += std::pow(std::fabs(term.coefficient / drive::constant_coefficient(model.denominator)),
                            1.0 / term.order);
            weight += 1.0;
        }
    }
    const double length_s = record.time_s.back() - record.time_s.front();
    const double found = weight > 0.0 ? sum / weight : 0.1 * length_s;
    return std::clamp(found, 2.0 * record.usual_interval_s, 0.3 * length_s);
}

Scales scales_of(const drive::Model& model, const std::vector<Record>& records) {
    Scales scales{};
    scales.output_low = scales.output_high = records.front().output.front();
    for (const Record& record : records) {
        for (const double u : record.input) {
            scales.input_max = std::max(scales.input_max, std::fabs(u));
        }
        for (const double z : record.output) {
            scales.output_low = std::min(scales.output_low, z);
            scales.output_high = std::max(scales.output_high, z);
        }
        scales.length_s = std::max(scales.length_s, record.time_s.back() - record.time_s.front());
    }
    scales.output_span = scales.output_high - scales.output_low;
    scales.interval_s = records.front().usual_interval_s;
    scales.time_constant_s = time_constant_of(model, records.front());
    scales.speed_max = scales.output_span / scales.time_constant_s;
    scales.force = std::fabs(model.gain) * scales.input_max;
    return scales;
}

// The smallest difference between readings that occurs: the quantum, where there is one.
double quantum_of(const std::vector<Record>& records) {
    double least = 0.0;
    for (const Record& record : records) {
        for (std::size_t i = 1; i < record.size(); ++i) {
            const double by = std::fabs(record.output[i] - record.output[i - 1]);
            if (by > 0.0 && (least == 0.0 || by < least)) {
                least = by;
            }
        }
    }
    return least;
}

std::vector<std::vector<char>> all_count(const std::vector<Record>& records) {
    std::vector<std::vector<char>> counts;
    for (const Record& record : records) {
        counts.emplace_back(record.size(), 1);
    }
    return counts;
}

// Of each record every third of ten blocks is kept aside, or what lies behind the split.
std::vector<std::vector<char>> part_counts(const std::vector<Record>& records, std::optional<double> split_s,
                                           bool kept_aside) {
    std::vector<std::vector<char>> counts;
    for (const Record& record : records) {
        std::vector<char> count(record.size());
        for (std::size_t i = 0; i < record.size(); ++i) {
            const double share =
                (record.time_s[i] - record.time_s.front()) / (record.time_s.back() - record.time_s.front());
            const bool aside = split_s ? record.time_s[i] >= *split_s : static_cast<int>(share * 10.0) % 3 == 2;
            count[i] = aside == kept_aside ? 1 : 0;
        }
        counts.push_back(std::move(count));
    }
    return counts;
}

double rms(const std::vector<std::vector<double>>& residuals, const std::vector<std::vector<char>>& counts) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        for (std::size_t i = 0; i < residuals[r].size(); ++i) {
            if (counts[r][i] != 0) {
                sum += residuals[r][i] * residuals[r][i];
                count += 1.0;
            }
        }
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

double deviation_of_output(const Study& study) {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        const Record& record = study.courses[r].record();
        for (std::size_t i = 0; i < record.size(); ++i) {
            if (study.counts[r][i] != 0) {
                sum += record.output[i];
                squares += record.output[i] * record.output[i];
                count += 1.0;
            }
        }
    }
    return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
}

class Diagnosis {
public:
    Diagnosis(const Question& question, const std::function<void(const std::string&)>& say)
        : question_(question), say_(say) {
        const std::vector<Record>& train = question.train;
        std::vector<double> values;
        for (const drive::Parameter& parameter : question.form.parameters()) {
            values.push_back(parameter.value);
        }
        const drive::Model model = question.form.to_model(values);
        const Base base{question.form, question.refit, question.refit};
        const Scales scales = scales_of(model, train);
        const double least = std::max(0.29 * quantum_of(train), 1e-7 * scales.output_span);
        split_ = question.validate.empty();
        study_.emplace(
            Study{base, scales, {}, split_ ? part_counts(train, question.split_s, false) : all_count(train), least});
        const std::vector<Record>& validate = split_ ? train : question.validate;
        validation_.emplace(
            Study{base, scales, {}, split_ ? part_counts(train, question.split_s, true) : all_count(validate), least});
        Scenario plain;
        plain.model = model;
        for (const Record& record : train) {
            study_->courses.push_back(make_course(record, plain, 0.1 * least + 1e-4 * scales.output_span));
        }
        for (const Record& record : validate) {
            validation_->courses.push_back(make_course(record, plain, 0.1 * least + 1e-4 * scales.output_span));
        }
    }

    Answer run() {
        say_("base");
        Candidate none = fit(*study_, {}, {}, nullptr, 1);
        std::vector<const Effect*> list;
        for (const Effect* effect : effects()) {
            if (std::find(question_.without.begin(), question_.without.end(), effect->name) ==
                    question_.without.end() &&
                !is_of_the_base(*effect)) {
                list.push_back(effect);
            }
        }
        say_("effects");
        std::vector<Candidate> singles(list.size());
        bench::parallel_for(list.size(), question_.jobs,
                            [&](std::size_t i) { singles[i] = fit(*study_, {list[i]}, none, nullptr, 2); });
        by_cost(singles);
        Whitener whitener = whitener_of(singles.front().cost < none.cost ? singles.front() : none);
        say_("effects, whitened");
        const std::size_t shortlist = std::min<std::size_t>(10, singles.size());
        none = fit(*study_, {}, none, &whitener, 1);
        bench::parallel_for(singles.size(), question_.jobs, [&](std::size_t i) {
            if (i < shortlist) {
                singles[i] = fit(*study_, singles[i].effects, singles[i], &whitener, 1);
            }
        });
        singles.resize(shortlist);
        by_cost(singles);
        whitener = whitener_of(singles.front());
        say_("pairs");
        std::vector<Candidate> all = singles;
        const std::size_t paired = std::min<std::size_t>(5, singles.size());
        std::vector<std::pair<std::size_t, std::size_t>> pairs;
        for (std::size_t a = 0; a < paired; ++a) {
            for (std::size_t b = a + 1; b < paired; ++b) {
                pairs.emplace_back(a, b);
            }
        }
        std::vector<Candidate> two(pairs.size());
        bench::parallel_for(pairs.size(), question_.jobs, [&](std::size_t i) {
            const auto [a, b] = pairs[i];
            two[i] = fit(*study_, {singles[a].effects[0], singles[b].effects[0]}, singles[a], &whitener, 2);
        });
        all.insert(all.end(), two.begin(), two.end());
        all.push_back(none);
        by_cost(all);
        whitener = whitener_of(all.front());
        say_("validation");
        Answer answer{};
        answer.whitener = whitener;
        answer.ranking.resize(all.size());
        bench::parallel_for(all.size(), question_.jobs,
                            [&](std::size_t i) { answer.ranking[i] = validated(all[i], whitener); });
        std::stable_sort(answer.ranking.begin(), answer.ranking.end(),
                         [](const Ranked& a, const Ranked& b) { return a.score > b.score; });
        decide(answer);
        answer.split = split_;
        for (const std::size_t i : answer.effects) {
            // Their sizes are those of the training records; events have their own in each record.
            const auto trained = std::find_if(all.begin(), all.end(), [&](const Candidate& candidate) {
                return candidate.effects == answer.ranking[i].candidate.effects;
            });
            Candidate sized = *trained;
            add_deviations(*study_, sized, whitener);
            answer.ranking[i].candidate.lasting = sized.lasting;
        }
        answer.where = where_of(answer);
        answer.next_experiment = next_experiment(answer);
        return answer;
    }

private:
    // A refitted base has these already.
    [[nodiscard]] bool is_of_the_base(const Effect& effect) const {
        static const std::vector<std::string> theirs = {"gain_error", "time_scale_error", "dead_time_error",
                                                        "order_error", "sensor_offset"};
        return question_.refit && std::find(theirs.begin(), theirs.end(), effect.name) != theirs.end();
    }

    static void by_cost(std::vector<Candidate>& candidates) {
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    }

    Whitener whitener_of(const Candidate& candidate) const {
        std::vector<std::vector<double>> residuals;
        for (std::size_t r = 0; r < study_->courses.size(); ++r) {
            residuals.push_back(residuals_of(*study_, candidate, r));
        }
        return fit_whitener(residuals, whitener_order, study_->least_deviation);
    }

    Ranked validated(const Candidate& fitted, const Whitener& whitener) const {
        Ranked ranked{split_ ? fitted : carried_over(*validation_, fitted, &whitener), {}, 0.0, 0.0, {}, 0.0};
        for (std::size_t r = 0; r < validation_->courses.size(); ++r) {
            ranked.residuals.push_back(residuals_of(*validation_, ranked.candidate, r));
            const std::vector<double> logs = whitener.log_likelihood(ranked.residuals.back());
            for (std::size_t i = 0; i < logs.size(); ++i) {
                if (validation_->counts[r][i] != 0) {
                    ranked.by_sample.push_back(logs[i]);
                    ranked.log_likelihood += logs[i];
                }
            }
        }
        ranked.gap_after = rms(ranked.residuals, validation_->counts) / deviation_of_output(*validation_);
        ranked.score = score(ranked);
        return ranked;
    }

    // What is not fitted there costs nothing; more effects must be worth more.
    static double score(const Ranked& ranked) {
        double own = 0.0;
        for (const auto& list : ranked.candidate.own) {
            own += static_cast<double>(list.size());
        }
        return ranked.log_likelihood - 3.0 * own - 4.0 * static_cast<double>(ranked.candidate.effects.size());
    }

    [[nodiscard]] Where where_of(const Answer& answer) const {
        const auto none = std::find_if(answer.ranking.begin(), answer.ranking.end(),
                                       [](const Ranked& ranked) { return ranked.candidate.effects.empty(); });
        std::vector<Record> records;
        std::vector<std::vector<double>> residuals = none->residuals;
        for (std::size_t r = 0; r < residuals.size(); ++r) {
            records.push_back(validation_->courses[r].record());
            for (std::size_t i = 0; i < residuals[r].size(); ++i) {
                residuals[r][i] = validation_->counts[r][i] != 0 ? residuals[r][i] : 0.0;
            }
        }
        return locate(records, residuals);
    }

    [[nodiscard]] std::string next_experiment(const Answer& answer) const {
        if (answer.outcome == Outcome::no_gap) {
            return "none is needed for this gap; another operating profile would tell whether the model holds there";
        }
        if (answer.outcome == Outcome::attributed) {
            return "repeat the record at another level, to see the effect with the size found here";
        }
        std::vector<double> seen;
        for (const Course& course : study_->courses) {
            for (const double u : course.record().input) {
                if (std::none_of(seen.begin(), seen.end(), [&](double other) {
                        return std::fabs(other - u) < 0.02 * study_->scales.input_max;
                    })) {
                    seen.push_back(u);
                }
            }
        }
        if (seen.size() <= 2) {
            return "a staircase up and down with at least 5 levels: one level cannot part a gain from a bend of the "
                   "input";
        }
        return "a release from a raised place with the input at 0, and small fast steps about a level: they part "
               "forces from lags";
    }

    void decide(Answer& answer) const {
        const auto none = std::find_if(answer.ranking.begin(), answer.ranking.end(),
                                       [](const Ranked& ranked) { return ranked.candidate.effects.empty(); });
        answer.base_gap = none->gap_after;
        const Ranked& best = answer.ranking.front();
        answer.noise_floor = best.gap_after;
        for (const Ranked& ranked : answer.ranking) {
            answer.noise_floor = std::min(answer.noise_floor, ranked.gap_after);
        }
        const auto better_than = [&](const Ranked& a, const Ranked& b) {
            std::vector<double> difference(a.by_sample.size());
            for (std::size_t i = 0; i < difference.size(); ++i) {
                difference[i] = a.by_sample[i] - b.by_sample[i];
            }
            return bootstrap_sum(difference, difference.size() / 40);
        };
        if (best.candidate.effects.empty()) {
            answer.outcome = Outcome::no_gap;
            answer.confidence = 0.9;
            return;
        }
        const Interval over_none = better_than(best, *none);
        if (over_none.mean < 8.0 || over_none.low < 0.0 || best.gap_after > 0.97 * answer.base_gap) {
            answer.outcome = Outcome::no_gap;
            answer.confidence = 0.8;
            return;
        }
        answer.effects.push_back(0);
        for (std::size_t i = 1; i < answer.ranking.size(); ++i) {
            const Ranked& other = answer.ranking[i];
            if (other.candidate.effects.size() != best.candidate.effects.size()) {
                continue;
            }
            const Interval over = better_than(best, other);
            if (over.mean < 6.0 || over.low < 0.0) {
                answer.effects.push_back(i);
            }
        }
        answer.outcome = answer.effects.size() == 1 ? Outcome::attributed : Outcome::ambiguous;
        answer.confidence = answer.effects.size() == 1 ? 0.9 : 0.6;
    }

    const Question& question_;
    const std::function<void(const std::string&)>& say_;
    std::optional<Study> study_;
    std::optional<Study> validation_;
    bool split_ = false;
};

}  // namespace

Answer diagnose(const Question& question, const std::function<void(const std::string&)>& say) {
    return Diagnosis(question, say).run();
}

}  // namespace gap
