// Where validation goes where training never was: what the training alone says, and when that is believed.
#include "gap/drive/within_training.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using gap::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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

TEST(WithinTraining, IsBelievedWhereLastingCausesLeaveAQuarter) {
    const auto told = [](const gap::Answer& within) { return gap::told_by_training(unknown_across(), within); };
    const gap::Answer answer = told(answer_with("sensor_magnitude", 0.249, Outcome::attributed, 0.8));
    EXPECT_EQ(answer.decision.outcome, Outcome::attributed);
    EXPECT_EQ(answer.decision.confidence, 0.7);
    EXPECT_THAT(answer.notes,
                ElementsAre(HasSubstr("which has input above 2 and falling output, 0.8500 is left of 1.0000")));
    EXPECT_THAT(answer.extrapolated, ElementsAre("input above 2", "falling output"));
    EXPECT_EQ(answer.next_experiment, "train on these, too");
    for (const gap::Answer& within : {
             answer_with("sensor_magnitude", 0.251, Outcome::attributed, 0.8),
             answer_with("sensor_magnitude", 0.249, Outcome::attributed, 0.79),
             answer_with("sensor_magnitude", 0.249, Outcome::ambiguous, 0.8),
             answer_with("load_disturbance", 0.249, Outcome::attributed, 0.8),
         }) {
        EXPECT_EQ(told(within).decision.outcome, Outcome::unknown);
        EXPECT_THAT(told(within).notes, IsEmpty());
    }
}

}  // namespace
