// A base with effects: which numbers it has, how far they may go, and what a scenario makes of them.
#include "gap/drive/candidate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gap/drive/start.hpp"
#include "tests/gap/stepped_study.hpp"

namespace {

using gap_test::lag;
using gap_test::Made;
using gap_test::stepped;
using testing::ElementsAre;

const gap::FreeParameter& named(const std::vector<gap::FreeParameter>& list, const std::string& name) {
    return *std::find_if(list.begin(), list.end(), [&](const gap::FreeParameter& one) { return one.name == name; });
}

void expect_range(const gap::FreeParameter& found, double value, double lower, double upper, double scale) {
    EXPECT_NEAR(found.value, value, 1e-12) << found.name;
    EXPECT_NEAR(found.lower, lower, 1e-12 * std::fabs(lower)) << found.name;
    EXPECT_NEAR(found.upper, upper, 1e-12 * std::fabs(upper)) << found.name;
    EXPECT_NEAR(found.scale, scale, 1e-12) << found.name;
}

TEST(CandidateBase, HasNoNumbersUnlessItIsFitted) {
    EXPECT_TRUE(gap::base_of(Made(lag(), {stepped()}, false).study).empty());
    const Made made(lag(), {stepped()}, true);
    const auto base = gap::base_of(made.study);
    ASSERT_EQ(base.size(), 3U);
    // Thirty times its size to either side, as far as the form allows.
    expect_range(named(base, "gain"), 2.0, -58.0, 62.0, 2.0);
    EXPECT_NEAR(named(base, "time_constant_s").upper, 93.0, 1e-9);
    EXPECT_GE(named(base, "time_constant_s").lower, 0.0);
    // A dead time up to a fifth of the record; of none the steps are a time constant.
    expect_range(named(base, "delay_s"), 0.0, 0.0, 6.0, 3.0);
}

TEST(CandidateState, OfARecordThatRestsIsItsLevel) {
    const Made made(lag(), {stepped()}, true);
    const auto state = gap::state_of(made.study, made.records.front());
    ASSERT_EQ(state.size(), 4U);
    const double known = 3.0 * 0.01 / std::sqrt(8.0);
    const double span = made.study.scales.output_span;
    expect_range(state[0], 1.0, 1.0 - known, 1.0 + known, span);
    EXPECT_EQ(state[0].name, "offset");
    expect_range(state[1], 1.0, 1.0 - known, 1.0 + known, span);
    EXPECT_EQ(state[1].name, "initial_output");
    EXPECT_FALSE(state[1].fixed);
    EXPECT_TRUE(state[2].fixed);
    EXPECT_TRUE(state[3].fixed);
}

TEST(CandidateState, IsFreeWhereNothingShowsThatItRests) {
    for (const bool brief : {true, false}) {
        gap::Record record = stepped(brief ? 7 : 8);
        if (!brief) {
            record.output[3] = 1.0 + 8.1 * 0.01;  // it moves
        }
        const Made made(lag(), {record}, true);
        const auto state = gap::state_of(made.study, made.records.front());
        const double span = made.study.scales.output_span;
        expect_range(state[0], 1.0, -1000.0 * span - 1.0, 1000.0 * span + 1.0, span);
        expect_range(state[1], 1.0, 1.0 - 3.0 * span, 1.0 + 3.0 * span, span);
        const double speed = made.study.scales.speed_max;
        expect_range(state[2], 0.0, -3.0 * speed, 3.0 * speed, speed);
        expect_range(state[3], 0.0, -2.0, 2.0, 2.0);
        EXPECT_FALSE(state[2].fixed || state[3].fixed);
    }
    // Eight times the noise is still.
    gap::Record still = stepped();
    still.output[3] = 1.0 + 7.9 * 0.01;
    EXPECT_TRUE(gap::state_of(Made(lag(), {still}, true).study, still)[2].fixed);
    // A record that is driven from its first sample on was somewhere else: it rests without input at 0.
    const gap::Record driven = stepped(0);
    EXPECT_EQ(gap::state_of(Made(lag(), {driven}, true).study, driven)[0].value, 0.0);
    // And what drives it did so before.
    ASSERT_NE(driven.input.front(), 0.0);
    EXPECT_EQ(gap::state_of(Made(lag(), {driven}, true).study, driven)[3].value, driven.input.front());
}

TEST(CandidateState, OfWhatIntegratesHasAForceOfItsOwn) {
    drive::Model model;
    model.gain = 3.0;
    model.denominator = {{1.0, 1.0}};
    const Made made(model, {stepped()}, true);
    const auto state = gap::state_of(made.study, made.records.front());
    EXPECT_EQ(state[0].name, "bias");
    expect_range(state[0], 0.0, -6.0, 6.0, 0.6);
    EXPECT_FALSE(state[2].fixed);
}

TEST(CandidateState, OfAFreeMotionRestsWhereItEnds) {
    gap::Record record = stepped();
    std::fill(record.input.begin(), record.input.end(), 0.0);
    const Made made(lag(), {record}, true);
    const auto state = gap::state_of(made.study, made.records.front());
    double last = 0.0;
    for (std::size_t i = 55; i <= 60; ++i) {
        last += record.output[i] / 6.0;
    }
    EXPECT_NEAR(state[0].value, last, 1e-12);
    EXPECT_EQ(state[1].value, 1.0);
    EXPECT_TRUE(state[3].fixed);  // there is no input before it
    EXPECT_FALSE(state[2].fixed);
}

TEST(CandidateEffects, BeginAtEachOfTheirStarts) {
    const Made made(lag(), {stepped()}, false);
    const gap::Scales& scales = made.study.scales;
    const gap::Effect& curve = gap::effect_named("output_curve");
    EXPECT_EQ(gap::starts_of(curve, scales), 4U);
    EXPECT_EQ(gap::starts_of(gap::effect_named("sensor_offset"), scales), 1U);
    EXPECT_TRUE(gap::applies(curve, scales));
    EXPECT_FALSE(gap::applies(gap::effect_named("second_input"), scales));
    const auto first = gap::parameters_of(curve, scales, 0);
    EXPECT_EQ(first[0].name, "output_curve.curvature");
    expect_range(first[0], -0.25, -0.9, 0.9, 0.25);
    expect_range(first[2], 0.0, 0.0, 1.0, 0.02);
    EXPECT_FALSE(first[0].fixed || first[1].fixed);
    EXPECT_TRUE(first[2].fixed);
    EXPECT_FALSE(gap::parameters_of(curve, scales, 1)[1].fixed);
    const auto third = gap::parameters_of(curve, scales, 2);
    EXPECT_FALSE(third[1].fixed);
    EXPECT_FALSE(third[0].fixed);
    EXPECT_EQ(third[2].value, 1.0);
    EXPECT_EQ(gap::parameters_of(curve, scales, 5)[0].value, 0.25);  // around
}

gap::Candidate both(const Made& made) {
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("load_disturbance"), &gap::effect_named("output_curve")};
    candidate.base = gap::base_of(made.study);
    candidate.lasting = {gap::parameters_of(*candidate.effects[1], made.study.scales, 0)};
    for (const gap::Record& record : made.records) {
        candidate.own.push_back(gap::state_of(made.study, record));
        const auto event = gap::parameters_of(*candidate.effects[0], made.study.scales, 0);
        candidate.own.back().insert(candidate.own.back().end(), event.begin(), event.end());
    }
    return candidate;
}

