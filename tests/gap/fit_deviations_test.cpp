// Deviations of what was fitted: a straight line through noise, whose slope's is known.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "gap/drive/determined.hpp"
#include "gap/drive/deviations.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/start.hpp"
#include "tests/gap/stepped_study.hpp"

namespace {

using gap_test::lag;
using gap_test::Made;
using gap_test::stepped;

TEST(FitDeviations, OfAGainAreThoseOfALine) {
    std::vector<gap::Record> records = {stepped(0)};
    gap::Record& record = records[0];
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.input[i] = 0.1 * static_cast<double>(i % 7);
    }
    drive::Model model = drive::make_fopdt(2.0, 0.01, 0.0);
    Made made(model, records, false);
    const gap::Effect& gain = gap::effect_named("sensor_drift");
    gap::Candidate candidate;
    candidate.effects = {&gain};
    candidate.own.resize(1);
    candidate.lasting = {gap::parameters_of(gain, made.study.scales, 0)};
    candidate.lasting[0][0].value = 0.03;
    const auto simulated = gap::simulate(gap::scenario_of(made.study, candidate, 0), made.study.courses[0]);
    // Residuals of 0.02 that turn from sample to sample: blocks of them hardly pull.
    double squares = 0.0;
    for (std::size_t i = 0; i < record.size(); ++i) {
        made.records[0].output[i] = simulated[i] + (i % 2 == 0 ? 0.02 : -0.02);
        squares += record.time_s[i] * record.time_s[i];
    }
    gap::add_deviations(made.study, candidate, nullptr);
    const double n = static_cast<double>(record.size());
    const double expected = std::sqrt(0.02 * 0.02 * n / (n - 1.0) / squares);
    EXPECT_NEAR(candidate.lasting[0][0].deviation, expected, 0.02 * expected);
    EXPECT_FALSE(candidate.lasting[0][0].moves_nothing);
    // What says the same again and again tells less than so many samples: the pull of blocks is larger.
    for (std::size_t i = 0; i < record.size(); ++i) {
        made.records[0].output[i] = simulated[i] + (i < 30 ? 0.02 : -0.02);
    }
    gap::add_deviations(made.study, candidate, nullptr);
    EXPECT_GT(candidate.lasting[0][0].deviation, 1.3 * expected);
    // A perfect simulation of rounded readings: as far off as these are, at least.
    for (std::size_t i = 0; i < record.size(); ++i) {
        made.records[0].output[i] = simulated[i];
    }
    gap::add_deviations(made.study, candidate, nullptr);
    EXPECT_NEAR(candidate.lasting[0][0].deviation, 0.004 / std::sqrt(squares), 1e-3 * expected);
}

TEST(FitDeviations, OfWhatNothingTellsAreInfinite) {
    const Made made(lag(), {stepped()}, false);
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("input_saturation")};
    candidate.own.resize(1);
    candidate.lasting = {gap::parameters_of(*candidate.effects[0], made.study.scales, 0)};
    candidate.lasting[0][0].value = 2.0;  // what it never reaches beyond
    candidate.lasting[0][0].upper = 9.0;
    gap::add_deviations(made.study, candidate, nullptr);
    EXPECT_TRUE(std::isinf(candidate.lasting[0][0].deviation));
    EXPECT_TRUE(candidate.lasting[0][0].moves_nothing);
    // Two numbers of which the sum alone tells.
    gap::Candidate two;
    two.effects = {&gap::effect_named("sensor_offset"), &gap::effect_named("sensor_offset")};
    two.own.resize(1);
    two.lasting = {gap::parameters_of(*two.effects[0], made.study.scales, 0),
                   gap::parameters_of(*two.effects[0], made.study.scales, 0)};
    gap::add_deviations(made.study, two, nullptr);
    EXPECT_FALSE(two.lasting[0][0].moves_nothing);
    EXPECT_GT(two.lasting[0][0].deviation, 0.0);
    // Half of each lies in their difference.
    EXPECT_THAT(gap::untold_shares(made.study, two),
                testing::ElementsAre(testing::DoubleNear(0.5, 1e-6), testing::DoubleNear(0.5, 1e-6)));
    EXPECT_TRUE(gap::leaves_open(made.study, two));
    two.effects.pop_back();
    two.lasting.pop_back();
    EXPECT_THAT(gap::untold_shares(made.study, two), testing::ElementsAre(0.0));
    EXPECT_FALSE(gap::leaves_open(made.study, two));
}

// Friction of two levels beside an operating point: what one has more than the other moves the point, unless the record
// shows it by resting, and goes both ways.
TEST(FitDeviations, OfTwoLevelsOfFrictionAreOfTheirMean) {
    gap::Record both_ways = stepped();
    for (std::size_t i = 8; i < both_ways.size(); ++i) {
        both_ways.input[i] = i < 20 ? 2.0 : i < 32 ? 0.5 : i < 44 ? 3.0 : 1.0;
    }
    Made made(lag(), {both_ways}, true);
    gap::Candidate uneven;
    uneven.effects = {&gap::effect_named("direction_dependent_friction")};
    uneven.base = gap::base_of(made.study);
    uneven.own = {gap::state_of(made.study, made.records[0])};
    uneven.lasting = {gap::parameters_of(*uneven.effects[0], made.study.scales, 2)};
    const std::vector<double> left = gap::residuals_of(made.study, uneven, 0);
    for (std::size_t i = 0; i < left.size(); ++i) {
        made.records[0].output[i] -= left[i];
    }
    EXPECT_FALSE(gap::leaves_open(made.study, uneven));
    gap::FreeParameter& offset = uneven.own[0][0];
    offset.lower = -10.0;
    offset.upper = 10.0;
    EXPECT_TRUE(gap::leaves_open(made.study, uneven));
}

// One step up hardly parts a force from the gain: by less than a hundredth.
TEST(FitDeviations, OfAForceAndAGainAreHardlyToldByAStep) {
    const Made made(lag(), {stepped()}, true);
    gap::Candidate even;
    even.effects = {&gap::effect_named("coulomb_friction")};
    even.base = gap::base_of(made.study);
    even.own = {gap::state_of(made.study, made.records[0])};
    even.lasting = {gap::parameters_of(*even.effects[0], made.study.scales, 1)};
    for (gap::FreeParameter& own : even.own[0]) {
        own.fixed = true;  // the record shows them by resting
    }
    const auto open = [&](double untold) {
        const auto shares = gap::untold_shares(made.study, even, untold);
        return std::ranges::any_of(shares, [](double share) { return share > 0.05; });
    };
    EXPECT_TRUE(gap::leaves_open(made.study, even));
    EXPECT_TRUE(open(1e-4));
    EXPECT_FALSE(open(0.0));
}

}  // namespace
