// Sums over a whole known record: against the 50-digit sums, within the bound that the header states.
#include "drive/whole_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "base/failure.hpp"
#include "bench/sweep/signals.hpp"
#include "drive/fast_memory.hpp"
#include "drive/real_transform.hpp"
#include "reference/sums.hpp"

namespace {

using drive::RealTransform;
using drive::whole_record_error_bound;
using drive::whole_record_sums;

constexpr double orders[] = {0.5, 0.98319, 1.9909, -0.5};

// The exact sum of the numbers as they are.
reference::Exact exact_sum(std::span<const double> weights, std::span<const double> record, std::size_t k) {
    const std::vector<reference::Real> a(
        weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(std::min(weights.size(), k + 1)));
    const std::vector<double> newest_first(
        std::make_reverse_iterator(record.begin() + static_cast<std::ptrdiff_t>(k + 1)), record.rend());
    return reference::Exact(reference::sum(a, newest_first));
}

// The largest error over every `stride`-th sum, the first 300 and the last.
double largest_error(std::span<const double> weights, std::span<const double> record, std::size_t stride) {
    const std::vector<double> sums = whole_record_sums(weights, record);
    EXPECT_EQ(sums.size(), record.size());
    double largest = 0.0;
    for (std::size_t k = 0; k < sums.size();
         k += k < 300 || k + 1 == sums.size() ? 1 : std::min(stride, sums.size() - 1 - k)) {
        const double error = std::fabs(exact_sum(weights, record, k).error_of(sums[k]));
        EXPECT_FALSE(std::isnan(error)) << k;
        largest = std::max(largest, error);
    }
    return largest;
}

TEST(WholeRecord, StaysWithinTheBoundThatItStates) {
    constexpr std::size_t samples = 20'000;
    for (const double order : orders) {
        const auto weights = drive::record_weights(order, samples);
        for (const char* signal : {"step", "ramp", "sine5", "sine50", "noise"}) {
            const auto record = bench::make_signal(signal, samples, 2020);
            const double error = largest_error(weights, record, 499);
            const double bound = whole_record_error_bound(weights, record);
            EXPECT_LE(error, bound) << order << ' ' << signal;
            if (std::string_view(signal) == "step") {
                EXPECT_GE(error, 0.01 * bound) << order << ": a bound that says nothing";
            }
        }
    }
}

TEST(WholeRecord, IsTheSumAtEveryLengthOfRecordAndTable) {
    const auto record = bench::make_signal("noise", 700, 7);
    for (const std::size_t samples : {1, 2, 7, 8, 9, 15, 16, 17, 127, 128, 129, 130, 144, 145, 257, 700}) {
        for (const std::size_t taps : {1, 2, 15, 16, 17, 127, 128, 129, 300, 700, 900}) {
            const auto weights = drive::record_weights(-0.5, taps);
            const auto part = std::span(record).first(samples);
            EXPECT_LE(largest_error(weights, part, 1), whole_record_error_bound(weights, part))
                << samples << " samples, " << taps << " weights";
        }
    }
    EXPECT_TRUE(whole_record_sums(drive::record_weights(0.5, 3), {}).empty());
    EXPECT_THAT(whole_record_sums({}, std::vector<double>{1.0, 2.0}), testing::ElementsAre(0.0, 0.0));
}

// What a transform of everything would spoil: next to order 2 the weights are nearly 1, -2, 1, and what is behind them
// is small.
TEST(WholeRecord, KeepsTheFirstWeightsOutOfTheTransform) {
    constexpr std::size_t samples = 100'000;
    const auto weights = drive::record_weights(1.9909, samples);
    const std::vector<double> ones(samples, 1.0);
    const double error = largest_error(weights, ones, 9973);
    EXPECT_LE(error, 5e-16);
}

TEST(WholeRecord, AgreesWithTheSumsOfOneSampleAtATime) {
    constexpr std::size_t samples = 5000;
    const auto weights = drive::record_weights(0.5, samples);
    const auto record = bench::make_signal("noise", samples, 3);
    const auto sums = whole_record_sums(weights, record);
    drive::FastMemory memory(weights);
    for (std::size_t k = 0; k < samples; ++k) {
        ASSERT_NEAR(weights[0] * record[k] + memory.past(), sums[k], 1e-15) << k;
        memory.push(record[k]);
    }
}

// Of whole numbers, up to 128 weights of which are summed directly, every sum is exact; and nothing before or behind
// the record is looked at.
TEST(WholeRecord, UpTo128WeightsWholeNumbersStayWhole) {
    std::vector<double> around(400, 1e200);
    std::vector<double> weights(300, 1e200);
    const auto record = std::span(around).subspan(50, 300);
    for (std::size_t k = 0; k < record.size(); ++k) {
        record[k] = static_cast<double>(k * k % 101) - 50.0;
    }
    for (std::size_t j = 0; j < 128; ++j) {
        weights[j] = static_cast<double>(j * j * j % 127) - 60.0;
    }
    for (const std::size_t taps : {1, 2, 9, 16, 128}) {
        for (const std::size_t samples : {1, 7, 16, 128, 129, 300}) {
            const auto sums = whole_record_sums(std::span(weights).first(taps), record.first(samples));
            ASSERT_EQ(sums.size(), samples);
            for (std::size_t k = 0; k < samples; ++k) {
                double sum = 0.0;
                for (std::size_t j = 0; j < taps && j <= k; ++j) {
                    sum += weights[j] * record[k - j];
                }
                ASSERT_EQ(sums[k], sum) << taps << ' ' << samples << ' ' << k;
            }
        }
    }
    EXPECT_EQ(drive::record_weights(0.5, 3), (std::vector{1.0, -0.5, -0.125}));
}

// 144 samples with 114 weights are a convolution of 257, one more than a transform of 256 holds: what would come round
// falls on the first sum.
TEST(WholeRecord, NothingComesRoundFromTheEnd) {
    const auto sums = whole_record_sums(std::vector<double>(130, 1.0), std::vector<double>(160, 1.0));
    ASSERT_EQ(sums.size(), 160U);
    for (std::size_t k = 0; k < 160; ++k) {
        EXPECT_NEAR(sums[k], static_cast<double>(std::min<std::size_t>(k + 1, 130)), 1e-9) << k;
    }
}

TEST(WholeRecord, HasTheBoundOfItsFormula) {
    constexpr double u = 0x1.0p-53;
    // Without a transform: 2 |w_0| + 3 |w_1| + 4 |w_2|, by the largest sample.
    EXPECT_EQ(whole_record_error_bound(std::vector{1.0, -2.0, 3.0}, std::vector{4.0, -5.0, 1.0, 2.0}), u * 20.0 * 5.0);
    EXPECT_EQ(whole_record_error_bound(std::vector{1.0, -2.0, 3.0}, std::vector{0.0, 0.0}), 0.0);
    // With one: 16 weights of 3 so, and 114 of 3 by the lesser of their sum and of their norm times the record's.
    const std::vector<double> weights(130, 3.0);
    const double near = 3.0 * 152.0;  // 2 + 3 + ... + 17
    const auto bits = [](std::size_t convolved) {
        return std::log2(static_cast<double>(RealTransform::fast_length(convolved)));
    };
    for (const std::size_t samples : {159, 160}) {  // 256 is a fast length, 257 is none
        const double even_reach = 3.0 * std::sqrt(114.0) * 0.5 * std::sqrt(static_cast<double>(samples));
        EXPECT_NEAR(whole_record_error_bound(weights, std::vector<double>(samples, -0.5)) / u,
                    near * 0.5 + 17.0 * 3.0 * 114.0 * 0.5 + bits(samples + 97) * even_reach, 1e-9);
    }
    std::vector<double> impulse(160, 0.0);
    impulse[7] = 5.0;
    const double reach = 3.0 * std::sqrt(114.0) * 5.0;
    EXPECT_NEAR(whole_record_error_bound(weights, impulse) / u, near * 5.0 + 17.0 * reach + bits(257) * reach, 1e-9);
}

TEST(WholeRecord, RefusesWhatIsNoNumber) {
    std::vector<double> record(200, 1.0);
    const std::vector<double> weights(200, 1.0);
    record[150] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)whole_record_sums(weights, record), glsum::Failure);
    EXPECT_THROW((void)whole_record_sums(record, weights), glsum::Failure);
    record[150] = -std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)whole_record_sums(weights, record), glsum::Failure);
}

