// Which rows a logger leaves out, and how it rounds what it writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "drive/stand/blind/logger.hpp"

namespace {

namespace blind = stand::blind;
using blind::Held;
using blind::Logger;

Logger with_step(double stamp_step_s) {
    Logger logger;
    logger.stamp_step_s = stamp_step_s;
    return logger;
}
Logger that_misses(double missing_share, double input_jump = 0.0) {
    Logger logger;
    logger.missing_share = missing_share;
    logger.input_jump = input_jump;
    return logger;
}

// Rows at 0, 1, 2... s, the input 0.
Held seconds(std::size_t count) {
    Held held;
    for (std::size_t k = 0; k < count; ++k) {
        held.time_s.push_back(static_cast<double>(k));
        held.input.push_back(0.0);
    }
    return held;
}

// The times of the rows that are written.
std::vector<std::size_t> written(const Logger& logger, const Held& held, std::size_t from, std::uint64_t seed) {
    stand::Chance chance(seed, 1);
    std::istringstream rows(blind::write_log(logger, held, std::vector<double>(held.time_s.size(), 0.0), from, chance));
    std::vector<std::size_t> times;
    std::string row;
    std::getline(rows, row);  // the header
    while (std::getline(rows, row)) {
        times.push_back(std::stoul(row));
    }
    return times;
}

TEST(LoggerEdges, StepsOfTensAreRoundedToTens) {
    EXPECT_EQ(blind::stamp_of(with_step(10.0), 37.0, 0.0), 40.0);
    EXPECT_EQ(blind::stamp_of(with_step(25.0), 34.0, 0.0), 30.0);  // of the decimal step below
    EXPECT_EQ(blind::stamp_of(with_step(1.0), 3.4, 0.0), 3.0);
    EXPECT_EQ(blind::stamp_of(with_step(0.5), 0.32, 0.0), 0.3);
}

// Of gaps of one to four rows, 2.5 in the mean, begin so many as make up the share.
TEST(LoggerEdges, GapsAreOfOneToFourRows) {
    const auto rows = written(that_misses(0.01), seconds(30'000), 0, 5);
    std::set<std::size_t> gaps;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        gaps.insert(rows[i] - rows[i - 1] - 1);
    }
    EXPECT_THAT(gaps, testing::ElementsAre(0U, 1U, 2U, 3U, 4U));
    // The least of the first ten shares begins a gap where it is below, and none where it is above.
    stand::Chance chance(5, 1);
    double least = 1.0;
    for (int k = 0; k < 10; ++k) {
        const double share = chance.share();
        least = k == 0 ? 1.0 : std::min(least, share);  // the first row is always written
        (void)chance.share();                           // whether the row is written twice
    }
    EXPECT_EQ(written(that_misses(2.5 * least * 0.995), seconds(10), 0, 5).size(), 10U);
    EXPECT_LT(written(that_misses(2.5 * least * 1.005), seconds(10), 0, 5).size(), 10U);
}

// A logger that leaves out all it may writes its first row, and those whose input moved by more than its jump.
TEST(LoggerEdges, KeepsTheRowsWhereTheInputMoves) {
    Held held = seconds(12);
    for (std::size_t k = 5; k < 12; ++k) {
        held.input[k] = k < 8 ? 0.5 : 0.25;
    }
    EXPECT_THAT(written(that_misses(2.5), held, 2, 1), testing::ElementsAre(2U, 5U, 8U));
    EXPECT_THAT(written(that_misses(2.5, 0.25), held, 2, 1), testing::ElementsAre(2U, 5U));
}

}  // namespace
