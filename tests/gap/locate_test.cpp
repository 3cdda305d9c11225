// Where a gap lies: parts whose shares are known because the residuals were put there.
#include "gap/drive/residuals/locate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double interval_s = 0.01;

gap::Record record_of(std::size_t count, const std::function<double(double)>& input) {
    gap::Record record;
    record.name = "record";
    record.usual_interval_s = interval_s;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = interval_s * static_cast<double>(i);
        record.time_s.push_back(t);
        record.input.push_back(input(t));
        record.output.push_back(std::sin(t));
    }
    return record;
}

std::vector<double> residuals_of(const gap::Record& record, const std::function<double(double)>& residual) {
    std::vector<double> values;
    for (const double t : record.time_s) {
        values.push_back(residual(t));
    }
    return values;
}

double sum_of(const std::vector<gap::Share>& shares) {
    double sum = 0.0;
    for (const gap::Share& share : shares) {
        sum += share.share;
    }
    return sum;
}

// The share of the bin that holds a place.
double share_at(const std::vector<gap::Share>& shares, double place) {
    for (const gap::Share& share : shares) {
        if (place >= share.from && (place < share.to || share.from == share.to)) {
            return share.share;
        }
    }
    return -1.0;
}

double staircase(double t) { return 0.05 * std::floor(t / 4.0); }

TEST(Locate, PartsFrequenciesByTheirLogarithm) {
    // Two slow waves, which even bins up to 50 Hz would not part, and one fast one.
    const gap::Record record = record_of(2000, staircase);
    const auto wave = [](double hz, double t) { return std::sin(2.0 * std::numbers::pi * hz * t); };
    const gap::Where where = gap::locate(
        {record},
        {residuals_of(record, [&](double t) { return 3.0 * wave(0.1, t) + 2.0 * wave(1.0, t) + wave(20.0, t); })});
    EXPECT_NEAR(sum_of(where.frequency), 1.0, 1e-12);
    EXPECT_NEAR(share_at(where.frequency, 0.1), 9.0 / 14.0, 1e-6);
    EXPECT_NEAR(share_at(where.frequency, 1.0), 4.0 / 14.0, 1e-6);
    EXPECT_NEAR(share_at(where.frequency, 20.0), 1.0 / 14.0, 1e-6);
    // From one period in the record to half the rate, each edge about a half-decade above the one before.
    EXPECT_NEAR(where.frequency.front().to, 1.0 / 20.0, 1e-4);
    EXPECT_NEAR(where.frequency.back().to, 50.0, 0.1);
    for (std::size_t i = 1; i < where.frequency.size(); ++i) {
        EXPECT_NEAR(where.frequency[i].to / where.frequency[i].from, std::sqrt(10.0), 0.5);
    }
}

TEST(Locate, SaysWhatIsConstantApart) {
    const gap::Record record = record_of(777, staircase);
    const gap::Where where = gap::locate({record}, {residuals_of(record, [](double) { return -0.2; })});
    EXPECT_EQ(where.frequency.front().from, 0.0);
    EXPECT_NEAR(where.frequency.front().share, 1.0, 1e-12);
}

// The slowest wave that a record tells, whatever its length.
TEST(Locate, TakesOnePeriodInTheRecordForNoConstant) {
    for (const std::size_t count : {777U, 1000U, 1001U, 2000U, 2047U}) {
        const gap::Record record = record_of(count, staircase);
        const double period_s = interval_s * static_cast<double>(count);
        const gap::Where where = gap::locate(
            {record},
            {residuals_of(record, [&](double t) { return std::sin(2.0 * std::numbers::pi * t / period_s); })});
        EXPECT_NEAR(where.frequency.at(0).share, 0.0, 1e-12) << count;
        EXPECT_NEAR(where.frequency.at(1).share, 1.0, 1e-12) << count;
    }
}

TEST(Locate, StartsAPartAtEachStepOfAFewPercent) {
    // Of a span of 0.2, steps of a quarter; then steps of a twentieth.
    for (const double largest : {0.2, 1.0}) {
        const gap::Record record = record_of(2000, [&](double t) {
            return t < 0.5 ? largest : t < 1.0 ? 0.0 : staircase(t);
        });
        const gap::Where where =
            gap::locate({record}, {residuals_of(record, [](double t) { return t >= 8.0 && t < 12.0; })});
        EXPECT_NEAR(sum_of(where.time), 1.0, 1e-12);
        double after_the_step = 0.0;
        for (const gap::Share& share : where.time) {
            if (share.what == "input 0.05 -> 0.1") {
                after_the_step += share.share;
                EXPECT_GE(share.from, 8.0 - 1e-9);
                EXPECT_LE(share.to, 12.0 + 1e-9);
            }
        }
        EXPECT_NEAR(after_the_step, 1.0, 1e-9) << largest;
    }
}

TEST(Locate, TakesARampForOneMoveAndTellsNoise) {
    // From 0 to 1 between 5 and 6 s, with noise of a hundredth.
    const gap::Record record =
        record_of(2000, [](double t) { return std::clamp(t - 5.0, 0.0, 1.0) + 0.004 * std::sin(91.0 * t); });
    const gap::Where where = gap::locate({record}, {residuals_of(record, [](double) { return 1.0; })});
    std::vector<std::string> moves;
    for (const gap::Share& share : where.time) {
        if (moves.empty() || moves.back() != share.what) {
            moves.push_back(share.what);
        }
        EXPECT_LE(share.to - share.from, 0.2 * 20.0 + 1e-9);  // nothing is left in one long part
    }
    ASSERT_EQ(moves.size(), 2U) << testing::PrintToString(moves);
    EXPECT_EQ(moves.front(), "start");
    EXPECT_THAT(moves.back(), HasSubstr("->"));
}

