// Records and what is made of them: grids, held levels, thinner ones, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "base/failure.hpp"
#include "gap/drive/record.hpp"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Values = std::vector<double>;

drive::Log log_of(std::size_t count) {
    drive::Log log;
    log.name = "l.csv";
    for (std::size_t i = 0; i < count; ++i) {
        log.time_s.push_back(0.5 * static_cast<double>(i));
        log.input.push_back(0.0);
        log.output.push_back(i == 3 ? 1.0 : 0.0);
    }
    return log;
}

std::string refusal_of(drive::Log log) {
    try {
        (void)gap::to_record(std::move(log));
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "";
}

TEST(RecordOfALog, HasThirtyTwoSamplesThatMove) {
    EXPECT_EQ(refusal_of(log_of(32)), "");
    EXPECT_THAT(refusal_of(log_of(31)), HasSubstr("l.csv: expected 32 samples or more, found 31"));
    drive::Log still = log_of(40);
    still.output.assign(40, 2.5);
    EXPECT_THAT(refusal_of(still), HasSubstr("l.csv: the output is 2.5 throughout"));
}

TEST(RecordOfALog, HasTheMedianInterval) {
    drive::Log log = log_of(33);
    for (std::size_t i = 17; i < 33; ++i) {
        log.time_s[i] = log.time_s[16] + 3.0 * static_cast<double>(i - 16);
    }
    EXPECT_EQ(gap::to_record(log).usual_interval_s, 3.0);  // the upper one of an even number
    log.time_s[17] = log.time_s[16] + 0.5;
    for (std::size_t i = 18; i < 33; ++i) {
        log.time_s[i] = log.time_s[17] + 3.0 * static_cast<double>(i - 17);
    }
    EXPECT_EQ(gap::to_record(log).usual_interval_s, 0.5);
}

gap::Record uneven() {
    gap::Record record;
    record.time_s = {10.0, 10.5, 11.5, 12.0, 13.0};
    record.usual_interval_s = 0.5;
    record.input = {1.0, 2.0, 4.0, 8.0, 16.0};
    record.output = {0.0, 1.0, 2.0, 3.0, 4.0};
    record.simulated = {5.0, 6.0, 7.0, 8.0, 9.0};
    record.more_inputs = {{1.0, 0.0, 0.0, 0.0, 3.0}};
    return record;
}

// One node beyond the last stamp, and one for what is held there.
TEST(RecordGrid, SpansTheRecord) {
    const gap::Grid grid = uneven().grid(2.0);
    EXPECT_EQ(grid.first_s, 10.0);
    EXPECT_EQ(grid.step_s, 0.25);
    EXPECT_EQ(grid.count, 14U);
    EXPECT_EQ(grid.at(3), 10.75);
    EXPECT_EQ(uneven().grid(0.4).count, 5U);  // 3 s in steps of 1.25
    // Never more than 60 000 nodes, however finely it is stamped.
    gap::Record fine = uneven();
    fine.usual_interval_s = 1e-5;
    EXPECT_NEAR(fine.grid(1.0).step_s, 3.0 / 60000.0, 1e-15);
    EXPECT_EQ(fine.grid(1.0).count, 60002U);
}

TEST(RecordGrid, HoldsEachLevelFromItsStampOn) {
    const gap::Record record = uneven();
    const gap::Grid grid{10.0, 0.75, 5};
    // [10, 10.75): 0.5 of 1, 0.25 of 2; [10.75, 11.5): 2; [11.5, 12.25): 0.5 of 4, 0.25 of 8; then 8; [13, ...): 16.
    EXPECT_THAT(gap::held_on(grid, record.time_s, record.input),
                ElementsAre(testing::DoubleNear(1.0 / 0.75, 1e-12), testing::DoubleNear(2.0, 1e-12),
                            testing::DoubleNear(4.0 / 0.75, 1e-12), testing::DoubleNear(8.0, 1e-12),
                            testing::DoubleNear(16.0, 1e-12)));
    // A stamp at a node begins there, whatever is rounded.
    const gap::Grid tenths{0.0, 0.1, 6};
    EXPECT_THAT(gap::held_on(tenths, Values{0.0, 0.1 + 0.2}, Values{1.0, 2.0}),
                ElementsAre(1.0, 1.0, testing::DoubleNear(1.0, 1e-6), testing::DoubleNear(2.0, 1e-6),
                            testing::DoubleNear(2.0, 1e-12), testing::DoubleNear(2.0, 1e-12)));
}

TEST(RecordGrid, IsReadByStraightLines) {
    const gap::Grid grid{10.0, 0.5, 4};
    const Values nodes{0.0, 1.0, 4.0, 2.0};
    EXPECT_THAT(gap::read_at(grid, nodes, Values{10.0, 10.25, 10.5, 10.75, 11.4, 11.5}),
                ElementsAre(0.0, 0.5, 1.0, 2.5, testing::DoubleNear(2.4, 1e-12), 2.0));
    EXPECT_THAT(gap::read_at(grid, nodes, Values{9.0, 12.0}), ElementsAre(0.0, 2.0));  // beyond the ends, these
    // What lies behind the last node is none of it.
    const Values longer{0.0, 1.0, 4.0, std::numeric_limits<double>::infinity()};
    EXPECT_THAT(gap::read_at(grid, std::span(longer).first(3), Values{11.0}), ElementsAre(4.0));
}

TEST(RecordParts, AreWhatLiesBeforeATime) {
    const gap::Record first = gap::up_to(uneven(), 12.0);
    EXPECT_THAT(first.time_s, ElementsAre(10.0, 10.5, 11.5));  // not the one at it
    EXPECT_EQ(first.input.size(), 3U);
    EXPECT_EQ(first.output.size(), 3U);
    EXPECT_EQ(first.simulated.size(), 3U);
    EXPECT_EQ(first.more_inputs[0].size(), 3U);
    gap::Record plain = uneven();
    plain.simulated.clear();
    EXPECT_TRUE(gap::up_to(plain, 12.0).simulated.empty());
}

// Every second sample; its input is the mean of what was held until the next one, by how long.
TEST(RecordParts, AreThinnerOnes) {
    const gap::Record thin = gap::thinned(uneven(), 2);
    EXPECT_THAT(thin.time_s, ElementsAre(10.0, 11.5, 13.0));
    EXPECT_THAT(thin.output, ElementsAre(0.0, 2.0, 4.0));
    EXPECT_THAT(thin.input, ElementsAre(testing::DoubleNear((0.5 * 1.0 + 1.0 * 2.0) / 1.5, 1e-12),
                                        testing::DoubleNear((0.5 * 4.0 + 1.0 * 8.0) / 1.5, 1e-12), 16.0));
    EXPECT_THAT(thin.more_inputs[0], ElementsAre(testing::DoubleNear(0.5 / 1.5, 1e-12), 0.0, 3.0));
    EXPECT_EQ(thin.usual_interval_s, 1.0);
    const gap::Record same = gap::thinned(uneven(), 1);
    EXPECT_EQ(same.input, uneven().input);
    EXPECT_EQ(same.time_s, uneven().time_s);
    // The last one is short.
    EXPECT_THAT(gap::thinned(uneven(), 3).input, ElementsAre(testing::DoubleNear((0.5 + 2.0 + 2.0) / 2.0, 1e-12), 8.0));
}

}  // namespace
