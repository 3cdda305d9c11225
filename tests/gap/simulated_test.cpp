// The user's own simulation as the base.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/failure.hpp"
#include "gap/drive/base/find.hpp"
#include "stand_case.hpp"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double ambient = 0.4;  // what the user's simulator, and the rig, begin from

// A log of a stand, and beside it what a simulator without the effect gave for the same input.
gap::Record beside(const gap_test::Sizes& sizes, const gap_test::Run& run) {
    gap::Record record = gap_test::log_of(sizes, run);
    gap_test::Run quiet = run;
    quiet.noise_rad = 0.0;
    record.simulated = gap_test::log_of({}, quiet).output;
    for (auto* values : {&record.output, &record.simulated}) {
        for (double& value : *values) {
            value += ambient;
        }
    }
    return record;
}

gap::Question question_of(const gap_test::Sizes& sizes) {
    gap::Question question{gap::form_to_find(),
                           true,
                           {beside(sizes, {.seed = 21})},
                           {beside(sizes, {.experiment = "prbs", .low_duty = 0.02, .seed = 22})},
                           {},
                           gap::Metric::simulation,
                           {},
                           2};
    question.find = true;
    return question;
}

double rms_over_deviation(const gap::Record& record) {
    double mean = 0.0;
    double left = 0.0;
    double spread = 0.0;
    for (const double z : record.output) {
        mean += z / static_cast<double>(record.size());
    }
    for (std::size_t i = 0; i < record.size(); ++i) {
        left += std::pow(record.output[i] - record.simulated[i], 2);
        spread += std::pow(record.output[i] - mean, 2);
    }
    return std::sqrt(left / spread);
}

TEST(Simulated, IsTheBaseToTheLastDigitAndItsEffectIsNamed) {
    const gap::Question question = question_of({{"backlash.gap", 0.06}});
    const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
    EXPECT_NEAR(answer.decision.base_gap, rms_over_deviation(question.validate.front()), 1e-9);
    EXPECT_THAT(gap_test::names(answer), ElementsAre("backlash"));
    EXPECT_THAT(answer.notes, testing::Contains(HasSubstr("a model reproduces the simulation but for 0.")));
}

TEST(Simulated, HasNoGapWhereItIsTheRig) {
    EXPECT_EQ(gap::diagnose(question_of({}), [](const std::string&) {}).decision.outcome, gap::Outcome::no_gap);
}

TEST(Simulated, IsAskedOfEveryLog) {
    gap::Question question = question_of({});
    question.validate.front().simulated.clear();
    try {
        (void)gap::diagnose(question, [](const std::string&) {});
        FAIL() << "expected a refusal";
    } catch (const glsum::Failure& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("in every log, found it in 1 of 2"));
    }
}

}  // namespace
