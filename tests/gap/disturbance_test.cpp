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

// --- By hand: a few readings, too few for bursts and lines.

gap::Remainder left_of(const gap::Record& record, std::vector<double> residuals) {
    std::vector<char> counts(residuals.size(), 1);
    return {&record, std::vector<double>(residuals.size()), std::move(residuals), std::move(counts)};
}

// About levels of 3 and -1 what is left turns from reading to reading: each is new. What does not count has no part.
TEST(DisturbanceByHand, IsTheRootMeanSquareAboutEachLevel) {
    const gap::Record record = record_of();
    std::vector<double> high;
    std::vector<double> low;
    for (int i = 0; i < 30; ++i) {
        high.push_back(i % 2 == 0 ? 5.0 : 1.0);
    }
    for (int i = 0; i < 10; ++i) {
        low.push_back(i % 2 == 0 ? -5.0 : 3.0);
    }
    gap::Remainder one = left_of(record, high);
    gap::Remainder two = left_of(record, low);
    for (gap::Remainder* with : {&one, &two}) {
        with->residuals.insert(with->residuals.begin() + 4, 1000.0);
        with->counts.insert(with->counts.begin() + 4, char{0});
        with->simulated.push_back(0.0);
    }
    const gap::Disturbance found = gap::disturbance_of({one, two}, 1e-12);
    EXPECT_NEAR(found.mean_square, (30.0 * 9.0 + 10.0 * 1.0) / 40.0, 1e-12);
    EXPECT_NEAR(found.rms, std::sqrt((30.0 * 4.0 + 10.0 * 16.0) / 40.0), 1e-12);
    EXPECT_NEAR(found.times_anew, 40.0, 1e-9);
}

// A mean is of what counts, and is taken off all.
TEST(DisturbanceByHand, AMeanIsOfWhatCounts) {
    const gap::Record record = record_of();
    gap::Remainder one = left_of(record, {1.0, 2.0, 30.0, 6.0});
    one.counts[2] = 0;
    gap::take_off_mean(one);
    EXPECT_EQ(one.residuals, (std::vector<double>{-2.0, -1.0, 27.0, 3.0}));
    one.counts.assign(4, 0);
    gap::take_off_mean(one);
    EXPECT_EQ(one.residuals, (std::vector<double>{-2.0, -1.0, 27.0, 3.0}));
}

// Four readings turn over from one to the next: their products sum to -3. Two far off add to the squares alone.
TEST(DisturbanceByHand, AWaveTurnsOverBySixTenths) {
    const gap::Record record = record_of();
    const auto is_even = [&](double correlation, std::size_t lag) {
        std::vector<double> residuals(41, 0.0);
        for (std::size_t i = 0; i < 4; ++i) {
            residuals[i * lag] = i % 2 == 0 ? 1.0 : -1.0;
        }
        residuals[24] = std::sqrt(0.5 * (3.0 / correlation - 4.0));
        residuals[33] = -residuals[24];
        return gap::disturbance_of({left_of(record, residuals)}, 1e-12).even;
    };
    // New from reading to reading, it is looked for over four of them.
    for (const std::size_t lag : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
        EXPECT_TRUE(is_even(0.597, lag)) << lag;
        EXPECT_FALSE(is_even(0.603, lag)) << lag;
    }
    EXPECT_TRUE(is_even(0.7, 5));
}

// A stretch of ten readings that is twenty times as loud as the others is a burst; all are even but for that.
TEST(DisturbanceByHand, ABurstIsTwentyTimesAsLoud) {
    const gap::Record record = record_of();
    const auto is_even = [&](double times) {
        std::mt19937_64 engine(9);
        std::vector<double> residuals;
        for (int stretch = 0; stretch < 40; ++stretch) {
            std::vector<double> ten{1.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, -1.0};
            for (std::size_t i = 9; i > 0; --i) {
                std::swap(ten[i], ten[engine() % (i + 1)]);
            }
            for (const double value : ten) {
                residuals.push_back(stretch == 20 ? std::sqrt(times) * value : value);
            }
        }
        return gap::disturbance_of({left_of(record, residuals)}, 1e-12).even;
    };
    EXPECT_TRUE(is_even(19.9));
    EXPECT_FALSE(is_even(20.1));
}

}  // namespace
