// Where validation goes where training never was: what the training alone says, and when that is believed.
#include "gap/drive/within_training.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gap/drive/diagnose.hpp"

namespace {

using gap::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Nothing leaves 1, the effect `gap_after`.
gap::Answer answer_with(const std::string& effect, double gap_after, Outcome outcome, double confidence) {
    gap::Answer answer{};
    answer.ranking.resize(2);
    answer.ranking[0].gap_after = 1.0;
    answer.ranking[1].gap_after = gap_after;
    answer.ranking[1].trained.effects = {&gap::effect_named(effect)};
    answer.decision.outcome = outcome;
    answer.decision.confidence = confidence;
    answer.decision.chosen = 1;
    answer.decision.effects = {1};
    return answer;
}

gap::Answer unknown_across() {
    gap::Answer answer = answer_with("sensor_magnitude", 0.9, Outcome::unknown, 0.6);
    answer.decision.effects.clear();
    answer.decision.chosen = 0;
    answer.decision.noise_floor = 0.85;
    answer.extrapolated = {"input above 2", "falling output"};
    answer.next_experiment = "train on these, too";
    return answer;
}

TEST(WithinTraining, IsAskedWhereNothingExplainsWhatTrainingNeverSaw) {
    gap::Answer answer = unknown_across();
    EXPECT_TRUE(gap::goes_elsewhere(answer));
    for (const Outcome told : {Outcome::attributed, Outcome::ambiguous, Outcome::no_gap}) {
        answer.decision.outcome = told;
        EXPECT_FALSE(gap::goes_elsewhere(answer));
    }
    answer = unknown_across();
    answer.extrapolated.clear();
    EXPECT_FALSE(gap::goes_elsewhere(answer));
}

TEST(WithinTraining, AsksWithoutTheRecordsThatJudged) {
    gap::Question question{gap::form_to_find(), true, {}, {}, {}, gap::Metric::simulation, {}};
    gap::Record record;
    for (int i = 0; i < 100; ++i) {
        record.time_s.push_back(0.1 * i);
        record.input.push_back(i);
        record.output.push_back(2.0 * i);
    }
    record.usual_interval_s = 0.1;
    question.train = {record};
    question.validate = {record};
    EXPECT_THAT(gap::of_training_alone(question).validate, IsEmpty());
    EXPECT_EQ(gap::of_training_alone(question).train[0].size(), 100u);
    question.validate.clear();
    question.split_s = 4.05;
    const gap::Question alone = gap::of_training_alone(question);
    EXPECT_FALSE(alone.split_s);
    EXPECT_EQ(alone.train[0].size(), 41u);
    EXPECT_EQ(alone.train[0].time_s.back(), record.time_s[40]);
}

TEST(WithinTraining, IsBelievedWhereLastingCausesLeaveAFifth) {
    const auto told = [](const gap::Answer& within) { return gap::told_by_training(unknown_across(), within); };
    const gap::Answer answer = told(answer_with("sensor_magnitude", 0.199, Outcome::attributed, 0.8));
    EXPECT_EQ(answer.decision.outcome, Outcome::attributed);
    EXPECT_EQ(answer.decision.confidence, 0.7);
    EXPECT_THAT(answer.notes,
                ElementsAre(HasSubstr("which has input above 2 and falling output, 0.8500 is left of 1.0000")));
    EXPECT_THAT(answer.extrapolated, ElementsAre("input above 2", "falling output"));
    EXPECT_EQ(answer.next_experiment, "train on these, too");
    for (const gap::Answer& within : {
             answer_with("sensor_magnitude", 0.201, Outcome::attributed, 0.8),
             answer_with("sensor_magnitude", 0.199, Outcome::attributed, 0.79),
             answer_with("sensor_magnitude", 0.199, Outcome::ambiguous, 0.8),
             answer_with("load_disturbance", 0.199, Outcome::attributed, 0.8),
         }) {
        EXPECT_EQ(told(within).decision.outcome, Outcome::unknown);
        EXPECT_THAT(told(within).notes, IsEmpty());
    }
}

// A vessel that is full from the first samples on, with readings in steps: what is kept aside of it never moves. And
// with waves, which no effect makes.
gap::Record vessel(double low, double high, std::size_t hold, double wave) {
    gap::Record record;
    record.usual_interval_s = 0.5;
    double level = 2.7 * 4.9;
    for (std::size_t i = 0; i < 400; ++i) {
        const double input = (i / hold) % 2 == 0 ? high : low;
        record.time_s.push_back(0.5 * static_cast<double>(i));
        record.input.push_back(input);
        const double waves = wave * std::sin(0.8 * record.time_s.back()) * std::sin(0.043 * record.time_s.back());
        record.output.push_back(1.31 * std::round((level + waves) / 1.31));
        level += 0.5 / 10.0 * (2.7 * std::min(input, 6.3) - level);
    }
    return record;
}

TEST(WithinTraining, TrainingThatCannotJudgeLeavesTheAnswerAsItIs) {
    gap::Question question{gap::form_to_find(), true, {}, {}, {}, gap::Metric::simulation, {}};
    question.find = true;
    question.train = {vessel(7.0, 9.0, 50, 0.0)};
    question.validate = {vessel(2.0, 7.0, 60, 6.0)};
    std::string said;
    const gap::Answer answer = gap::diagnose(question, [&](const std::string& what) { said += what + "\n"; });
    EXPECT_THAT(said, HasSubstr("the training alone"));
    EXPECT_EQ(answer.decision.outcome, Outcome::unknown);
    EXPECT_THAT(answer.extrapolated, Not(IsEmpty()));
}

}  // namespace
