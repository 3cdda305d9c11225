#include "bench/sweep/signals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/sweep/signal_derivatives.hpp"

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

// 0.18234 D^1.9909 y + 0.65536 D^0.98319 y + 0.9992 y = 1 from rest, by the Grünwald-Letnikov scheme, in counts of an
// encoder of 1000 a turn for 45 degrees.
TEST(Signals, DriveIsTheIdentifiedPlantsStepInCounts) {
    constexpr std::size_t samples = 1200;
    const auto weights = [](double order) {
        std::vector<double> a = {1.0};
        for (std::size_t j = 1; j < samples; ++j) {
            a.push_back(a.back() * (1.0 - (order + 1.0) / static_cast<double>(j)));
        }
        return a;
    };
    const std::vector<double> high = weights(1.9909);
    const std::vector<double> low = weights(0.98319);
    const double of_high = 0.18234 * std::pow(1e-3, -1.9909);
    const double of_low = 0.65536 * std::pow(1e-3, -0.98319);
    std::vector<double> y(samples, 0.0);
    double peak = 0.0;
    for (std::size_t k = 1; k < samples; ++k) {
        double past = 0.0;
        for (std::size_t j = 1; j <= k; ++j) {
            past += (of_high * high[j] + of_low * low[j]) * y[k - j];
        }
        y[k] = (1.0 - past) / (of_high + of_low + 0.9992);
        peak = std::max(peak, std::round(125.0 * y[k]));
    }
    const auto x = bench::make_signal("drive", samples, 1);
    for (std::size_t k = 0; k < samples; ++k) {
        const double counts = 125.0 * y[k];
        if (std::fabs(counts - std::floor(counts) - 0.5) > 1e-6) {  // else rounding decides
            EXPECT_NEAR(x[k] / 0.9 * peak, std::round(counts), 1e-9) << k;
        }
    }
}

// At other steps it is the same response: taken from a record of at most 1 ms, at rest long before it ends.
TEST(Signals, DriveIsTheSameAtEveryStep) {
    const auto counts_at = [](double h_s, std::size_t samples) {
        std::vector<double> x = bench::make_signal("drive", samples, 1, h_s);
        const double rest = x.back();
        for (double& sample : x) {
            sample = sample / rest * 125.0;  // of 1 / 0.9992
        }
        return x;
    };
    const auto fine = counts_at(1e-3, 8001);
    for (const std::size_t times : {2U, 4U, 100U}) {
        const auto coarse = counts_at(1e-3 * static_cast<double>(times), 8000 / times + 1);
        for (std::size_t k = 0; k < coarse.size(); ++k) {
            ASSERT_NEAR(coarse[k], fine[k * times], 1e-9) << times << ' ' << k;
        }
    }
    // Of 2.5 ms each in thirds, of 0.5 ms as it is: within the scheme's error, a tenth of a count or so.
    for (const double h_s : {0.5e-3, 2.5e-3}) {
        const auto other = counts_at(h_s, static_cast<std::size_t>(8.0 / h_s) + 1);
        for (const double t : {0.25, 0.5, 1.0, 2.0}) {
            const double at = other[static_cast<std::size_t>(std::lround(t / h_s))];
            EXPECT_NEAR(at, fine[static_cast<std::size_t>(std::lround(t / 1e-3))], 1.0) << h_s << ' ' << t;
        }
    }
    const auto slow = counts_at(1.0, 200);
    for (std::size_t k = 20; k < slow.size(); ++k) {
        EXPECT_EQ(slow[k], 125.0);
    }
    EXPECT_TRUE(bench::make_signal("drive", 0, 1).empty());
    EXPECT_EQ(bench::make_signal("drive", 1, 1), std::vector<double>{0.0});  // at rest: nothing to scale
}