TEST(Locate, PartsEvenlyWhereTheInputNeverMovesOrAlwaysDoes) {
    for (const auto& input : {std::function<double(double)>([](double) { return 0.0; }),
                              std::function<double(double)>([](double t) { return std::sin(3.0 * t); })}) {
        const gap::Record record = record_of(1000, input);
        const gap::Where where = gap::locate({record}, {residuals_of(record, [](double t) { return t < 1.0; })});
        ASSERT_EQ(where.time.size(), 10U);
        EXPECT_NEAR(where.time.front().share, 1.0, 0.02);
        EXPECT_EQ(where.time.front().what, "");
    }
}

TEST(Locate, NamesTheRecordOfEachPart) {
    gap::Record first = record_of(500, staircase);
    gap::Record second = record_of(900, staircase);
    first.name = "/home/her/first.csv";
    second.name = "second.csv";
    const gap::Where where = gap::locate({first, second}, {residuals_of(first, [](double) { return 1.0; }),
                                                           residuals_of(second, [](double) { return 0.0; })});
    EXPECT_NEAR(sum_of(where.time), 1.0, 1e-12);
    EXPECT_NEAR(sum_of(where.frequency), 1.0, 1e-12);
    for (const gap::Share& share : where.time) {
        EXPECT_EQ(share.share > 0.0, share.what.starts_with("first.csv")) << share.what;
    }
}

TEST(Locate, TakesFewLevelsForThemselvesAndManyByFifths) {
    const gap::Record few = record_of(2000, staircase);  // 0, 0.05, ... 0.2
    const gap::Where where = gap::locate({few}, {residuals_of(few, [](double t) {
                                             return t >= 4.0 && t < 8.0 ? 2.0 : t >= 16.0 ? 1.0 : 0.0;
                                         })});
    ASSERT_EQ(where.input_level.size(), 5U);
    EXPECT_EQ(where.input_level[1].from, 0.05);
    EXPECT_EQ(where.input_level[1].to, 0.05);
    EXPECT_NEAR(where.input_level[1].share, 0.8, 1e-9);
    EXPECT_NEAR(where.input_level[4].share, 0.2, 1e-9);
    EXPECT_EQ(where.output_level.size(), 5U);
    EXPECT_NEAR(where.output_level.front().to - where.output_level.front().from, 0.4, 1e-3);
    EXPECT_NEAR(sum_of(where.output_level), 1.0, 1e-12);

    const gap::Record many = record_of(2000, [](double t) { return std::floor(t); });  // 20 levels
    const gap::Where of_many = gap::locate({many}, {residuals_of(many, [](double t) { return t >= 19.0; })});
    ASSERT_EQ(of_many.input_level.size(), 5U);
    EXPECT_NEAR(of_many.input_level.back().share, 1.0, 1e-12);
}

TEST(Locate, LeavesOutWhatDoesNotCount) {
    const gap::Record record = record_of(2000, staircase);
    const std::vector<double> residuals = residuals_of(record, [](double t) { return t < 8.0 ? 5.0 : 1.0; });
    std::vector<char> counts(2000, 0);
    std::fill(counts.begin() + 800, counts.end(), char{1});
    const gap::Where split = gap::locate({record}, {residuals}, {counts});
    EXPECT_EQ(split.time.front().from, 8.0);
    EXPECT_EQ(split.input_level.size(), 3U);
    EXPECT_NEAR(sum_of(split.time), 1.0, 1e-12);
    EXPECT_NEAR(share_at(split.time, 9.0) + share_at(split.time, 11.0), 1.0 / 3.0, 0.01);

    std::vector<char> blocks(2000, 0);  // two stretches
    std::fill(blocks.begin(), blocks.begin() + 100, char{1});
    std::fill(blocks.begin() + 1900, blocks.end(), char{1});
    const gap::Where where = gap::locate({record}, {residuals}, {blocks});
    EXPECT_NEAR(where.input_level.front().share, 25.0 / 26.0, 1e-9);
    EXPECT_NEAR(where.input_level.back().share, 1.0 / 26.0, 1e-9);
}

TEST(Locate, SharesOutWhereThereIsNoGap) {
    const gap::Record record = record_of(400, staircase);
    const gap::Where where = gap::locate({record}, {residuals_of(record, [](double) { return 0.0; })});
    for (const auto* shares : {&where.time, &where.frequency, &where.input_level, &where.output_level}) {
        EXPECT_NEAR(sum_of(*shares), 1.0, 1e-12);
    }
    EXPECT_NEAR(where.rising + where.falling + where.still, 1.0, 1e-12);
}

// Over two samples before and two behind, a hundredth of the record each, it must have moved by a hundredth of its
// range: 1 of 100.
TEST(Locate, CallsStillWhatMovesLessThanAHundredth) {
    const auto of_slope = [](double by_sample) {
        gap::Record record = record_of(200, staircase);
        for (std::size_t i = 0; i < record.size(); ++i) {
            record.output[i] = by_sample * static_cast<double>(i);
        }
        record.output.back() = 100.0;
        std::vector<double> residuals(200, 0.0);
        residuals[50] = 1.0;
        return gap::locate({record}, {residuals});
    };
    EXPECT_EQ(of_slope(0.25).rising, 1.0);
    EXPECT_EQ(of_slope(0.2499).still, 1.0);
}

}  // namespace
