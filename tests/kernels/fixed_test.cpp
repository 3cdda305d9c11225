// Fixed-point kernels bit for bit against exact integers, and their formats at the edges.
#include "glsum/format/fixed.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <random>

#include "bench/reference/sums.hpp"
#include "tests/kernels/registered.hpp"

namespace {

using Integer = boost::multiprecision::cpp_int;
using reference::Real;

Integer round_half_away(const Real& value) {
    const Real rounded = value < 0 ? Real(ceil(value - Real(0.5))) : Real(floor(value + Real(0.5)));
    return rounded.convert_to<Integer>();
}

// S_k as 32 bits from the definition of the format: rounded coefficients, the exact sum, halves up, saturation.
struct Oracle {
    int bits;
    int table_exponent;
    int output_exponent;
    std::vector<Integer> table;
    std::vector<Integer> newest_first;
    unsigned saturations = 0;

    std::int32_t step(std::int64_t newest) {
        newest_first.insert(newest_first.begin(), newest);
        Integer sum = 0;
        for (std::size_t j = 0; j < std::min(table.size(), newest_first.size()); ++j) {
            sum += table[j] * newest_first[j];
        }
        // sum has 2 bits - table_exponent bits of fraction, the output 31 - output_exponent.
        const int shift = 2 * bits - table_exponent - 31 + output_exponent;
        Integer rounded;
        if (shift >= 0) {
            const Integer scaled = 2 * sum + (Integer(1) << shift);  // floor((sum + half) / 2^shift)
            const Integer divisor = Integer(1) << (shift + 1);
            rounded = scaled >= 0 ? Integer(scaled / divisor) : Integer(-((-scaled + divisor - 1) / divisor));
        } else {
            rounded = sum << -shift;
        }
        if (rounded > 2147483647) {
            ++saturations;
            return 2147483647;
        }
        if (rounded < -Integer(2147483648LL)) {
            ++saturations;
            return std::numeric_limits<std::int32_t>::min();
        }
        return rounded.convert_to<std::int32_t>();
    }
};

template <class K>
class FixedTest : public testing::Test {};
TYPED_TEST_SUITE(FixedTest, test::FixedKernels, test::KernelNames);

TYPED_TEST(FixedTest, EqualsTheExactIntegersBitForBit) {
    using Sample = typename TypeParam::Sample;
    constexpr int bits = TypeParam::FormatPart::fraction_bits;
    for (const double order : {0.2, 0.5, 0.98319, 1.0, 1.5, 1.9909, 2.0, -0.5, -1.0, -1.7}) {
        for (const std::size_t taps : {1U, 2U, 3U, 8U, 33U, 100U}) {
            test::Line<TypeParam> line({order, taps});
            ASSERT_EQ(line.status(), glsum::Status::ok);
            const auto& scale = line.state().scale;
            Oracle oracle{bits, scale.table_exponent, scale.output_exponent, {}, {}};
            const auto weights = reference::weights(Real(order), taps);
            for (const Real& weight : weights) {
                oracle.table.push_back(round_half_away(weight * pow(Real(2), bits - scale.table_exponent)));
            }
            std::mt19937_64 generator(taps);
            for (std::size_t k = 0; k < 2 * taps + 40; ++k) {
                // Random samples; then the extremes, with the signs that drive the sum furthest.
                const bool extreme = k > taps + 20;
                const bool low = extreme ? (weights[(2 * taps + 39 - k) % taps] < 0) : false;
                const auto random = static_cast<Sample>(generator());
                const Sample x = !extreme ? random
                                 : low    ? std::numeric_limits<Sample>::min()
                                          : std::numeric_limits<Sample>::max();
                ASSERT_EQ(line.step(x), oracle.step(x)) << "order " << order << ", taps " << taps << ", k " << k;
            }
            EXPECT_EQ(scale.saturations, oracle.saturations);
        }
    }
}

TYPED_TEST(FixedTest, ScaleFollowsFromTheSumOfTheWeightsNotFromTheLength) {
    for (const std::size_t taps : {50U, 600U, 5000U}) {
        test::Line<TypeParam> half({0.5, taps});
        EXPECT_EQ(half.state().scale.table_exponent, 0);
        EXPECT_EQ(half.state().scale.output_exponent, 1);
        test::Line<TypeParam> seed({1.9909, taps});
        EXPECT_EQ(seed.state().scale.table_exponent, 1);
        EXPECT_EQ(seed.state().scale.output_exponent, 2);
    }
    EXPECT_EQ(test::Line<TypeParam>({-0.5, 600}).state().scale.output_exponent, 5);  // the sum is 27.7
}

// Facts that need no code of ours: the last coefficient that does not round to zero in 16 bits.
TEST(Fixed, CoefficientsOfQ15EndWhereTheTheoryHasIt) {
    using K = glsum::Sum<glsum::Mirror, glsum::Smlald, glsum::Q15>;
    EXPECT_EQ(test::Line<K>({0.5, 1000}).effective_taps(), 700U);
    EXPECT_EQ(test::Line<K>({0.9, 1000}).effective_taps(), 100U);
    EXPECT_EQ(test::Line<K>({0.98319, 1000}).effective_taps(), 35U);
}

TEST(Fixed, RoundShiftRoundsHalvesUpAndSaturates) {
    const auto value = [](std::int64_t sum, int shift) { return glsum::round_shift(sum, shift).value; };
    EXPECT_EQ(value(3, 1), 2);
    EXPECT_EQ(value(-3, 1), -1);
    EXPECT_EQ(value(5, 2), 1);
    EXPECT_EQ(value(6, 2), 2);
    EXPECT_EQ(value(7, 0), 7);
    EXPECT_EQ(value(7, -2), 28);
    EXPECT_EQ(value(std::numeric_limits<std::int64_t>::max(), 32), 2147483647);
    EXPECT_TRUE(glsum::round_shift(std::numeric_limits<std::int64_t>::max(), 32).saturated);
    EXPECT_EQ(value(std::numeric_limits<std::int64_t>::min(), 32), std::numeric_limits<std::int32_t>::min());
    EXPECT_FALSE(glsum::round_shift(std::numeric_limits<std::int64_t>::min(), 32).saturated);
    EXPECT_TRUE(glsum::round_shift(1LL << 40, 0).saturated);
    EXPECT_TRUE(glsum::round_shift(1LL << 31, -1).saturated);
    EXPECT_EQ(value(-(1LL << 30), -1), std::numeric_limits<std::int32_t>::min());
    EXPECT_FALSE(glsum::round_shift(-(1LL << 30), -1).saturated);
}

TEST(Fixed, FromRealRoundsAndSaturates) {
    EXPECT_EQ(glsum::Q15::from_real(0.5), 16384);
    EXPECT_EQ(glsum::Q15::from_real(1.0), 32767);
    EXPECT_EQ(glsum::Q15::from_real(-1.0), -32768);
    EXPECT_EQ(glsum::Q15::from_real(-7.0), -32768);
    EXPECT_EQ(glsum::Q15::from_real(1.5 / 32768.0), 2);
    EXPECT_EQ(glsum::Q31::from_real(1.0), 2147483647);
    EXPECT_EQ(glsum::Q31::from_real(-1.0), std::numeric_limits<std::int32_t>::min());
    EXPECT_EQ(glsum::Q31::from_real(0.25), 1 << 29);
}

}  // namespace