// However small the step and many the samples, it goes on: from 1 s to 1.1 s it rises by seven counts.
TEST(Signals, DriveGoesOnUntilItRests) {
    const auto usual = bench::make_signal("drive", 1101, 1);
    const auto fine = bench::make_signal("drive", 55001, 1, 2e-5);
    const double counts = std::round(0.8458264529 * 125.0);  // of the last sample, the largest
    for (std::size_t k = 0; k < usual.size(); ++k) {
        ASSERT_NEAR(fine[50 * k], usual[k], 2.0 * 0.9 / counts) << k;
    }
}

TEST(Signals, DriveRestsAtTheSecondSampleOfAnyLongStep) {
    for (const double h_s : {20.0, 21.0, 1e30}) {
        EXPECT_EQ(bench::make_signal("drive", 3, 1, h_s), (std::vector<double>{0.0, 0.9, 0.9})) << h_s;
    }
}

// Where the step divides the period the sine repeats to the last bit, elsewhere it goes on.
TEST(Signals, SinesRepeatWhereTheStepDividesThePeriod) {
    for (const double h_s : {1e-3, 0.5e-3, 0.7e-3}) {
        const auto x = bench::make_signal("sine50", 700, 1, h_s);
        bool repeats = true;
        const auto period = static_cast<std::size_t>(std::lround(0.02 / h_s));
        for (std::size_t k = 0; k < x.size(); ++k) {
            EXPECT_NEAR(x[k], 0.9 * std::sin(2.0 * std::acos(-1.0) * 50.0 * h_s * static_cast<double>(k)), 1e-12) << k;
            repeats = repeats && (k < period || x[k] == x[k - period]);
        }
        EXPECT_EQ(repeats, h_s != 0.7e-3) << h_s;
    }
    for (const char* name : {"sine1", "sine5"}) {
        const auto x = bench::make_signal(name, 2500, 1);
        for (std::size_t k = 1000; k < x.size(); ++k) {
            ASSERT_EQ(x[k], x[k - 1000]) << name;
        }
    }
}

// Four samples a second, or nearly: within 1e-12 of the period it repeats, beyond it goes on.
TEST(Signals, APeriodIsWholeToTwelveDigits) {
    const auto fifth = [](double steps_off) {
        return bench::make_signal("sine1", 9, 1, 0.25 + steps_off * 0x1p-54)[4];  // off by so many 2^-52 of it
    };
    EXPECT_EQ(fifth(0.0), 0.0);
    EXPECT_EQ(fifth(4480.0), 0.0);  // 9.95e-13
    EXPECT_EQ(fifth(-4480.0), 0.0);
    EXPECT_NEAR(fifth(4530.0), 0.9 * 2.0 * std::acos(-1.0) * 4530.0 * 0x1p-52, 1e-16);  // 1.006e-12
    EXPECT_NEAR(fifth(-4530.0), -0.9 * 2.0 * std::acos(-1.0) * 4530.0 * 0x1p-52, 1e-16);
}

TEST(Signals, ASineNeedsTwoSamplesAPeriod) {
    EXPECT_TRUE(bench::can_be_sampled("sine50", 0.0099));
    EXPECT_FALSE(bench::can_be_sampled("sine50", 0.01));
    EXPECT_TRUE(bench::can_be_sampled("sine1", 0.49));
    EXPECT_FALSE(bench::can_be_sampled("sine1", 0.5));
    EXPECT_TRUE(bench::can_be_sampled("noise", 1e3));
}

TEST(Signals, ARampGoesFromNothingToThePeak) {
    EXPECT_EQ(bench::make_signal("ramp", 4, 1), (std::vector<double>{0.0, 0.9 / 3.0, 0.9 * 2.0 / 3.0, 0.9}));
    EXPECT_EQ(bench::make_signal("ramp", 1, 1), std::vector<double>{0.0});
    EXPECT_EQ(bench::make_signal("step", 3, 1), std::vector<double>(3, 0.9));
    // Each sample of noise is a generator's number of 53 bits, to -0.9 ... 0.9.
    std::mt19937_64 generator(7);
    for (const double sample : bench::make_signal("noise", 5, 7)) {
        EXPECT_EQ(sample, 0.9 * (2.0 * std::ldexp(static_cast<double>(generator() >> 11), -53) - 1.0));
    }
}

}  // namespace
