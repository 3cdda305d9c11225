#include "bench/signals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "bench/signal_derivatives.hpp"

namespace {

double peak(const std::vector<double>& x) {
    double largest = 0.0;
    for (const double sample : x) {
        largest = std::max(largest, std::fabs(sample));
    }
    return largest;
}

TEST(Signals, PeakAtOrJustBelowNineTenths) {
    for (const std::string_view name : bench::signal_names) {
        for (const std::size_t samples : {1000U, 5000U}) {
            const auto x = bench::make_signal(name, samples, 1);
            ASSERT_EQ(x.size(), samples);
            EXPECT_LE(peak(x), 0.9 * (1.0 + 1e-15)) << name;
            EXPECT_GE(peak(x), 0.895) << name;
        }
    }
}

TEST(Signals, NoiseIsFixedByItsSeedAndWhite) {
    const auto x = bench::make_signal("noise", 5000, 2020);
    EXPECT_EQ(x, bench::make_signal("noise", 5000, 2020));
    EXPECT_NE(x, bench::make_signal("noise", 5000, 2021));
    // mt19937_64's own published check: its 10000th number from the default seed.
    std::mt19937_64 generator;
    generator.discard(9999);
    EXPECT_EQ(generator(), 9981545732273789042ULL);
    double mean = 0.0;
    double square = 0.0;
    double neighbours = 0.0;
    for (std::size_t k = 1; k < x.size(); ++k) {
        mean += x[k];
        square += x[k] * x[k];
        neighbours += x[k] * x[k - 1];
    }
    EXPECT_NEAR(mean / 5000.0, 0.0, 0.03);
    EXPECT_NEAR(square / 5000.0, 0.27, 0.02);  // 0.9^2 / 3
    EXPECT_NEAR(neighbours / square, 0.0, 0.06);
}

// Exact step response of (12) without delay: 0.375940553 at 0.5 s, 1.0119932 at 2 s, 0.9994 at 3 s.
TEST(Signals, DriveFollowsTheExactStepResponseWithinItsQuantum) {
    const auto x = bench::make_signal("drive", 5000, 1);
    const double scale = x[2000] / (std::round(1.0119932474 * 125.0) / 125.0);
    EXPECT_NEAR(x[500] / scale, 0.375940553423, 0.5 / 125.0 + 1e-3);
    EXPECT_NEAR(x[3000] / scale, 0.999400058443, 0.5 / 125.0 + 1e-3);
    for (const double sample : x) {
        const double counts = sample / scale * 125.0;
        ASSERT_NEAR(counts, std::round(counts), 1e-9);
    }
}

TEST(Signals, SinesHaveTheFrequencyOfTheirName) {
    for (const unsigned hz : {1U, 5U, 50U}) {
        const std::string name = "sine" + std::to_string(hz);
        EXPECT_EQ(bench::sine_hz(name), hz);
        EXPECT_NEAR(bench::make_signal(name, 1000, 1)[250 / hz], bench::signal_peak, 1e-15) << name;  // a quarter turn
    }
    EXPECT_FALSE(bench::sine_hz("noise"));
}

// Order 0 gives the signal back and order 1 its slope; so the formula is that of the record, phase, peak and unit.
TEST(Signals, DerivativesAreOfTheVeryRecord) {
    for (const std::string_view name : bench::signal_names) {
        const auto x = bench::make_signal(name, 1000, 1);
        const auto derivative = bench::derivative_of_signal(name, x.size());
        ASSERT_EQ(static_cast<bool>(derivative), name != "noise" && name != "drive") << name;
        for (std::size_t k = 2; derivative && k + 2 < x.size(); k += 83) {
            const reference::Real t = k * reference::Real(bench::step_s);
            EXPECT_NEAR(static_cast<double>(derivative(0, t)), x[k], 1e-13) << name << ' ' << k;
            const double slope =
                (8.0 * (x[k + 1] - x[k - 1]) - (x[k + 2] - x[k - 2])) / (12.0 * bench::step_s);  // fourth order in h
            EXPECT_NEAR(static_cast<double>(derivative(1, t)), slope, 0.1) << name << ' ' << k;
        }
    }
    EXPECT_FALSE(bench::derivative_of_signal("ramp", 1));
}

TEST(Signals, RefusesAnUnknownName) { EXPECT_THROW((void)bench::make_signal("square", 10, 1), std::out_of_range); }

}  // namespace
