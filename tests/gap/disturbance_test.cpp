// What is left is a disturbance's where it is the same stationary noise as where it was fitted.
#include "gap/drive/residuals/disturbance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace {

constexpr double interval_s = 0.1;
constexpr std::size_t samples = 2000;
constexpr double colour = 0.95;
// Between values of an autoregression that tell anything new: (1 + c) / (1 - c).
constexpr double apart = (1.0 + colour) / (1.0 - colour);

gap::Record record_of() {
    gap::Record record;
    for (std::size_t i = 0; i < samples; ++i) {
        record.time_s.push_back(interval_s * static_cast<double>(i));
    }
    record.usual_interval_s = interval_s;
    return record;
}

// About a level, of a deviation of 1.
gap::Remainder noise(const gap::Record& record, unsigned seed, double level = 0.0) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    gap::Remainder left{&record, std::vector<double>(samples), {}, std::vector<char>(samples, 1)};
    double state = normal(engine);
    for (std::size_t i = 0; i < samples; ++i) {
        left.residuals.push_back(level + state);
        state = colour * state + std::sqrt(1.0 - colour * colour) * normal(engine);
    }
    return left;
}

TEST(Disturbance, IsMeasuredAboutItsLevel) {
    const gap::Record record = record_of();
    const gap::Disturbance found = gap::disturbance_of({noise(record, 1, 3.0), noise(record, 2, -3.0)}, 1e-6);
    EXPECT_NEAR(found.rms, 1.0, 0.2);
    EXPECT_NEAR(found.mean_square, 9.0, 3.0);
    EXPECT_NEAR(found.times_anew, 2.0 * samples / apart, 0.5 * samples / apart);
    EXPECT_TRUE(found.even);
}

TEST(Disturbance, IsMeasuredWhereItCounts) {
    const gap::Record record = record_of();
    gap::Remainder left = noise(record, 3);
    for (std::size_t i = 0; i < samples / 2; ++i) {
        left.residuals[i] += 10.0;
        left.counts[i] = 0;
    }
    const gap::Disturbance found = gap::disturbance_of({left}, 1e-6);
    EXPECT_NEAR(found.rms, 1.0, 0.25);
    EXPECT_LT(found.mean_square, 0.5);
    EXPECT_NEAR(found.times_anew, 0.5 * samples / apart, 0.25 * samples / apart);
}

TEST(Disturbance, OfNothingIsNone) {
    const gap::Record record = record_of();
    const gap::Remainder left{&record, std::vector<double>(samples, 0.0), {}, std::vector<char>(samples, 1)};
    const gap::Disturbance found = gap::disturbance_of({left}, 1e-6);
    EXPECT_EQ(found.rms, 0.0);
    EXPECT_FALSE(gap::are_one_disturbance(found, found));
}

TEST(Disturbance, IsTheSameFromRecordToRecord) {
    const gap::Record record = record_of();
    int same = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        same += gap::are_one_disturbance(gap::disturbance_of({noise(record, seed)}, 1e-6),
                                         gap::disturbance_of({noise(record, 1000 + seed, 5.0)}, 1e-6))
                    ? 1
                    : 0;
    }
    EXPECT_GE(same, 97);
}

TEST(Disturbance, IsAsLarge) {
    gap::Disturbance fitted{1.0, 0.0, 50.0, true};
    gap::Disturbance judged = fitted;
    judged.rms = 1.49;
    EXPECT_TRUE(gap::are_one_disturbance(fitted, judged));
    EXPECT_TRUE(gap::are_one_disturbance(judged, fitted));
    for (const double half_more : {1.5, 1.51}) {
        judged.rms = half_more;
        EXPECT_FALSE(gap::are_one_disturbance(fitted, judged));
        EXPECT_FALSE(gap::are_one_disturbance(judged, fitted));
    }
}

TEST(Disturbance, ComesAnewTwelveTimes) {
    const gap::Disturbance often{1.0, 0.0, 12.0, true};
    const gap::Disturbance seldom{1.0, 0.0, 11.9, true};
    EXPECT_TRUE(gap::are_one_disturbance(often, often));
    EXPECT_FALSE(gap::are_one_disturbance(often, seldom));
    EXPECT_FALSE(gap::are_one_disturbance(seldom, often));
}

TEST(Disturbance, HasNoWaveAndNoBurst) {
    const gap::Record record = record_of();
    gap::Remainder wave = noise(record, 4);
    gap::Remainder burst = noise(record, 5);
    for (std::size_t i = 0; i < samples; ++i) {
        wave.residuals[i] += 2.0 * std::sin(2.0 * std::numbers::pi * 0.21 * record.time_s[i]);
        burst.residuals[i] *= i >= 900 && i < 1000 ? 10.0 : 1.0;
    }
    gap::Remainder few = noise(record, 8);  // waves in a record
    for (std::size_t i = 0; i < samples; ++i) {
        few.residuals[i] += 4.0 * std::sin(2.0 * std::numbers::pi * 4.5 / 200.0 * record.time_s[i]);
    }
    EXPECT_FALSE(gap::disturbance_of({few}, 1e-6).even);
    const gap::Disturbance plain = gap::disturbance_of({noise(record, 6)}, 1e-6);
    EXPECT_FALSE(gap::disturbance_of({wave}, 1e-6).even);
    EXPECT_FALSE(gap::disturbance_of({burst}, 1e-6).even);
    const gap::Disturbance uneven{1.0, 0.0, 50.0, false};
    EXPECT_FALSE(gap::are_one_disturbance(plain, uneven));
    EXPECT_FALSE(gap::are_one_disturbance(uneven, plain));
}

// A plant with a damping ratio of 0.17 swings on noise, and its sensor has noise of its own: of what is left at one
// time half a swing later turns over by half, e^(-0.17 pi) of what is not the sensor's.
TEST(Disturbance, MayBeWhatSwingsOnNoiseBehindANoisySensor) {
    const gap::Record record = record_of();
    constexpr double turn = 2.0 * std::numbers::pi / 10.0;  // radians an interval
    const double radius = std::exp(-0.17 * turn);
    for (unsigned seed = 21; seed <= 25; ++seed) {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> normal;
        gap::Remainder left{&record, {}, {}, std::vector<char>(samples, 1)};
        left.residuals.resize(samples);
        double now = 0.0;
        double before = 0.0;
        for (double& value : left.residuals) {
            const double next = 2.0 * radius * std::cos(turn) * now - radius * radius * before + normal(engine);
            before = std::exchange(now, next);
            value = now + normal(engine);
        }
        EXPECT_TRUE(gap::disturbance_of({left}, 1e-6).even) << seed;
    }
}

TEST(Disturbance, IsNothingWhereNothingCounts) {
    const gap::Record record = record_of();
    gap::Remainder left = noise(record, 7);
    left.counts.assign(samples, 0);
    EXPECT_EQ(gap::disturbance_of({left}, 1e-6).times_anew, 0.0);
    left.counts.assign(samples, 1);
    left.residuals[3] = std::nan("");
    EXPECT_FALSE(gap::disturbance_of({left}, 1e-6).even);
}

}  // namespace
