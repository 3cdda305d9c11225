// How coverage is counted: what two runs say together follows from what they say alone.
#include "drive/coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "drive/response.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Acquisition;
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

TEST(TakeLog, IsTheExactResponseWithTheNoiseAndTheQuantumOfItsSeed) {
    const Acquisition rough{.excitation = {.name = "step"},
                            .until_s = 50.0,
                            .interval_s = 0.01,
                            .jitter_s = 0.002,
                            .noise = 0.02,
                            .quantum = 0.0};
    const auto log = drive::take_log(plants::sopdt(), rough, 7);
    ASSERT_EQ(log.time_s.size(), 5001U);
    EXPECT_EQ(log.name, "seed 7");
    EXPECT_EQ(log.time_s[0], 0.0);
    EXPECT_EQ(log.line[0], 2U);  // behind the header
    EXPECT_EQ(log.line[5000], 5002U);
    drive::StepResponse step(plants::sopdt());
    double latest = 0.0;
    double square = 0.0;
    double fourth = 0.0;
    double sum = 0.0;
    for (std::size_t k = 1; k < log.time_s.size(); ++k) {
        latest = std::max(latest, std::fabs(log.time_s[k] - 0.01 * static_cast<double>(k)));
        const double noise = log.output[k] - step(log.time_s[k]);
        sum += noise / 5000.0;
        square += noise * noise / 5000.0;
        fourth += noise * noise * noise * noise / 5000.0;
    }
    EXPECT_LE(latest, 0.002);
    EXPECT_GT(latest, 0.00199);
    EXPECT_NEAR(sum, 0.0, 0.0012);                       // four deviations of a mean
    EXPECT_NEAR(std::sqrt(square), 0.02, 0.0008);        // and of a deviation
    EXPECT_NEAR(fourth / (square * square), 3.0, 0.35);  // as of a normal one
    Acquisition counted = rough;
    counted.quantum = 0.008;
    const auto counts = drive::take_log(plants::sopdt(), counted, 7);
    EXPECT_EQ(counts.time_s, log.time_s);
    for (std::size_t k = 0; k < counts.output.size(); ++k) {
        ASSERT_NEAR(counts.output[k], 0.008 * std::round(log.output[k] / 0.008), 1e-12);
    }
    EXPECT_NE(drive::take_log(plants::sopdt(), rough, 8).output, log.output);
    const Acquisition usual;  // a laboratory's: 1000 counts a turn, 45 degrees as 1
    EXPECT_EQ(usual.excitation.name, "pulse");
    EXPECT_EQ(usual.excitation.amplitude, 1.0);
    EXPECT_EQ(usual.excitation.off_s, 2.6);
    EXPECT_EQ(usual.until_s, 5.0);
    EXPECT_EQ(usual.interval_s, 0.01);
    EXPECT_EQ(usual.jitter_s, 0.001);
    EXPECT_EQ(usual.noise, 0.01);
    EXPECT_EQ(usual.quantum, 0.008);
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
