// How coverage is counted: what two runs say together follows from what they say alone.
#include "drive/coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

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
    // Each of the first runs is known by what a run more moves the mean by; the spread is of one less than they are.
    const auto three = drive::measure_coverage(plants::sopdt(), Kind::sopdt, {}, 3, 5, 1);
    for (std::size_t i = 0; i < 3; ++i) {
        const double first = one.mean[i];
        const double second = 2.0 * two.mean[i] - first;
        const double third = 3.0 * three.mean[i] - 2.0 * two.mean[i];
        const double square = std::pow(first - three.mean[i], 2) + std::pow(second - three.mean[i], 2) +
                              std::pow(third - three.mean[i], 2);
        EXPECT_NEAR(three.spread[i] / std::sqrt(square / 2.0), 1.0, 1e-6);
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
    const std::vector<double> nothing_known(3, 0.0);
    EXPECT_EQ(found.mean, nothing_known);
    EXPECT_EQ(found.spread, nothing_known);
    EXPECT_EQ(found.claimed, nothing_known);
}

// The generator of the standard, 53 bits of it in the middle of their interval, and Box and Muller's cosine: the same
// log everywhere. First the stamps are drawn, but for the first, and then what is added to each sample.
TEST(TakeLog, DrawsStampsEvenlyAndNoiseByBoxAndMuller) {
    drive::Acquisition noise;
    noise.excitation.amplitude = 0.0;
    noise.until_s = 0.05;
    noise.noise = 0.25;
    noise.quantum = 0.0;
    const auto log = drive::take_log(plants::sopdt(), noise, 11);
    std::mt19937_64 random(11);
    const auto uniform = [&] { return std::ldexp(static_cast<double>(random() >> 11) + 0.5, -53); };
    ASSERT_EQ(log.time_s.size(), 6U);
    EXPECT_EQ(log.time_s[0], 0.0);
    for (std::size_t k = 1; k < 6; ++k) {
        EXPECT_NEAR(log.time_s[k], 0.01 * static_cast<double>(k) + 0.001 * (2.0 * uniform() - 1.0), 1e-15) << k;
    }
    for (std::size_t k = 0; k < 6; ++k) {
        const double radius = std::sqrt(-2.0 * std::log(uniform()));
        EXPECT_NEAR(log.output[k], 0.25 * radius * std::cos(2.0 * std::numbers::pi * uniform()), 1e-12) << k;
    }
}

// What is prepared is what is fitted.
TEST(FitFromNothing, PreparesItsForm) {
    const auto record = drive::to_record(drive::take_log(plants::sopdt(), {}, 3));
    const auto found = drive::fit_from_nothing(Kind::sopdt, {record}, {}, [](drive::Form& form) {
        form.parameter("delay_s").value = 1.0;
        form.parameter("delay_s").fixed = true;
    });
    EXPECT_EQ(found.model.delay_s, 1.0);
}

}  // namespace
