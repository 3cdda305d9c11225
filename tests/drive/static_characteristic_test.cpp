// The static characteristic from logs with holds.
#include "drive/static_characteristic.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/failure.hpp"
#include "drive/stand/experiment.hpp"

namespace {

// Levels 0.1, 0.2, 0.1 for 10 s each; output 2 u^2 with a lag of 0.5 s.
drive::Log staircase(double lag_s) {
    drive::Log log;
    log.name = "made";
    double y = 0.0;
    for (int k = 0; k < 3000; ++k) {
        log.time_s.push_back(0.01 * k);
        log.input.push_back(k / 1000 == 1 ? 0.2 : 0.1);
        y += (2.0 * log.input.back() * log.input.back() - y) * -std::expm1(-0.01 / lag_s);
        log.output.push_back(y);
    }
    return log;
}

TEST(StaticCharacteristic, IsTheMeanAtTheEndOfEachHold) {
    const auto found = drive::static_characteristic(staircase(0.5), 1.0);
    ASSERT_EQ(found.levels.size(), 3U);
    EXPECT_NEAR(found.levels[0].output, 0.02, 1e-6);
    EXPECT_NEAR(found.levels[1].output, 0.08, 1e-6);
    EXPECT_NEAR(found.levels[2].output, 0.02, 1e-6);
    EXPECT_TRUE(found.levels[1].rising);
    EXPECT_FALSE(found.levels[2].rising);
    EXPECT_TRUE(found.levels[2].settled);
    EXPECT_NEAR(found.slope, 0.6, 1e-4);
    EXPECT_NEAR(found.largest_bend, 0.0, 1e-4);
    EXPECT_NEAR(found.levels[1].from_s, 10.0, 1e-9);
    EXPECT_NEAR(found.levels[1].to_s, 20.0, 1e-9);
}

TEST(StaticCharacteristic, TellsWhatHasNotSettled) {
    const auto found = drive::static_characteristic(staircase(5.0), 1.0);
    EXPECT_FALSE(found.levels[0].settled && found.levels[1].settled);
    EXPECT_THROW((void)drive::static_characteristic(staircase(0.5), 11.0), glsum::Failure);
    drive::Log ramp = staircase(0.5);
    for (std::size_t k = 0; k < ramp.input.size(); ++k) {
        ramp.input[k] = 1e-4 * static_cast<double>(k);
    }
    EXPECT_THROW((void)drive::static_characteristic(ramp, 1.0), glsum::Failure);
    ramp.input.clear();
    EXPECT_THROW((void)drive::static_characteristic(ramp, 1.0), glsum::Failure);
}

// The stand's own: the sine of the angle is the thrust over the weight, the thrust the square of the speed.
TEST(StaticCharacteristic, OfTheStandIsThatOfItsPhysics) {
    stand::Stand built;
    for (const std::string& effect : stand::effects()) {
        stand::remove_effect(built, effect);
    }
    built.thrust_curvature = 1.0;
    built.sine_per_unit = 1.0;
    const auto record = stand::run(built, {.name = "staircase", .duty = 0.28, .until_s = 160.0}, 1);
    const auto found = drive::static_characteristic(drive::parse_log(stand::to_csv(record, false), "stand"), 5.0);
    ASSERT_EQ(found.levels.size(), 8U);  // 4 up, 3 down, and 0
    for (const drive::Level& level : found.levels) {
        EXPECT_NEAR(level.output, std::asin(level.input * level.input * built.full_torque_n_m() / built.gravity_n_m),
                    1e-4);
    }
    EXPECT_GT(found.largest_bend, 0.05);
}

// A second between samples; each hold is an input, how many samples, and what its samples read.
struct Hold {
    double input;
    int samples;
    std::function<double(int)> reads;
};
drive::Log holds(const std::vector<Hold>& all) {
    drive::Log log;
    log.name = "made";
    for (const Hold& hold : all) {
        for (int k = 0; k < hold.samples; ++k) {
            log.time_s.push_back(static_cast<double>(log.time_s.size()));
            log.input.push_back(hold.input);
            log.output.push_back(hold.reads(k));
        }
    }
    return log;
}
std::function<double(int)> constant(double value) {
    return [=](int) { return value; };
}

// Of 64 samples the last 16: here 3 above and 3 below 50 in turn, about two means that are `apart`, one of each eighth.
Hold judged(double apart) {
    return {1.0, 64, [=](int k) {
                if (k < 48) {
                    return k < 24 ? 0.0 : 100.0;
                }
                return 50.0 + (k < 56 ? -0.5 : 0.5) * apart + (k % 2 == 0 ? 3.0 : -3.0);
            }};
}

TEST(StaticCharacteristic, JudgesAHoldByItsLastQuarter) {
    const auto level = [](double apart) {
        return drive::static_characteristic(holds({judged(apart), {2.0, 64, constant(0.0)}}), 60.0).levels.at(0);
    };
    EXPECT_EQ(level(0.0).output, 50.0);
    EXPECT_NEAR(level(0.0).deviation, 3.0 * std::sqrt(16.0 / 15.0), 1e-12);
    EXPECT_EQ(level(0.0).drift, 0.0);
    // A fiftieth of the range of 100 is settled.
    EXPECT_EQ(level(2.0).drift, 2.0);
    EXPECT_TRUE(level(2.0).settled);
    EXPECT_TRUE(level(-2.0).settled);
    EXPECT_FALSE(level(2.001).settled);
    EXPECT_FALSE(level(-2.001).settled);
}

TEST(StaticCharacteristic, PassesOverWhatIsShort) {
    const auto levels = [](int samples, double shortest_s) {
        return drive::static_characteristic(holds({{1.0, samples, constant(0.0)}, {2.0, 40, constant(1.0)}}),
                                            shortest_s)
            .levels.size();
    };
    EXPECT_EQ(levels(16, 1.0), 2U);
    EXPECT_EQ(levels(15, 1.0), 1U);
    EXPECT_EQ(levels(20, 20.0), 2U);  // to where the next begins
    EXPECT_EQ(levels(20, 20.5), 1U);
    try {
        // The last ends with the log, 39 s from its first sample.
        (void)levels(20, 39.5);
        FAIL();
    } catch (const glsum::Failure& failure) {
        EXPECT_THAT(failure.what(), testing::HasSubstr("at least 39.5 s and 16 samples, the longest has 39 s"));
    }
}

// By hand: 0, 1 and 0 at the inputs 0, 1 and 2 lie about 1 / 3, the second by 2 / 3.
TEST(StaticCharacteristic, DrawsALineThroughWhatSettled) {
    const auto found = drive::static_characteristic(
        holds({{0.0, 32, constant(0.0)}, {1.0, 32, constant(1.0)}, {2.0, 32, constant(0.0)}}), 10.0);
    EXPECT_NEAR(found.slope, 0.0, 1e-12);
    EXPECT_NEAR(found.intercept, 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(found.largest_bend, 2.0 / 3.0, 1e-12);
    // What moves on to the end has no part in it: 4 and 10 at 1 and 3.
    const auto rest = drive::static_characteristic(
        holds({{1.0, 32, constant(4.0)}, {2.0, 32, [](int k) { return 1.0 * k; }}, {3.0, 32, constant(10.0)}}), 10.0);
    EXPECT_FALSE(rest.levels[1].settled);
    EXPECT_NEAR(rest.slope, 3.0, 1e-12);
    EXPECT_NEAR(rest.intercept, 1.0, 1e-12);
    EXPECT_NEAR(rest.largest_bend, 0.0, 1e-12);
    // Of one level nothing is known but that.
    const auto one = drive::static_characteristic(holds({{2.0, 32, constant(5.0)}}), 10.0);
    EXPECT_EQ(one.slope, 0.0);
    EXPECT_EQ(one.intercept, 5.0);
    EXPECT_EQ(one.largest_bend, 0.0);
    EXPECT_TRUE(one.levels[0].rising);  // from 0
}

TEST(StaticCharacteristic, IsToldInATableAndInCsv) {
    drive::StaticCharacteristic found;
    found.levels = {{0.25, 1.5, 0.125, 10.0, 20.5, 0.0, true, true}, {0.5, 3.0, 0.25, 20.5, 30.0, -0.75, false, false}};
    found.slope = 6.5;
    found.intercept = -0.5;
    found.largest_bend = 0.0625;
    EXPECT_EQ(
        drive::to_csv(found),
        "input,output,deviation,from_s,to_s,settled,rising\n0.25,1.5,0.125,10,20.5,1,1\n0.5,3,0.25,20.5,30,0,0\n");
    const std::string text = drive::to_text(found);
    EXPECT_THAT(text, testing::ContainsRegex("0.25 +1.5 +0.1[23] +10.00 +20.50  up\n"));
    EXPECT_THAT(text, testing::ContainsRegex("0.5 +3 +0.25 +20.50 +30.00  down, not settled: still moves by -0.75\n"));
    EXPECT_THAT(text,
                testing::HasSubstr("straight line -0.5 + 6.5 input; the output bends away from it by up to 6.2 %"));
    // A picture has the settled ones alone.
    const std::string script = drive::picture_of_characteristic(found, "made").script;
    EXPECT_THAT(script, testing::HasSubstr("$up << EOD\n0.25 1.5 0.125\nEOD\n$down << EOD\nEOD\n"));
    EXPECT_THAT(script, testing::HasSubstr("plot -0.5 + 6.5 * x with lines"));
}

}  // namespace
