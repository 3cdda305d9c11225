// What the stand's sensor reads, and when: counts, stamps, what is wrong with the reading alone.
#include "drive/stand/stand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drive/log.hpp"
#include "drive/stand/experiment.hpp"
#include "tests/drive/stand_rig.hpp"

namespace {
TEST(Stand, ReadsWholeCountsAtStampsThatItsSeedFixes) {
    stand::Stand built;
    const stand::Experiment pulse;
    const auto record = stand::run(built, pulse, 5);
    ASSERT_EQ(record.time_s.size(), 501U);
    double widest = 0.0;
    for (std::size_t k = 0; k < record.time_s.size(); ++k) {
        const double counts = record.angle_rad[k] * 1000.0 / (2.0 * std::numbers::pi);
        ASSERT_NEAR(counts, std::round(counts), 1e-9);
        ASSERT_NEAR(record.angle_rad[k], record.truth.points[k].angle_rad, 0.5 * built.encoder_step_rad + 1e-12);
        widest = std::max(widest, std::fabs(record.time_s[k] - 0.01 * static_cast<double>(k)));
    }
    EXPECT_LE(widest, 0.001);
    EXPECT_GT(widest, 0.0009);
    EXPECT_EQ(stand::to_csv(record, true), stand::to_csv(stand::run(built, pulse, 5), true));
    EXPECT_NE(record.time_s, stand::run(built, pulse, 6).time_s);
    const auto log = drive::parse_log(stand::to_csv(record, true), "stand");
    EXPECT_EQ(log.output, record.angle_rad);
    EXPECT_EQ(log.input, record.duty);
}

TEST(Stand, WhatIsWrongWithTheReadingIsInTheReadingOnly) {
    stand::Stand built;
    const stand::Experiment pulse;
    const auto good = stand::run(built, pulse, 5);
    const auto changed = [&](auto set) {
        stand::Stand other = built;
        set(other);
        auto record = stand::run(other, pulse, 5);
        EXPECT_EQ(record.time_s, good.time_s);
        for (std::size_t k = 0; k < good.time_s.size(); ++k) {
            EXPECT_NEAR(record.truth.points[k].angle_rad, good.truth.points[k].angle_rad, 1e-7);
        }
        return record.angle_rad;
    };
    const double count = built.encoder_step_rad;
    EXPECT_NEAR(changed([&](auto& s) { s.offset_rad = 3.0 * count; })[10], good.angle_rad[10] + 3.0 * count, 1e-12);
    EXPECT_NEAR(changed([&](auto& s) { s.drift_rad_per_s = count; })[500], good.angle_rad[500] + 5.0 * count,
                1.01 * count);
    const auto missed = changed([&](auto& s) {
        s.missed_counts = 4.0;
        s.missed_at_s = 2.0;
    });
    EXPECT_EQ(missed[150], good.angle_rad[150]);
    EXPECT_NEAR(missed[250], good.angle_rad[250] - 4.0 * count, 1e-12);
    const auto limited = changed([&](auto& s) { s.sensor_limit_rad = 0.3; });
    EXPECT_LE(*std::max_element(limited.begin(), limited.end()), 0.3 + count);
    const auto dropped = changed([&](auto& s) { s.dropped_rate = 0.5; });
    std::size_t held = 0, moved = 0;
    for (std::size_t k = 110; k < 180; ++k) {  // where the bar moves at more than a count a sample
        held += dropped[k] == dropped[k - 1] ? 1 : 0;
        moved += good.angle_rad[k] != good.angle_rad[k - 1] ? 1 : 0;
    }
    EXPECT_GT(held, 20U);
    EXPECT_GT(moved, 50U);
    const auto jittered = changed([&](auto& s) { s.jitter_s = 0.004; });
    EXPECT_NE(jittered, good.angle_rad);
    const auto noisy = changed([&](auto& s) { s.noise_rad = 0.02; });
    EXPECT_NE(noisy, good.angle_rad);
}

TEST(Stand, JitterAndStampsAreDrawnApart) {
    stand::Stand built;
    built.encoder_step_rad = 0.0;
    const stand::Experiment pulse;
    const auto good = stand::run(built, pulse, 5);
    built.jitter_s = 0.001;
    const auto late = stand::run(built, pulse, 5);
    // How late each sample was taken, from how fast the bar moves then.
    double product = 0.0, of_stamps = 0.0, of_jitter = 0.0;
    for (std::size_t k = 1; k + 1 < good.time_s.size(); ++k) {
        const double speed =
            (good.angle_rad[k + 1] - good.angle_rad[k - 1]) / (good.time_s[k + 1] - good.time_s[k - 1]);
        if (std::fabs(speed) > 0.2) {
            const double jitter = (late.angle_rad[k] - good.angle_rad[k]) / speed;
            const double stamp = good.time_s[k] - 0.01 * static_cast<double>(k);
            product += jitter * stamp;
            of_stamps += stamp * stamp;
            of_jitter += jitter * jitter;
        }
    }
    EXPECT_GT(of_jitter, 1e-6);
    EXPECT_LT(std::fabs(product), 0.3 * std::sqrt(of_stamps * of_jitter));
}

}  // namespace
