// Stamps of reception: bursts are spread, samples written twice are not.
#include "drive/bursts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <span>
#include <sstream>

#include "drive/log.hpp"

namespace {

using drive::Burst;
using drive::Log;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Sample {
    double time_s;
    double y;
};

Log log_of(const std::vector<Sample>& samples) {
    Log log;
    log.name = "l.csv";
    for (const auto& [time_s, y] : samples) {
        log.time_s.push_back(time_s);
        log.input.push_back(1.0);
        log.output.push_back(y);
        log.line.push_back(log.line.size() + 2);
    }
    return log;
}

// The largest distance of an interval from their mean, relative to it.
double unevenness(const std::vector<double>& time_s) {
    double worst = 0.0;
    const double mean_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
    for (std::size_t i = 1; i < time_s.size(); ++i) {
        worst = std::max(worst, std::fabs(time_s[i] - time_s[i - 1] - mean_s));
    }
    return worst / mean_s;
}

// A sample that was written twice is one: of what was measured the mean, of every input the last.
TEST(Bursts, FurtherInputsAreOrderedLikeTheFirst) {
    Log log = log_of({{0, 1}, {1, 2}, {2, 3}, {2, 5}, {1, 9}, {3, 6}, {4, 6}, {5, 6}, {6, 6}, {7, 6}});
    log.input = {0, 1, 2, 3, 9, 5, 5, 5, 5, 5};
    log.more_inputs = {{10, 11, 12, 13, 19, 15, 15, 15, 15, 15}, {20, 21, 22, 23, 29, 25, 25, 25, 25, 25}};
    log.simulated = {1, 2, 3, 7, 9, 6, 6, 6, 6, 6};
    (void)drive::order_stamps(log);
    EXPECT_THAT(log.time_s, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(log.input, ElementsAre(0, 1, 3, 5, 5, 5, 5, 5));
    EXPECT_THAT(log.more_inputs, ElementsAre(ElementsAre(10, 11, 13, 15, 15, 15, 15, 15),  //
                                             ElementsAre(20, 21, 23, 25, 25, 25, 25, 25)));
    EXPECT_THAT(log.output, ElementsAre(1, 2, 4, 6, 6, 6, 6, 6));
    EXPECT_THAT(log.simulated, ElementsAre(1, 2, 5, 6, 6, 6, 6, 6));
}

TEST(Bursts, AreSpreadEvenlyToTheNextStamp) {
    Log log =
        log_of({{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 5}, {1, 6}, {1, 7}, {1, 8}, {2, 9}, {2, 10}, {2, 11}, {2, 12}});
    const auto report = drive::order_stamps(log);
    ASSERT_EQ(log.time_s.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_NEAR(log.time_s[i], 0.25 * static_cast<double>(i), 1e-12);
        EXPECT_EQ(log.output[i], static_cast<double>(i + 1));
    }
    EXPECT_EQ(report.repeated, 9U);
    EXPECT_EQ(report.first_repeated, 3U);
    EXPECT_TRUE(report.spread);
    EXPECT_FALSE(report.clean());
    EXPECT_EQ(report.missing, 0U);
    EXPECT_THAT(report.text(),
                HasSubstr("9 repeated stamps, from line 3: stamped in bursts, as received; their samples "
                          "are spread evenly to the next stamp"));
}

// A sample every 8 ms, packed by fours or eights into messages every 48 ms or so, with a pause of 5 s in between.
TEST(Bursts, PackedUnevenlyAreStillEvenInTime) {
    std::vector<Sample> samples;
    double sent = 0.0;
    for (int message = 1; message <= 100; ++message) {
        while (sent + 4 <= message * 6.0 + 1e-9) {
            for (int i = 0; i < 4; ++i, ++sent) {
                samples.push_back({0.048 * message + (message > 50 ? 5.0 : 0.0), std::sin(0.1 * sent)});
            }
        }
    }
    Log log = log_of(samples);
    EXPECT_TRUE(drive::order_stamps(log).spread);
    ASSERT_EQ(log.time_s.size(), samples.size());
    const auto pause = static_cast<std::ptrdiff_t>(
        std::count_if(samples.begin(), samples.end(), [](const Sample& sample) { return sample.time_s < 3.0; }));
    // To each next stamp alone it would be 0.5.
    EXPECT_LT(unevenness({log.time_s.begin(), log.time_s.begin() + pause}), 0.25);
    EXPECT_LT(unevenness({log.time_s.begin() + pause, log.time_s.end()}), 0.25);
    EXPECT_NEAR(log.time_s[static_cast<std::size_t>(pause)] - log.time_s[static_cast<std::size_t>(pause) - 1], 5.0,
                0.1);
}

// A logger that goes from 40 samples a second to two: no line through both is true.
TEST(Bursts, OfAnotherRateStayWhereTheyWereStamped) {
    std::vector<Sample> samples;
    for (int second = 0; second < 40; ++second) {
        for (int i = 0; i < (second < 20 ? 40 : 2); ++i) {
            samples.push_back({static_cast<double>(second), static_cast<double>(samples.size())});
        }
    }
    Log log = log_of(samples);
    EXPECT_TRUE(drive::order_stamps(log).spread);
    EXPECT_EQ(log.time_s[800], 20.0);
    EXPECT_EQ(log.time_s[801], 20.5);
    EXPECT_EQ(log.time_s[760], 19.0);
}

TEST(Bursts, AreNotSpreadOverAGap) {
    std::vector<Sample> samples;
    for (int i = 0; i < 40; ++i) {
        samples.push_back({(i / 4) + (i >= 20 ? 30.0 : 0.0), static_cast<double>(i)});
    }
    Log log = log_of(samples);
    const auto report = drive::order_stamps(log);
    EXPECT_TRUE(report.spread);
    EXPECT_NEAR(log.time_s[19], 4.75, 1e-9);
    EXPECT_NEAR(log.time_s[20], 35.0, 1e-9);
    EXPECT_NEAR(log.time_s[39], 39.75, 1e-9);
    EXPECT_EQ(report.first_gap, 22U);
}

TEST(Bursts, OneSampleWrittenSeveralTimesIsOneSample) {
    std::vector<Sample> samples;
    for (int i = 0; i < 80; ++i) {
        samples.push_back({static_cast<double>(i / 4), static_cast<double>(i / 4)});
    }
    Log log = log_of(samples);
    const auto report = drive::order_stamps(log);
    EXPECT_FALSE(report.spread);
    EXPECT_EQ(log.time_s.size(), 20U);
    EXPECT_THAT(report.text(), HasSubstr("their mean output stays"));
}

TEST(Bursts, OfTwoStampsAloneAreMerged) {
    Log log = log_of({{0, 1}, {0, 2}, {1, 3}, {1, 5}});
    EXPECT_FALSE(drive::order_stamps(log).spread);
    EXPECT_THAT(log.output, ElementsAre(1.5, 4));
}

TEST(Bursts, FewRepeatedStampsGiveTheirMean) {
    std::vector<Sample> samples;
    for (int i = 0; i < 20; ++i) {
        samples.push_back({static_cast<double>(i), static_cast<double>(i)});
    }
    samples.insert(samples.begin() + 10, {9.0, 11.0});
    Log log = log_of(samples);
    EXPECT_FALSE(drive::order_stamps(log).spread);
    EXPECT_EQ(log.time_s.size(), 20U);
    EXPECT_EQ(log.output[9], 10.0);
}

TEST(Bursts, ThatDoublesCannotHoldApartAreMerged) {
    Log log = log_of({{1e16, 1},
                      {1e16, 2},
                      {1e16, 3},
                      {1e16 + 2, 4},
                      {1e16 + 2, 5},
                      {1e16 + 2, 6},
                      {1e16 + 4, 7},
                      {1e16 + 4, 8},
                      {1e16 + 4, 9}});
    EXPECT_FALSE(drive::order_stamps(log).spread);
    EXPECT_THAT(log.output, ElementsAre(2, 5, 8));
}

// Bursts of so many samples, stamped so.
std::vector<Burst> bursts_at(const std::vector<double>& time_s, const std::vector<std::size_t>& sizes) {
    std::vector<Burst> bursts;
    std::size_t first = 0;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
        bursts.push_back({first, sizes[i], time_s[i]});
        first += sizes[i];
    }
    return bursts;
}

std::vector<Burst> fours_at(const std::vector<double>& time_s) {
    return bursts_at(time_s, std::vector<std::size_t>(time_s.size(), 4));
}

// Intervals of 1 s and 2 s in turn, the usual one 2 s: the line through bursts of four is t = 30/7 + 3/8 (k - 12), and
// a burst alone between gaps, which no line goes through, stays and is as dense.
TEST(Bursts, LieOnTheLineBetweenTheirGaps) {
    const auto time_s = drive::spread(fours_at({0, 20, 21, 23, 24, 26, 27, 29, 49}));
    ASSERT_EQ(time_s.size(), 36U);
    for (std::size_t k = 0; k < 36; ++k) {
        const auto sample = static_cast<double>(k);
        const double expected_s = k < 4    ? 0.375 * sample
                                  : k < 32 ? 20.0 + 30.0 / 7.0 + 0.375 * (sample - 16.0)
                                           : 49.0 + 0.375 * (sample - 32.0);
        EXPECT_NEAR(time_s[k], expected_s, 1e-12) << k;
    }
}

// Of an even number of intervals the usual one is the longer of the middle two: of 1 s and 2 s no one is a gap.
// Whatever follows the bursts is none of them.
TEST(Bursts, HaveTheLongerOfTwoMiddleIntervalsAsUsual) {
    const auto bursts = fours_at({0, 1, 3, 3.25, 3.5});
    const auto time_s = drive::spread(std::span(bursts).first(3));
    ASSERT_EQ(time_s.size(), 12U);
    for (std::size_t k = 0; k < 12; ++k) {
        EXPECT_NEAR(time_s[k], 4.0 / 3.0 + 0.375 * (static_cast<double>(k) - 4.0), 1e-12) << k;
    }
}

// A line goes through an interval of 7/4 usual ones, and ends at a longer one.
TEST(Bursts, GoOnOverAnIntervalOfSevenFourthsOfTheUsual) {
    const auto over = drive::spread(fours_at({0, 4, 8, 15, 19, 23}));
    ASSERT_EQ(over.size(), 24U);
    for (std::size_t k = 0; k < 24; ++k) {
        EXPECT_NEAR(over[k], 11.5 + 334.0 / 280.0 * (static_cast<double>(k) - 10.0), 1e-9) << k;
    }
    const auto apart = drive::spread(fours_at({0, 4, 8, 15.03125, 19.03125, 23.03125}));
    ASSERT_EQ(apart.size(), 24U);
    for (std::size_t k = 0; k < 24; ++k) {
        EXPECT_NEAR(apart[k], static_cast<double>(k) + (k < 12 ? 0.0 : 3.03125), 1e-9) << k;
    }
}

// Eight neighbours on either side even a burst out, together 17: what came late by half an interval moves those.
TEST(Bursts, AreEvenedOutWithEightNeighboursOnEitherSide) {
    std::vector<double> stamps(41);
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        stamps[i] = static_cast<double>(i) + (i == 20 ? 0.5 : 0.0);
    }
    const auto time_s = drive::spread(bursts_at(stamps, std::vector<std::size_t>(41, 2)));
    ASSERT_EQ(time_s.size(), 82U);
    for (std::size_t i = 8; i < 33; ++i) {
        const bool is_near = i >= 12 && i <= 28;
        EXPECT_NEAR(time_s[2 * i], static_cast<double>(i) + (is_near ? 0.5 / 17.0 : 0.0), 1e-12) << i;
    }
}

