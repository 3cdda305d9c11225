// Where missed counts are looked for: at jumps of the reading itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"
#include "tests/gap/made_records.hpp"

namespace {

using Values = std::vector<double>;

Values guess_of(std::size_t count, const std::function<double(std::size_t)>& residual) {
    const gap::Record record = gap_test::record_of(count, [](double) { return 0.0; });
    const gap::Course course(record, 1);
    Values residuals(count);
    for (std::size_t i = 0; i < count; ++i) {
        residuals[i] = residual(i);
    }
    return gap::effect_named("missed_counts").guess({course, {}, residuals, {}});
}

constexpr double before(double sample) { return (sample - 0.5) * gap_test::h; }

// Between the sample before a jump and its first; the largest first; none that takes less than a twentieth of what is
// left.
TEST(MissedCounts, AreTheStepsOfTheResiduals) {
    const Values found = guess_of(100, [](std::size_t i) { return (i >= 40 ? 1.0 : 0.0) - (i >= 80 ? 0.25 : 0.0); });
    ASSERT_EQ(found.size(), 6U);
    EXPECT_NEAR(found[0], before(40), 1e-9);
    EXPECT_NEAR(found[1], (40 * 1.0 + 20 * 0.75) / 60.0, 1e-9);  // the mean behind it
    EXPECT_NEAR(found[2], before(80), 1e-9);
    EXPECT_NEAR(found[3], 0.75 - found[1], 1e-9);
    EXPECT_EQ(guess_of(100, [](std::size_t) { return 0.0; }), Values(6, 0.0));
    // A step that is seen by ten samples of white noise of its size is none.
    EXPECT_EQ(guess_of(100, [](std::size_t i) { return i % 2 == 0 ? 1.0 : -1.0; }), Values(6, 0.0));
}

// What takes four samples to grow to a size has no half of it between two.
TEST(MissedCounts, AreNoneWhereTheReadingOnlyGrows) {
    const auto grown = [](double samples) {
        return [samples](std::size_t i) { return 0.5 + 0.5 * std::tanh((static_cast<double>(i) - 199.5) / samples); };
    };
    EXPECT_EQ(guess_of(400, grown(4.0)), Values(6, 0.0));
    EXPECT_EQ(guess_of(400, grown(40.0)), Values(6, 0.0));
    EXPECT_NEAR(guess_of(400, grown(0.3)).at(0), before(200), 1e-9);
}

// With noise of a third of the size the means of 14 samples tell; of three times the size no few samples do, and
// nothing is refused.
TEST(MissedCounts, AreSeenThroughNoiseByAsManySamplesAsItAsksFor) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 1.0);
    Values drawn(400);
    for (double& one : drawn) {
        one = noise(random);
    }
    const auto jump = [&](double deviation) {
        return guess_of(400, [&](std::size_t i) { return (i >= 200 ? 1.0 : 0.0) + deviation * drawn[i]; });
    };
    EXPECT_NEAR(jump(0.33).at(0), before(200), 2.0 * gap_test::h);
    EXPECT_NEAR(jump(0.33).at(1), 1.0, 0.1);
    EXPECT_NE(jump(3.0).at(1), 0.0);
    const Values grown = guess_of(400, [&](std::size_t i) {
        return 0.5 + 0.5 * std::tanh((static_cast<double>(i) - 199.5) / 60.0) + 0.2 * drawn[i];
    });
    EXPECT_EQ(grown, Values(6, 0.0));
}

// Of a reading that only grows nothing is refused where noise asks for more than 40 samples. The mean of what lies
// behind grows along it, and with it what a jump of that size asks of the same noise: the last place that asks for 41
// is the best one.
TEST(MissedCounts, AreAskedOfFortySamplesAtMost) {
    constexpr std::size_t count = 2001;
    constexpr double slope = 1.0 / count;
    constexpr double deviation = 1.0 / 6.0;  // of every sample, up and down in turn
    const auto grown = [](std::size_t i) {
        return slope * static_cast<double>(i) + (i % 2 == 0 ? deviation : -deviation);
    };
    const double noise = 1.4826 / std::sqrt(2.0) * 2.0 * deviation;  // to a thousandth
    // 128 noise^2 / mean^2 = 40 where the mean of what lies behind, of a straight line, is this.
    const double at = (2.0 * noise * std::sqrt(128.0 / 40.0) - 1.0) * count;
    ASSERT_LT(at, count / 3.0);  // before the place that takes most, where nothing is refused
    EXPECT_NEAR(guess_of(count, grown).at(0), before(at), 8.0 * gap_test::h);
}

// Noise is the median step from sample to sample. As above, of steps of many sizes.
TEST(MissedCounts, AreAskedByTheMedianOfTheSteps) {
    constexpr std::size_t count = 4001;
    constexpr double slope = 1.0 / count;
    Values residuals(count);
    Values steps;
    for (std::size_t i = 0; i < count; ++i) {
        const double turn = 0.618034 * static_cast<double>(i);
        const double size = 0.1 + 0.12 * (turn - std::floor(turn));
        residuals[i] = slope * static_cast<double>(i) + (i % 2 == 0 ? size : -size);
        if (i > 0) {
            steps.push_back(std::fabs(residuals[i] - residuals[i - 1]));
        }
    }
    std::ranges::sort(steps);
    const double noise = 1.4826 / std::sqrt(2.0) * steps[steps.size() / 2];
    const double at = (2.0 * noise * std::sqrt(128.0 / 40.0) - 1.0) * count;
    ASSERT_GT(at, count / 20.0);
    ASSERT_LT(at, count / 3.0);
    EXPECT_NEAR(guess_of(count, [&](std::size_t i) { return residuals[i]; }).at(0), before(at), 40.0 * gap_test::h);
}

// Where nothing is noisy neighbours tell: half of the size, 0.4 % more or less. Of 100 samples behind the first is
// that, the second nine tenths and the others 1.
TEST(MissedCounts, AreHalfOfTheirSizeAtOnce) {
    const auto with_first = [](double first) {
        return guess_of(150, [&](std::size_t i) { return i < 50 ? 0.0 : i == 50 ? first : i == 51 ? 0.9 : 1.0; });
    };
    // first = half of (first + 0.9 + 98) / 100
    const double half = 0.5 * 98.9 / 99.5;
    EXPECT_NEAR(with_first(1.004 * half)[0], before(50), 1e-9);
    EXPECT_EQ(with_first(0.996 * half), Values(6, 0.0));
}

// None is before the first sample. Of noise that goes up and down by 3 about 1 even many samples tell little, so that
// the place goes by the sums: whose ends cancel, or are low.
TEST(MissedCounts, AreBehindTheFirstSample) {
    const auto about_one = [](std::size_t count, double first) {
        return guess_of(count, [&](std::size_t i) { return 1.0 + (i % 2 == 0 ? first : -first); })[0];
    };
    EXPECT_NEAR(about_one(101, -3.0), before(1), 1e-9);
    EXPECT_NEAR(about_one(100, 3.0), before(2), 1e-9);
}

}  // namespace
