// What the virtual stand can be asked for: each limit from both sides, and what a sample is of what happened.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/failure.hpp"
#include "drive/stand/experiment.hpp"

namespace {

using stand::Experiment;

constexpr double interval_s = 0.01;

bool taken(const std::function<void(Experiment&)>& change) {
    Experiment experiment;
    change(experiment);
    try {
        stand::check(experiment, interval_s);
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return false;
    }
    return true;
}

TEST(StandExperiment, IsTakenToItsEndsAndNotBeyond) {
    EXPECT_TRUE(taken([](Experiment&) {}));
    for (const char* name : {"step", "pulse", "staircase", "ramp", "chirp", "prbs", "release"}) {
        EXPECT_TRUE(taken([&](Experiment& e) { e.name = name; })) << name;
    }
    EXPECT_FALSE(taken([](Experiment& e) { e.name = "steps"; }));
    // Two samples to a million.
    EXPECT_TRUE(taken([](Experiment& e) { e.until_s = interval_s; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.until_s = 0.999 * interval_s; }));
    EXPECT_TRUE(taken([](Experiment& e) { e.until_s = 0.9999999e6 * interval_s; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.until_s = 1.000001e6 * interval_s; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.until_s = std::nan(""); }));
    // 0 <= low < high <= 1.
    EXPECT_TRUE(taken([](Experiment& e) { e.duty = 1.0; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.duty = 1.001; }));
    EXPECT_TRUE(taken([](Experiment& e) { e.low_duty = 0.26; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.low_duty = e.duty; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.low_duty = -0.001; }));
    // A stair at least, bits no shorter than an interval, frequencies that rise, below half the rate.
    EXPECT_TRUE(taken([](Experiment& e) { e.stairs = 1; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.stairs = 0; }));
    EXPECT_TRUE(taken([](Experiment& e) { e.bit_s = interval_s; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.bit_s = 0.999 * interval_s; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.from_hz = 0.0; }));
    EXPECT_TRUE(taken([](Experiment& e) { e.from_hz = 1e-9; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.to_hz = e.from_hz; }));
    EXPECT_TRUE(taken([](Experiment& e) { e.to_hz = 49.99; }));
    EXPECT_FALSE(taken([](Experiment& e) { e.to_hz = 50.0; }));
}

// The last stamp may lie behind the end, where a ramp is down again.
TEST(StandExperiment, NoDutyIsBelowTheLowestOrAboveTheHighest) {
    for (const char* name : {"step", "pulse", "staircase", "ramp", "chirp", "prbs", "release"}) {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const Experiment asked{.name = name, .until_s = 1.0};
            for (const double duty : stand::run({}, asked, seed).duty) {
                EXPECT_TRUE(duty >= 0.0 && duty <= asked.duty) << name << ": " << duty;
            }
        }
    }
}

stand::Stand held_still() {
    stand::Stand built;
    for (const std::string& effect : stand::effects()) {
        stand::remove_effect(built, effect);
    }
    built.spread_s = 0.0;
    built.friction = 10.0;  // nothing moves it
    return built;
}

std::vector<double> angles(const stand::Stand& built, double until_s = 20.0) {
    return stand::run(built, {.name = "step", .until_s = until_s}, 3).angle_rad;
}