// From some tens of samples in 4 s to two: the bursts stay where they were stamped, and the last one is as dense as the
// others usually are, those before an interval of 7/4 usual ones among them.
TEST(Bursts, EndAsDenseAsIsUsual) {
    const auto first_of_last = [](const std::vector<double>& stamps, const std::vector<std::size_t>& sizes) {
        const auto time_s = drive::spread(bursts_at(stamps, sizes));
        EXPECT_EQ(time_s[time_s.size() - 2], stamps.back());
        return time_s.back() - stamps.back();
    };
    // 0.1 s twice, 0.175 s, 2 s twice.
    EXPECT_NEAR(first_of_last({0, 4, 8, 15, 19, 23}, {40, 40, 40, 2, 2, 2}), 0.175, 1e-12);
    // 0.1 s three times, 2 s three times.
    EXPECT_NEAR(first_of_last({0, 4, 8, 12, 16, 20, 24}, {40, 40, 40, 2, 2, 2, 2}), 2.0, 1e-12);
    // Up to 7/4 usual intervals a burst reaches to the next.
    const auto time_s = drive::spread(bursts_at({0, 7, 11, 15, 19, 23, 27, 31}, {40, 40, 40, 40, 40, 2, 2, 2}));
    EXPECT_EQ(time_s[40], 7.0);
    EXPECT_NEAR(time_s[1], 7.0 / 40.0, 1e-12);
    EXPECT_NEAR(time_s[41], 7.1, 1e-12);
}

