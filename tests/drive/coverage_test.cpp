// How coverage is counted: what two runs say together follows from what they say alone.
#include "drive/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/drive/plants.hpp"

namespace {

using drive::Kind;

TEST(Coverage, OfTwoRunsIsTheirMeanAndSpread) {
    std::size_t done = 0;
    const auto count = [&] { ++done; };
    const auto one = drive::measure_coverage(plants::sopdt(), Kind::sopdt, {}, 1, 5, 1, count);
    EXPECT_EQ(done, 1U);
    const auto two = drive::measure_coverage(plants::sopdt(), Kind::sopdt, {}, 2, 5, 1, count);
    EXPECT_EQ(done, 3U);
    ASSERT_EQ(two.names.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(one.spread[i], 0.0);
        EXPECT_GT(one.claimed[i], 0.0);
        EXPECT_NE(two.mean[i], one.mean[i]) << "the second log is another";
        EXPECT_NEAR(two.spread[i], std::sqrt(2.0) * std::fabs(two.mean[i] - one.mean[i]), 1e-12);
        EXPECT_NEAR(two.claimed[i] / one.claimed[i], 1.0, 0.2);  // of as much noise
    }
    // Of another set another log; of the same the same.
    EXPECT_NE(drive::measure_coverage(plants::sopdt(), Kind::sopdt, {}, 1, 6, 1).mean, one.mean);
    EXPECT_NE(drive::measure_coverage(plants::sopdt(), Kind::sopdt, {}, 1, 5 + (1ULL << 32U), 1).mean, one.mean);
    EXPECT_EQ(drive::measure_coverage(plants::sopdt(), Kind::sopdt, {}, 1, 5, 1).mean, one.mean);
}

TEST(Coverage, AFitThatThrowsCountsAsOutside) {
    drive::Acquisition nothing;
    nothing.excitation.amplitude = 0.0;
    const auto found = drive::measure_coverage(plants::sopdt(), Kind::sopdt, nothing, 2, 5, 1);
    EXPECT_EQ(found.failed, 2U);
    EXPECT_EQ(found.runs, 2U);
    EXPECT_EQ(found.inside, (std::vector<std::size_t>{0, 0, 0}));
    EXPECT_EQ(found.jointly_inside, 0U);
}

}  // namespace