TEST(Candidate, CountsItsNumbers) {
    const Made made(lag(), {stepped(), stepped()}, true);
    gap::Candidate candidate = both(made);
    EXPECT_EQ(candidate.name(), "load_disturbance + output_curve");
    EXPECT_EQ(gap::Candidate{}.name(), "none");
    EXPECT_TRUE(candidate.has("output_curve"));
    EXPECT_FALSE(candidate.has("backlash"));
    EXPECT_EQ(candidate.event_parameters(), 6U);   // three in each record
    EXPECT_EQ(candidate.effect_parameters(), 5U);  // three, and two of the curve
    EXPECT_EQ(candidate.effect_parameters_in_all(), 8U);
    EXPECT_EQ(gap::Candidate{}.effect_parameters(), 0U);
    // The base's three, two of the curve, offset and output and event of each record.
    EXPECT_EQ(gap::free_numbers(candidate, false).size(), 3U + 2U + 2U * 5U);
    const auto own = gap::free_numbers(candidate, true);
    EXPECT_EQ(own.size(), 10U);
    EXPECT_EQ(own.front()->name, "offset");
    EXPECT_EQ(gap::free_numbers(candidate, false).front()->name, "gain");
    EXPECT_EQ(gap::free_numbers(candidate, false)[3]->name, "output_curve.curvature");
}

