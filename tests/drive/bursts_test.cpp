// Stamps of reception: bursts are spread, samples written twice are not.
#include "drive/bursts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "drive/log.hpp"

namespace {

using drive::Log;
using testing::ElementsAre;
using testing::HasSubstr;

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