// At 1e16 doubles are 2 apart, and a half goes to the even one: 1e16 + 1 to 1e16, 1e16 + 3 to 1e16 + 4.
TEST(Bursts, AreNotSpreadWhereAnyTwoSamplesFallOnOneStamp) {
    EXPECT_THAT(drive::spread(bursts_at({1e16, 1e16 + 2, 1e16 + 4}, {2, 1, 1})), IsEmpty());
    EXPECT_THAT(drive::spread(bursts_at({1e16, 1e16 + 2, 1e16 + 4}, {1, 2, 1})), IsEmpty());
    EXPECT_THAT(drive::spread(bursts_at({1e16, 1e16 + 2, 1e16 + 4}, {1, 1, 1})), ElementsAre(1e16, 1e16 + 2, 1e16 + 4));
}

// A released arm, whole degrees, stamps of reception: spread, the angle swings smoothly.
TEST(Bursts, OfARealRig) {
    const char* shared = std::getenv("GLSUM_SHARED");
    if (shared == nullptr) {
        GTEST_SKIP() << "GLSUM_SHARED names no folder of real records";
    }
    const std::string path = std::string(shared) + "/data/real/arm.csv";
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    Log log = drive::parse_log(text.str(), path);
    const std::size_t samples = log.time_s.size();
    const auto report = drive::order_stamps(log);
    EXPECT_TRUE(report.spread);
    EXPECT_EQ(log.time_s.size(), samples);
    EXPECT_LT(report.largest_interval_s, 2.0 * report.usual_interval_s);
}

}  // namespace