TEST(Candidate, IsAScenarioOfItsNumbers) {
    const Made made(lag(), {stepped(), stepped()}, true);
    gap::Candidate candidate = both(made);
    candidate.base[0].value = 7.0;
    candidate.own[1][0].value = 0.25;
    candidate.own[1][1].value = 0.75;
    candidate.own[1][2].value = -0.5;
    candidate.own[1][3].value = 1.5;
    candidate.own[1][4].value = 2.0;
    candidate.own[1][5].value = 3.0;
    candidate.own[1][6].value = 0.125;
    candidate.lasting[0][2].value = 1.0;
    const gap::Scenario scenario = gap::scenario_of(made.study, candidate, 1);
    EXPECT_NEAR(drive::static_gain(scenario.model), 7.0, 1e-12);
    EXPECT_EQ(scenario.operating_output, 0.25);
    EXPECT_EQ(scenario.initial_output, 0.5);  // beside it
    EXPECT_EQ(scenario.initial_velocity, -0.5);
    EXPECT_EQ(scenario.input_before, 1.5);
    ASSERT_EQ(scenario.forces.pushes.size(), 1U);
    EXPECT_EQ(scenario.forces.pushes[0].from_s, 2.0);
    EXPECT_EQ(scenario.forces.pushes[0].to_s, 3.0);
    EXPECT_EQ(scenario.forces.pushes[0].size, 0.125);
    ASSERT_TRUE(scenario.forces.outflow);
    EXPECT_EQ(scenario.forces.outflow->curvature, -0.25);
    const drive::Form filled = gap::with_values(made.study.base.form, candidate);
    EXPECT_EQ(drive::Form(filled).parameter("gain").value, 7.0);
    EXPECT_EQ(drive::Form(filled).parameter("time_constant_s").value, 3.0);
}

// A prediction goes on from the reading a horizon ago; before that from the first.
TEST(Candidate, LeavesWhatIsMeasuredLessSimulated) {
    Made made(lag(), {stepped()}, false);
    gap::Candidate none;
    none.own.resize(1);
    const auto simulated = gap::simulate(gap::scenario_of(made.study, none, 0), made.study.courses[0]);
    const auto left = gap::residuals_of(made.study, none, 0);
    const auto& z = made.records[0].output;
    for (std::size_t i = 0; i < z.size(); ++i) {
        EXPECT_NEAR(left[i], z[i] - simulated[i], 1e-12) << i;
    }
    made.study.horizon = 4;
    const auto ahead = gap::residuals_of(made.study, none, 0);
    for (std::size_t i = 0; i < z.size(); ++i) {
        EXPECT_NEAR(ahead[i], left[i] - left[i > 4 ? i - 4 : 0], 1e-12) << i;
    }
    EXPECT_THAT(gap::all_residuals(made.study, none), ElementsAre(ahead));
}

// A given model's output is about its operating point.
TEST(Candidate, OfAGivenModelIsAboutItsOperatingPoint) {
    Made made(lag(), {stepped()}, false);
    made.study.base.operating_output = 5.0;
    gap::Candidate none;
    none.own.resize(1);
    EXPECT_EQ(gap::scenario_of(made.study, none, 0).operating_output, 5.0);
    EXPECT_EQ(gap::scenario_of(made.study, none, 0).initial_output, 0.0);
}

}  // namespace
