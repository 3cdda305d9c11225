// How near a filter comes to a derivative: closed forms, and a certificate that no point exceeds.
#include "glsum/design/derivative.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "glsum/design/modes.hpp"

namespace {

using namespace glsum::design;

DerivativeGoal half(double low_hz, double high_hz, double step_until_s) {
    DerivativeGoal goal{0.5, 0.001, Band{low_hz, high_hz}};
    if (step_until_s > 0.0) {
        goal.step_until_s = step_until_s;
    }
    return goal;
}

// Modes of the sum's own weights, times h^-v.
Filter of_the_sum(const DerivativeGoal& goal, std::size_t near_taps, std::size_t modes) {
    const Approximation found = approximate({goal.order, goal.horizon()}, near_taps, modes);
    Filter filter{weights_to(goal.order, near_taps - 1), found.modes};
    const double factor = std::pow(goal.step_s, -goal.order);
    for (double& tap : filter.taps) {
        tap *= factor;
    }
    for (Mode& mode : filter.modes) {
        mode.weight *= factor;
    }
    return filter;
}

TEST(Derivative, ADifferenceOfOrderOneIsWithinItsClosedForm) {
    DerivativeGoal goal{1.0, 0.01, Band{1.0, 20.0}};
    const DerivativeError error = error_at_points({{100.0, -100.0}, {}}, goal);
    // (1 - e^-ia) / (ia) - 1, largest at the highest frequency.
    const double angle = 2.0 * std::numbers::pi * 20.0 * 0.01;
    const std::complex<double> i(0.0, 1.0);
    EXPECT_NEAR(error.band, std::abs((1.0 - std::exp(-i * angle)) / (i * angle) - 1.0), 1e-12);
    EXPECT_EQ(error.band_hz, 20.0);
    EXPECT_EQ(error.step, 0.0);
}

TEST(Derivative, TheStepOfALongSumIsThatOfTheWeights) {
    // sum_{j<=k} a_j = Gamma(k + 1 - v) / (Gamma(1 - v) Gamma(k + 1)).
    const DerivativeGoal goal = half(1.0, 10.0, 0.5);
    Filter filter{weights_to(0.5, 500), {}};
    for (double& tap : filter.taps) {
        tap *= std::pow(0.001, -0.5);
    }
    const DerivativeError error = error_at_points(filter, goal);
    const double sum = std::exp(std::lgamma(10.5) - std::lgamma(11.0)) / std::tgamma(0.5);
    const double exact = std::pow(10.0, -0.5) / std::tgamma(0.5);
    EXPECT_NEAR(error.step, std::fabs(sum / exact - 1.0), 1e-9);
    EXPECT_DOUBLE_EQ(error.step_s, 0.01);
}

TEST(Derivative, ExactValuesAreThoseOfTheTables) {
    EXPECT_NEAR(exact_step(0.5, 5.0), 0.25231325220201600, 1e-15);  // 1/sqrt(5 pi)
    EXPECT_NEAR(exact_step(-0.5, 4.0), 4.0 / std::sqrt(std::numbers::pi), 1e-14);
    EXPECT_NEAR(exact_response(0.5, 1.0).real(), std::sqrt(std::numbers::pi), 1e-14);
    EXPECT_NEAR(exact_response(0.5, 1.0).imag(), std::sqrt(std::numbers::pi), 1e-14);
    EXPECT_FALSE(has_step(1.0));
    EXPECT_FALSE(has_step(2.0));
    EXPECT_TRUE(has_step(-1.0));
    EXPECT_TRUE(has_step(0.0));
}

// The weights one by one, and the answer to a wave by running them.
TEST(Derivative, FullMemoryAnswersAsItsWeightsDo) {
    for (const double order : {0.2, 0.5, 1.5, -0.5}) {
        constexpr double step_s = 0.01;
        const double scale = std::pow(step_s, -order);
        double weight = 1.0;
        double sum = 1.0;
        std::complex<double> response = 1.0;
        constexpr double angle = 0.7;
        constexpr int n = 200'000;
        for (int j = 1; j <= n; ++j) {
            weight *= 1.0 - (order + 1.0) / j;
            sum += weight;
            response += weight * std::polar(1.0, -angle * j);
            if (j == 10 || j == 999) {
                EXPECT_NEAR(full_memory_step(order, step_s, j) / (scale * sum), 1.0, 1e-11) << order << " " << j;
            }
        }
        // The tail is nearly geometric: a_n e^(-jan) q / (1 - q) with q = e^(-ja).
        const std::complex<double> q = std::polar(1.0, -angle);
        response += weight * std::polar(1.0, -angle * n) * q / (1.0 - q);
        EXPECT_LT(std::abs(full_memory_response(order, step_s, angle) / (scale * response) - 1.0), 1e-7) << order;
    }
}

TEST(Derivative, NoPointExceedsTheCertificate) {
    std::mt19937 random(5);
    for (const double order : {0.2, 0.5, 0.9, -0.5, 1.5}) {
        for (const std::size_t modes : {1U, 3U, 6U}) {
            DerivativeGoal goal{order, 0.001, Band{0.3, 120.0}};
            goal.step_until_s = 2.0;
            const Filter filter = of_the_sum(goal, 3, modes);
            const DerivativeError certified = certified_error(filter, goal);
            double band = 0.0;
            std::uniform_real_distribution<double> share(0.0, 1.0);
            for (int i = 0; i < 20'000; ++i) {
                const double hz = 0.3 * std::pow(400.0, share(random));
                const auto exact = exact_response(order, hz);
                band = std::max(
                    band, std::abs(frequency_response(filter, 2.0 * std::numbers::pi * hz * 0.001) / exact - 1.0));
            }
            EXPECT_LE(band, certified.band) << order << ", " << modes;
            EXPECT_GE(band, certified.band / 1.006) << order << ", " << modes;
            double step = 0.0;
            for (std::size_t k = 10; k <= 2000; ++k) {
                const double exact = exact_step(order, 0.001 * static_cast<double>(k));
                step = std::max(step, std::fabs(step_response(filter, k) / exact - 1.0));
            }
            EXPECT_NEAR(certified.step, step, 1e-9 * (1.0 + step)) << order << ", " << modes;
        }
    }
}

// Where the error is largest at an end of the band, the certificate says so: a difference errs most at the highest
// frequency, a constant for a derivative at the lowest.
TEST(Derivative, TheCertificateNamesTheEndOfTheBand) {
    const DerivativeGoal goal{1.0, 0.01, Band{1.0, 20.0}, {}};
    const std::complex<double> i(0.0, 1.0);
    const double angle = 2.0 * std::numbers::pi * 20.0 * 0.01;
    const double of_difference = std::abs((1.0 - std::exp(-i * angle)) / (i * angle) - 1.0);
    const double of_constant = std::abs(50.0 / (i * 2.0 * std::numbers::pi) - 1.0);
    const DerivativeError difference = certified_error({{100.0, -100.0}, {}}, goal);
    EXPECT_EQ(difference.band_hz, 20.0);
    EXPECT_GE(difference.band, of_difference * (1.0 - 1e-12));
    EXPECT_LE(difference.band, of_difference * 1.006);
    const DerivativeError constant = certified_error({{50.0}, {}}, goal);
    EXPECT_EQ(constant.band_hz, 1.0);
    EXPECT_GE(constant.band, of_constant * (1.0 - 1e-12));
    EXPECT_LE(constant.band, of_constant * 1.006);
}

TEST(Derivative, NoPointOfAModeThatSwingsExceedsTheCertificate) {
    for (const double decay : {1.2, 1.6, 1.9}) {
        // Up to half the sample's rate, where its answer is largest.
        DerivativeGoal goal{0.9, 0.001, Band{5.0, 500.0}};
        goal.step_until_s = 0.2;
        const Filter filter{{800.0}, {{0.1, -40.0}, {decay, -300.0}}};
        const DerivativeError certified = certified_error(filter, goal);
        double band = 0.0;
        for (int i = 0; i <= 20'000; ++i) {
            const double hz = 5.0 * std::pow(100.0, i / 20'000.0);
            const auto delay = std::polar(1.0, -2.0 * std::numbers::pi * hz * 0.001);
            const auto response =
                800.0 - 40.0 * delay / (1.0 - 0.9 * delay) - 300.0 * delay / (1.0 - (1.0 - decay) * delay);
            band = std::max(band, std::abs(response / exact_response(0.9, hz) - 1.0));
        }
        EXPECT_LE(band, certified.band * (1.0 + 1e-12)) << decay;
        EXPECT_GE(band, certified.band / 1.006) << decay;
        double step = 0.0;
        double slow = 0.0;
        double swinging = 0.0;
        for (std::size_t k = 1; k <= 200; ++k) {
            slow = 0.9 * slow + 1.0;
            swinging = (1.0 - decay) * swinging + 1.0;
            EXPECT_NEAR(step_response(filter, k), 800.0 - 40.0 * slow - 300.0 * swinging, 1e-9) << decay << " " << k;
            if (k >= 10) {
                const double exact = exact_step(0.9, 0.001 * static_cast<double>(k));
                step = std::max(step, std::fabs((800.0 - 40.0 * slow - 300.0 * swinging) / exact - 1.0));
            }
        }
        EXPECT_NEAR(certified.step / step, 1.0, 1e-9) << decay;
    }
}

TEST(Derivative, APeakOfModesThatSwingIsCertified) {
    // They cancel at half the sample's rate, and peak a hundredth before it.
    const DerivativeGoal goal{0.9, 0.001, Band{400.0, 500.0}, {}};
    const Filter filter{{800.0}, {{1.97, 300.0}, {1.99, -100.0}}};
    const DerivativeError certified = certified_error(filter, goal);
    const auto error_at = [&](double hz) {
        const auto response = frequency_response(filter, 2.0 * std::numbers::pi * hz * 0.001);
        return std::abs(response / exact_response(0.9, hz) - 1.0);
    };
    double dense = 0.0;
    for (double hz = 400.0; hz <= 500.0; hz += 0.01) {
        dense = std::max(dense, error_at(hz));
    }
    EXPECT_GT(dense, 1.5 * error_at_points(filter, goal).band);
    EXPECT_LE(dense, certified.band);
    EXPECT_GE(dense, certified.band / 1.006);
    EXPECT_GE(error_at(certified.band_hz), certified.band / 1.006);  // where it says
}

TEST(Derivative, APeakBetweenTheSearchPointsIsCertified) {
    // A long window ripples faster than the points of a search lie.
    const DerivativeGoal goal = half(1.0, 400.0, 0.0);
    Filter filter{weights_to(0.5, 700), {}};
    for (double& tap : filter.taps) {
        tap *= std::pow(0.001, -0.5);
    }
    filter.taps.back() += 3.0;  // a ripple of 1.4 Hz
    const double at_points = error_at_points(filter, goal).band;
    const DerivativeError certified = certified_error(filter, goal);
    EXPECT_GT(certified.band, at_points);
    const auto error_at = [&](double hz) {
        const auto response = frequency_response(filter, 2.0 * std::numbers::pi * hz * 0.001);
        return std::abs(response / exact_response(0.5, hz) - 1.0);
    };
    double dense = 0.0;
    for (double hz = 1.0; hz <= 400.0; hz += 0.01) {
        dense = std::max(dense, error_at(hz));
    }
    EXPECT_LE(dense, certified.band);
    EXPECT_GE(dense, certified.band / 1.006);
    EXPECT_GE(error_at(certified.band_hz), certified.band / 1.006);
}

// An interval's bound, where nothing is halved: the larger error of its ends times the ratio of w^v there. A second
// derivative adds at most width^2/8 of itself to a chord, over the least w^v.
TEST(Derivative, AnIntervalCostsItsRatioAndItsCurvature) {
    for (const double order : {0.5, -0.5}) {
        const DerivativeGoal goal{order, 0.001, Band{10.0, 10.02}};
        const double low = 2.0 * std::numbers::pi * 10.0 * 0.001;
        const double high = 2.0 * std::numbers::pi * 10.02 * 0.001;
        const double scale = std::pow(0.001, -order);
        const double least = scale * std::min(std::pow(low, order), std::pow(high, order));
        Filter filter{std::vector<double>(51, 0.0), {}};
        filter.taps[0] = 0.6 * least;
        filter.taps[50] = 0.05 * least;
        const auto error_at = [&](double angle) {
            const std::complex<double> response = filter.taps[0] + filter.taps[50] * std::polar(1.0, -50.0 * angle);
            const std::complex<double> exact = scale * std::pow(std::complex<double>(0.0, angle), order);
            return std::abs(response / exact - 1.0);
        };
        const double curvature =
            50.0 * 50.0 * filter.taps[50] + std::fabs(order * (order - 1.0)) * scale * std::pow(low, order - 2.0);
        const double expected = std::max(error_at(low), error_at(high)) * std::pow(1.002, std::fabs(order)) +
                                curvature * (high - low) * (high - low) / 8.0 / least;
        EXPECT_NEAR(certified_error(filter, goal).band, expected, 1e-11) << order;
    }
}

// Silence errs by 1 everywhere; of order 1 nothing bends, and a bound is the ratio of its interval's ends. Half a
// percent is left as it is, what is wider is halved.
TEST(Derivative, IntervalsAreHalvedBeyondHalfAPercent) {
    const auto certified = [](double ratio) {
        return certified_error({{0.0}, {}}, {1.0, 0.001, Band{100.0, 100.0 * ratio}}).band;
    };
    EXPECT_NEAR(certified(1.0045), 1.0045, 1e-9);
    EXPECT_NEAR(certified(1.0055), 1.00275, 1e-9);  // its first half's
}

// Thirty-two a decade, evenly in the logarithm; samples one by one, and 4 % apart once that is more.
TEST(Derivative, PointsLieAsDenselyAsStated) {
    const std::vector<double> frequencies = frequencies_of(half(1.0, 100.0, 0.0));
    ASSERT_EQ(frequencies.size(), 65U);
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        EXPECT_NEAR(std::log10(frequencies[i]), static_cast<double>(i) / 32.0, 1e-12) << i;
    }
    std::vector<std::size_t> expected;
    for (double k = 10.0; k < 500.0; k = k < 25.0 ? k + 1.0 : 1.04 * k) {
        expected.push_back(static_cast<std::size_t>(k));
    }
    expected.push_back(500);
    EXPECT_EQ(samples_of(half(1.0, 2.0, 0.5)), expected);
    EXPECT_EQ(samples_of(half(1.0, 2.0, 0.012)), (std::vector<std::size_t>{10, 11, 12}));
    EXPECT_EQ(samples_of(half(1.0, 2.0, 0.010)), (std::vector<std::size_t>{10}));
    EXPECT_EQ(samples_of(half(1.0, 2.0, 0.009)), std::vector<std::size_t>{});
    EXPECT_EQ(half(1.0, 2.0, 0.0).last_of_step(), 0U);
}

TEST(Derivative, PointsCoverBothEnds) {
    const DerivativeGoal goal = half(0.05, 80.0, 60.0);
    EXPECT_EQ(frequencies_of(goal).front(), 0.05);
    EXPECT_EQ(frequencies_of(goal).back(), 80.0);
    EXPECT_EQ(samples_of(goal).front(), 10U);
    EXPECT_EQ(samples_of(goal).back(), 60'000U);
    EXPECT_EQ(goal.last_of_step(), 60'000U);
    EXPECT_EQ(goal.horizon(), 60'000U);
    EXPECT_EQ(half(0.05, 80.0, 0.0).horizon(), 20'000U);                          // a period
    EXPECT_EQ((DerivativeGoal{0.5, 0.001, std::nullopt, 0.0001}).horizon(), 1U);  // a sample at least
    EXPECT_EQ(samples_of(half(1.0, 2.0, 0.0)).size(), 0U);
    EXPECT_EQ(frequencies_of(half(2.0, 2.0, 0.0)).size(), 1U);
    // Each sample once, the next one or one that is 4 % later.
    const std::vector<std::size_t> samples = samples_of(goal);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        EXPECT_GT(samples[i], samples[i - 1]);
        EXPECT_LE(static_cast<double>(samples[i]), 1.04 * static_cast<double>(samples[i - 1] + 1));
    }
}

}  // namespace