TEST(RealTransform, IsTheDefinition) {
    constexpr std::size_t length = 48;
    const auto record = bench::make_signal("noise", length, 5);
    RealTransform::Buffer buffer(length);
    std::copy(record.begin(), record.end(), buffer.reals().begin());
    const RealTransform& transform = RealTransform::of(length);
    transform.forward(buffer);
    for (std::size_t m = 0; m <= length / 2; ++m) {
        std::complex<double> sum = 0.0;
        for (std::size_t n = 0; n < length; ++n) {
            sum += record[n] * std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(m * n % length) / length);
        }
        EXPECT_NEAR(std::abs(buffer.spectrum()[m] - sum), 0.0, 1e-13) << m;
    }
    // Its own spectrum with that of a delay of two comes back delayed by two, round the end.
    RealTransform::Buffer delay(length);
    delay.reals()[2] = 1.0;
    transform.forward(delay);
    transform.convolve(buffer, delay);
    for (std::size_t n = 0; n < length; ++n) {
        EXPECT_NEAR(buffer.reals()[(n + 2) % length], record[n], 1e-15) << n;
    }
    EXPECT_EQ(&RealTransform::of(length), &transform);
    EXPECT_THROW((void)RealTransform::of(0), std::invalid_argument);
}

TEST(RealTransform, FastLengthsAreTheLeastOfTheirKind) {
    for (std::size_t count = 1; count <= 3000; ++count) {
        std::size_t least = (count + 15) / 16 * 16;
        for (;; least += 16) {
            std::size_t rest = least;
            for (const std::size_t factor : {2, 3, 5}) {
                while (rest % factor == 0) {
                    rest /= factor;
                }
            }
            if (rest == 1) {
                break;
            }
        }
        ASSERT_EQ(RealTransform::fast_length(count), least) << count;
    }
    EXPECT_EQ(RealTransform::fast_length(199'935), 200'000U);
}

}  // namespace
