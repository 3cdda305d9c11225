// The static characteristic from logs with holds.
#include "drive/static_characteristic.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
