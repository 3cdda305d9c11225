// modessum: against closed forms and a sum of its own in long double; no drift; a level is added up for ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "glsum/bound.hpp"
#include "glsum/design/integral.hpp"
#include "glsum/registry.hpp"

namespace {

using glsum::Mode;
using glsum::design::weights_to;

template <class K>
struct Line {
    explicit Line(const glsum::Design& design) : table(K::table_count(design.taps)), past(K::past_count(design.taps)) {
        status = K::prepare(state, design, table, past);
    }
    std::vector<typename K::Coefficient> table;
    std::vector<typename K::Sample> past;
    typename K::State state{};
    glsum::Status status;
};

template <class K>
class IntegralTest : public ::testing::Test {};
using Kernels = ::testing::Types<glsum::Sum<glsum::Integrator, glsum::Plain, glsum::F64>,
                                 glsum::Sum<glsum::Integrator, glsum::Plain, glsum::F32>,
                                 glsum::Sum<glsum::Integrator, glsum::Compensated, glsum::F32>>;
TYPED_TEST_SUITE(IntegralTest, Kernels);

TYPED_TEST(IntegralTest, OfOrderMinusOneIsTheRunningSum) {
    const std::vector<Mode> modes{{0.0, 1.0}};
    Line<TypeParam> line({-1.0, 3, modes});
    ASSERT_EQ(line.status, glsum::Status::ok);
    // One word of single precision stops counting at 2^24.
    const std::size_t count = std::size_t{1} << 25;
    for (std::size_t k = 0; k < count; ++k) {
        const auto sum = static_cast<double>(TypeParam::step(line.state, 1));
        if (k % 999983 == 0 || k + 1 == count) {
            const auto exact = static_cast<double>(k + 1);
            ASSERT_NEAR(sum, exact, 2.0 * exact * TypeParam::FormatPart::data_roundoff);
        }
    }
    TypeParam::reset(line.state);
    EXPECT_EQ(TypeParam::step(line.state, 1), 1);
    EXPECT_EQ(TypeParam::step(line.state, 1), 2);
}

/// The greatest error of a kernel over a record of `samples` around `mean`, against the design's own sum in long
/// double.
template <class K>
double worst_error(const glsum::Design& asked, std::size_t near_taps, double mean, std::size_t samples) {
    Line<K> line(asked);
    EXPECT_EQ(line.status, glsum::Status::ok);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> noise(-0.3, 0.3);
    std::vector<double> near(near_taps, 0.0);  // x_k, x_(k-1), ...
    std::vector<long double> states(asked.modes.size(), 0.0L);
    const std::vector<double> a = weights_to(asked.order, near_taps);
    double worst = 0.0;
    for (std::size_t k = 0; k < samples; ++k) {
        const double x = mean + noise(random);
        const long double leaving = near.back();
        near.insert(near.begin(), x);
        near.pop_back();
        long double exact = 0.0L;
        for (std::size_t m = 0; m < states.size(); ++m) {
            states[m] = (1.0L - asked.modes[m].decay) * states[m] + leaving;
            exact += asked.modes[m].weight * states[m];
        }
        for (std::size_t j = 0; j < near.size(); ++j) {
            exact += static_cast<long double>(a[j]) * near[j];
        }
        const auto sum = K::step(line.state, static_cast<typename K::Sample>(x));
        worst = std::max(worst, static_cast<double>(std::fabs(static_cast<long double>(sum) - exact)));
    }
    return worst;
}

TYPED_TEST(IntegralTest, StaysWithinItsBoundOverARecordOfAnyMean) {
    constexpr std::size_t samples = 100'000;
    const glsum::design::Approximation design =
        glsum::design::approximate_integral(weights_to(-0.5, samples), -0.5, 3, 8);
    ASSERT_EQ(design.modes.front().decay, 0.0);
    const std::vector<Mode> alone{{0.0, 1.0}};
    const glsum::Design half{-0.5, design.length(), design.modes};
    // At order -1 the running sum is all there is, so that nothing else of the bound can make up for its share.
    const glsum::Design whole{-1.0, 3, alone};
    for (const double mean : {0.0, 0.7}) {
        for (const bool of_order_half : {true, false}) {
            const glsum::Design& asked = of_order_half ? half : whole;
            Line<TypeParam> line(asked);
            const double bound = glsum::error_bound<TypeParam>(asked, line.state, 1.0, samples);
            const double worst = worst_error<TypeParam>(asked, of_order_half ? 3 : 1, mean, samples);
            EXPECT_LE(worst, bound) << asked.order << " " << mean;
            EXPECT_GT(worst, 0.0) << asked.order << " " << mean;
        }
    }
}

TYPED_TEST(IntegralTest, IsItsModesAndANeumaierSumBitForBit) {
    using Sample = typename TypeParam::Sample;
    for (const std::size_t near_taps : {1U, 2U, 4U}) {
        const auto design = glsum::design::approximate_integral(weights_to(-0.5, 1000), -0.5, near_taps, 5);
        const glsum::Design asked{-0.5, design.length(), design.modes};
        Line<TypeParam> line(asked);
        Line<typename TypeParam::Inner> modes(TypeParam::inner_design(asked));
        ASSERT_EQ(line.status, glsum::Status::ok);
        ASSERT_EQ(modes.status, glsum::Status::ok);
        const auto weight = static_cast<Sample>(design.modes.front().weight);
        std::vector<Sample> past(near_taps, 0);
        Sample total = 0;
        Sample lost = 0;
        std::mt19937_64 random(near_taps);
        std::uniform_real_distribution<double> noise(-0.2, 1.0);
        for (std::size_t k = 0; k < 3000; ++k) {
            const auto x = static_cast<Sample>(noise(random));
            const volatile Sample product = weight * (total + lost);
            const Sample expected = TypeParam::Inner::step(modes.state, x) + product;
            ASSERT_EQ(TypeParam::step(line.state, x), expected) << near_taps << " " << k;
            past.insert(past.begin(), x);
            const Sample leaving = past[near_taps - 1];
            past.pop_back();
            const Sample after = total + leaving;
            lost += std::fabs(total) >= std::fabs(leaving) ? (total - after) + leaving : (leaving - after) + total;
            total = after;
        }
    }
}

TYPED_TEST(IntegralTest, AddsALevelUpForEver) {
    constexpr std::size_t horizon = 600;
    const auto design = glsum::design::approximate_integral(weights_to(-0.5, horizon), -0.5, 1, 6);
    Line<TypeParam> line({-0.5, design.length(), design.modes});
    ASSERT_EQ(line.status, glsum::Status::ok);
    const auto grown = [&](std::size_t count) {
        double sum = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            sum = static_cast<double>(TypeParam::step(line.state, 1));
        }
        return sum;
    };
    (void)grown(20 * horizon);
    const double first = grown(horizon);
    const double second = grown(horizon);
    const double third = grown(horizon);
    EXPECT_GT(second - first, 0.9 * static_cast<double>(horizon) * design.modes.front().weight);
    EXPECT_NEAR(third - second, second - first, 1e-3 * (second - first));
}

TYPED_TEST(IntegralTest, RefusesOtherDesigns) {
    using Status = glsum::Status;
    const auto status = [](std::vector<Mode> modes, std::size_t taps) {
        return Line<TypeParam>({-0.5, taps, modes}).status;
    };
    EXPECT_EQ(status({{0.0, 0.1}, {0.1, 0.2}}, 5), Status::ok);
    EXPECT_EQ(status({}, 5), Status::ok);
    EXPECT_EQ(status({{0.1, 0.1}}, 5), Status::modes_out_of_range);
    EXPECT_EQ(status({{0.0, 0.1}, {0.0, 0.1}}, 5), Status::modes_out_of_range);
    EXPECT_EQ(status({{0.0, 0.1}}, 2), Status::modes_out_of_range);
    EXPECT_EQ(status({{0.0, std::nan("")}}, 5), Status::modes_out_of_range);
    const std::vector<Mode> decaying{{0.0, 0.1}};
    EXPECT_EQ((Line<glsum::Sum<glsum::Modes, glsum::Plain, glsum::F32>>({-0.5, 5, decaying}).status),
              Status::modes_out_of_range);
}

}  // namespace