// Offset and drift, then noise, then the sensor's ends, then whole counts, then counts that are lost.
TEST(StandExperiment, ASampleGoesThroughTheSensorsFaultsInTheirOrder) {
    stand::Stand built = held_still();
    EXPECT_EQ(angles(built), std::vector<double>(2001, 0.0));
    built.offset_rad = 0.05;
    built.drift_rad_per_s = 0.01;
    const auto drifting = angles(built);
    for (std::size_t k = 0; k < drifting.size(); ++k) {
        EXPECT_NEAR(drifting[k], 0.05 + 0.01 * 0.01 * static_cast<double>(k), 1e-12);
    }
    built.sensor_limit_rad = 0.131;
    built.encoder_step_rad = 0.02;
    const auto counted = angles(built);
    for (std::size_t k = 0; k < counted.size(); ++k) {
        EXPECT_NEAR(counted[k], 0.02 * std::round(std::min(drifting[k], 0.131) / 0.02), 1e-12) << k;
    }
    built.missed_counts = 3.0;
    built.missed_at_s = 10.0;
    const auto missed = angles(built);
    for (std::size_t k = 0; k < missed.size(); ++k) {
        EXPECT_NEAR(missed[k], counted[k] - (k >= 1000 ? 0.06 : 0.0), 1e-12) << k;  // from that sample on
    }
    built.encoder_step_rad = 0.0;  // then in units of the reading
    EXPECT_NEAR(angles(built)[1500], 0.131 - 3.0, 1e-12);
    built = held_still();
    built.offset_rad = -0.5;
    built.sensor_limit_rad = 0.25;  // either side
    EXPECT_EQ(angles(built)[7], -0.25);
}

TEST(StandExperiment, NoiseAndDroppedSamplesAreAsLargeAsAsked) {
    stand::Stand built = held_still();
    built.noise_rad = 0.02;
    const auto noisy = angles(built, 100.0);
    double sum = 0.0;
    double square = 0.0;
    for (const double z : noisy) {
        sum += z / static_cast<double>(noisy.size());
        square += z * z / static_cast<double>(noisy.size());
    }
    EXPECT_NEAR(sum, 0.0, 4.0 * 0.02 / 100.0);
    EXPECT_NEAR(std::sqrt(square) / 0.02, 1.0, 4.0 / std::sqrt(2.0 * 10001.0));
    built.dropped_rate = 0.3;
    const auto dropped = angles(built, 100.0);
    double held = 0.0;
    for (std::size_t k = 1; k < dropped.size(); ++k) {
        held += dropped[k] == dropped[k - 1] ? 1.0 : 0.0;
        EXPECT_TRUE(dropped[k] == dropped[k - 1] || dropped[k] == noisy[k]) << k;
    }
    EXPECT_EQ(dropped[0], noisy[0]);
    EXPECT_NEAR(held / 10000.0, 0.3, 4.0 * std::sqrt(0.3 * 0.7 / 10000.0));
}

// Stamps are whole microseconds around the even ones, the first at 0; a reading is of its own time.
TEST(StandExperiment, StampsAreMicrosecondsAroundTheEvenOnes) {
    stand::Stand built = held_still();
    built.spread_s = 0.003;
    const auto record = stand::run(built, {.name = "step", .until_s = 50.0}, 4);
    ASSERT_EQ(record.time_s.size(), 5001U);
    EXPECT_EQ(record.time_s[0], 0.0);
    double most = 0.0;
    double least = 0.0;
    for (std::size_t k = 1; k < record.time_s.size(); ++k) {
        const double off = record.time_s[k] - 0.01 * static_cast<double>(k);
        most = std::max(most, off);
        least = std::min(least, off);
        EXPECT_NEAR(record.time_s[k] * 1e6, std::round(record.time_s[k] * 1e6), 1e-5);
    }
    EXPECT_NEAR(most, 0.003, 1e-5);
    EXPECT_NEAR(least, -0.003, 1e-5);
    built.drift_rad_per_s = 1.0;  // which reads the time that a sample was taken at
    built.jitter_s = 0.002;
    const auto late = stand::run(built, {.name = "step", .until_s = 50.0}, 4);
    double widest = 0.0;
    for (std::size_t k = 1; k < late.time_s.size(); ++k) {
        widest = std::max(widest, std::fabs(late.angle_rad[k] - late.time_s[k]));
    }
    EXPECT_LE(widest, 0.002 + 1e-12);
    EXPECT_GT(widest, 0.00199);
    EXPECT_GE(late.angle_rad[0], 0.0);  // not before the record
}

}  // namespace
