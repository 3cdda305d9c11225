// Events that begin with the input, or never end, are none.
#include "gap/drive/outside.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "gap/drive/verdict.hpp"
#include "stand_case.hpp"

namespace {

// 20 s at 100 Hz; the input steps up at 5 s and down at 12 s.
gap::Record stepped() {
    gap::Record record;
    for (int i = 0; i <= 2000; ++i) {
        record.time_s.push_back(100.0 + 0.01 * i);
        record.input.push_back(i >= 500 && i < 1200 ? 1.0 : 0.0);
    }
    record.usual_interval_s = 0.01;
    return record;
}

TEST(Outside, ChanceIsTheShareOfTheRecordThatIsAsNear) {
    const gap::Record record = stepped();
    EXPECT_NEAR(gap::chance_of_meeting(record, 5.1, 0.0), 4 * 0.1 / 20.0, 1e-9);
    EXPECT_NEAR(gap::chance_of_meeting(record, 5.6, 0.5), 4 * 0.1 / 20.0, 1e-9);    // a dead time later
    EXPECT_NEAR(gap::chance_of_meeting(record, 11.9, 0.0), 4 * 0.1 / 20.0, 1e-9);   // before counts as after
    EXPECT_NEAR(gap::chance_of_meeting(record, 5.0, 0.0), 4 * 0.005 / 20.0, 1e-9);  // no nearer than half an interval
    // Windows meet in the middle, and end with the record.
    EXPECT_NEAR(gap::chance_of_meeting(record, 9.0, 0.0), (6.0 + 6.0) / 20.0, 1e-9);
    EXPECT_NEAR(gap::chance_of_meeting(record, 1.0, 0.0), 15.0 / 20.0, 1e-9);
    EXPECT_NEAR(gap::chance_of_meeting(record, 19.0, 0.0), 1.0, 0.06);
    gap::Record still = record;
    still.input.assign(still.input.size(), 0.0);
    EXPECT_EQ(gap::chance_of_meeting(still, 5.0, 0.0), 1.0);
}

TEST(Outside, JointChanceIsFishers) {
    EXPECT_DOUBLE_EQ(gap::joint_chance(std::vector{0.3}), 0.3);
    // Of two: p (1 - ln p), p their product.
    EXPECT_NEAR(gap::joint_chance(std::vector{0.1, 0.05}), 0.005 * (1.0 - std::log(0.005)), 1e-12);
    EXPECT_DOUBLE_EQ(gap::joint_chance(std::vector{1.0, 1.0, 1.0}), 1.0);
    EXPECT_EQ(gap::joint_chance({}), 1.0);
}

TEST(Outside, WhatLastsThroughoutIsNoEvent) {
    const gap::Record record = stepped();
    EXPECT_TRUE(gap::lasts_throughout(record, {5.4, 20.0}, 0.5));
    EXPECT_TRUE(gap::lasts_throughout(record, {0.0, 19.7}, 0.5));
    EXPECT_FALSE(gap::lasts_throughout(record, {5.6, 20.0}, 0.5));
    EXPECT_FALSE(gap::lasts_throughout(record, {5.4, 19.5}, 0.5));
    EXPECT_FALSE(gap::lasts_throughout(record, {5.4, std::nullopt}, 0.5));  // a jump
    // To within a fiftieth of the record's end, from before the first move has settled.
    EXPECT_TRUE(gap::lasts_throughout(record, {5.4, 0.981 * 20.0}, 0.5));
    EXPECT_FALSE(gap::lasts_throughout(record, {5.4, 0.979 * 20.0}, 0.5));
    EXPECT_TRUE(gap::lasts_throughout(record, {5.499, 20.0}, 0.5));
    EXPECT_FALSE(gap::lasts_throughout(record, {5.501, 20.0}, 0.5));
    gap::Record still = record;
    still.input.assign(still.input.size(), 0.0);
    EXPECT_TRUE(gap::lasts_throughout(still, {0.4, 20.0}, 0.5));
    EXPECT_FALSE(gap::lasts_throughout(still, {0.6, 20.0}, 0.5));
}

TEST(Outside, WhatIsThereBeforeTheInputCanActIsThePast) {
    const auto acts_before = [](double from_s, bool at_rest) {
        const std::vector<gap::FreeParameter> own{
            {.name = "offset", .value = 0.0, .lower = -1.0, .upper = 1.0, .scale = 1.0},
            {.name = "initial_output", .value = 0.3, .lower = -1.0, .upper = 1.0, .scale = 1.0, .fixed = at_rest}};
        return gap::acts_before_the_input(own, {from_s, 2.0}, 0.5);
    };
    EXPECT_TRUE(acts_before(0.0, false));
    EXPECT_TRUE(acts_before(0.499, false));
    EXPECT_FALSE(acts_before(0.5, false));
    EXPECT_FALSE(acts_before(0.1, true));  // from rest there is no past
}

// A move is of more than 3 % of the greatest input, whatever its sign; the record's begin is one.
TEST(Outside, SmallStepsAreNoMoves) {
    gap::Record record = stepped();
    const auto chance_at = [&](double time_s) { return gap::chance_of_meeting(record, time_s, 0.0); };
    const double without = chance_at(16.0);
    const auto add_from_15_s = [&](double by) {
        record = stepped();
        for (std::size_t i = 1500; i < record.size(); ++i) {
            record.input[i] += by;
        }
        return chance_at(16.0);
    };
    EXPECT_EQ(add_from_15_s(0.029), without);
    EXPECT_EQ(add_from_15_s(-0.029), without);
    EXPECT_NEAR(add_from_15_s(0.031), 6.0 / 20.0, 1e-9);  // within a second of one of three moves
    EXPECT_NEAR(add_from_15_s(-0.031), 6.0 / 20.0, 1e-9);
    record = stepped();
    for (double& u : record.input) {
        u = 1.0 - u;  // it is on as the record begins
    }
    EXPECT_NEAR(chance_at(1.0), 5.0 / 20.0, 1e-9);
}

// A spring that is harder the further it is bent: under one level a force as long as the level.
TEST(Verdict, OfAForceThatComesWithTheInputIsUnknown) {
    const auto verdict = [](double from_s, double to_s) {
        gap::Question question = gap_test::question_of({}, {.experiment = "step", .seed = 65},
                                                       {.experiment = "step", .duty = 0.08, .seed = 66});
        for (auto* records : {&question.train, &question.validate}) {
            gap::Record& record = records->front();
            const gap::Course course(record, 4);
            gap::Scenario plain;
            plain.model = gap::model_of(gap_test::linear_form());
            gap::Scenario pushed = plain;
            pushed.forces.pushes.push_back({from_s, to_s, -0.004});
            const std::vector<double> usual = gap::simulate(plain, course);
            const std::vector<double> moved = gap::simulate(pushed, course);
            for (std::size_t i = 0; i < record.size(); ++i) {
                record.output[i] += moved[i] - usual[i];
            }
        }
        return gap::diagnose(question, [](const std::string&) {});
    };
    const gap::Answer event = verdict(7.0, 9.0);
    EXPECT_EQ(gap_test::names(event), std::vector<std::string>{"load_disturbance"}) << gap::to_text(event);
    const gap::Answer always = verdict(0.15, 1.2);
    EXPECT_NE(always.decision.outcome, gap::Outcome::attributed) << gap::to_text(always);
}

}  // namespace
