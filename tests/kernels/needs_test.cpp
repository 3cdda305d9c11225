// What a kernel needs and costs, counted by hand from what its history and technique state; and small parts by
// themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/computes_in_double.hpp"
#include "glsum/design_range.hpp"
#include "glsum/double_double.hpp"
#include "glsum/exponentials/fixed_decay.hpp"
#include "glsum/gain.hpp"
#include "glsum/logmemory/block_weights.hpp"
#include "glsum/registry.hpp"
#include "glsum/window/dsp.hpp"
#include "reference/real.hpp"

namespace {

using namespace glsum;

struct Needs {
    std::size_t table, past, multiplications;
};

template <class K>
void expect_needs(const Design& design, const Needs& needs) {
    EXPECT_EQ(table_needed<K>(design), needs.table) << K::name() << ' ' << design.taps;
    EXPECT_EQ(past_needed<K>(design), needs.past) << K::name() << ' ' << design.taps;
    EXPECT_EQ(K::multiplications(design.taps), needs.multiplications) << K::name() << ' ' << design.taps;
}

TEST(Needs, OfWindowsAreTheirTaps) {
    for (const std::size_t taps : {1U, 2U, 5U, 33U}) {
        const std::size_t n = taps - 1;
        expect_needs<Sum<Shift, Plain, F32>>({0.5, taps}, {n, n, n});
        expect_needs<Sum<Ring, Oldest, F64>>({0.5, taps}, {n, n, n});
        expect_needs<Sum<Mirror, Multi, F32>>({0.5, taps}, {n, 2 * n, n});
        expect_needs<Sum<Mirror, Pairwise, F32>>({0.5, taps}, {n, 2 * n, n});
        expect_needs<Sum<Transposed, Oldest, F32>>({0.5, taps}, {n, n, n});
        expect_needs<Sum<Shift, Fir, Q15>>({0.5, taps}, {n, n, n});
        expect_needs<Sum<Ring, Compensated, F32>>({0.5, taps}, {n, n, n});
        expect_needs<Sum<Ring, Horner, F32>>({0.5, taps}, {n + 1, n, n});             // c_1 ... c_L
        expect_needs<Sum<Mirror, HornerSplit, F32>>({0.5, taps}, {n + 4, 2 * n, n});  // four chains
        expect_needs<Sum<MirrorDelta, Plain, F32>>({0.5, taps}, {n, 2 * n, n});
        // A guess costs its recurrence and its term, a line a term and a mean more.
        expect_needs<Sum<MirrorHold, Plain, F32>>({0.5, taps}, {n, 2 * n, taps + 1});
        expect_needs<Sum<MirrorLinear, Plain, F32>>({0.5, taps}, {n, 2 * n, taps + 2});
    }
}

// Two samples of 16 bits at a time, from an even place and from an odd one: the table twice, once shifted by one.
TEST(Needs, OfPairsAreTheirTableTwice) {
    using K = Sum<Mirror, Smlald, Q15>;
    expect_needs<K>({0.5, 1}, {0, 0, 0});
    for (const auto& [taps, words] :
         {std::pair(2, 1 + 1), std::pair(3, 1 + 2), std::pair(4, 2 + 2), std::pair(34, 17 + 17)}) {
        const auto n = static_cast<std::size_t>(taps - 1);
        EXPECT_EQ(K::table_count(n + 1), 2U * static_cast<std::size_t>(words)) << taps;
        EXPECT_GE(K::past_count(n + 1), 2 * n);
        EXPECT_LE(K::past_count(n + 1), 2 * n + 1);  // the last word may reach one sample further
    }
    // An octave more with each doubling, whose shift lies behind the table.
    using Octaves = Sum<Mirror, Scaled, Q15>;
    for (const auto& [past, octaves] : {std::pair(1, 1), std::pair(2, 2), std::pair(3, 2), std::pair(4, 3),
                                        std::pair(7, 3), std::pair(8, 4), std::pair(600, 10)}) {
        EXPECT_EQ(Octaves::table_count(static_cast<std::size_t>(past) + 1), static_cast<std::size_t>(past + octaves));
    }
}

// A mode counts as two taps: its decay and its gain; in fixed point the decay's shift besides. One word of state, or
// two.
TEST(Needs, OfModesAreTwoCoefficientsAndAState) {
    const std::vector<Mode> modes(3, Mode{0.1, -0.01});
    const Design design{0.5, 4 + 6, modes};
    expect_needs<Sum<Modes, Plain, F32>>(design, {3 + 6, 3 + 3, 9});
    expect_needs<Sum<Modes, Compensated, F32>>(design, {3 + 6, 3 + 6, 9});
    expect_needs<Sum<Modes, Plain, Q31>>(design, {3 + 9, 3 + 3, 9});
    expect_needs<Sum<ModesDelta, Plain, F32>>(design, {3 + 6, 3 + 3, 9});
    // A section of two poles has four and two states, one of a single pole two and one.
    expect_needs<Sum<Cascade, DirectForm2Transposed, F32>>(design, {3 + 6, 3 + 3, 9});
    expect_needs<Sum<CascadeDelta, DirectForm2Transposed, F32>>(design, {3 + 6, 3 + 3, 9});
    expect_needs<Sum<Modes, Plain, F32>>({0.5, 10}, {9, 9, 9});
    // Of a running sum the weight lies in the state, and its pole needs no product.
    expect_needs<Sum<Integrator, Plain, F32>>(design, {3 + 4, 3 + 2, 8});
    expect_needs<Sum<Integrator, Compensated, F32>>(design, {3 + 4, 3 + 4, 8});
    expect_needs<Sum<Integrator, Plain, F32>>({-0.5, 10}, {9, 9, 8});
    EXPECT_EQ((Sum<Integrator, Plain, F32>::multiplications(1)), 0U);
    EXPECT_EQ((Sum<Integrator, Plain, F32>::multiplications(2)), 1U);
    EXPECT_EQ((Sum<Integrator, Plain, F32>::multiplications(3)), 1U);
    // What serves any design of a length: the most modes that it could have.
    EXPECT_EQ((Sum<Modes, Plain, Q31>::table_count(10)), 9U + 4U);
    EXPECT_EQ((Sum<Modes, Plain, F32>::table_count(10)), 9U);
    EXPECT_EQ((Sum<Modes, Plain, F32>::past_count(10)), 9U);
    EXPECT_EQ((Sum<Integrator, Plain, F32>::table_count(10)), 9U);
}

TEST(Needs, OfBlocksAreWhatTheyReach) {
    using K = Sum<Nested, Plain, F32>;
    // 5 near taps, blocks of 2, 2, 4, 4, 8, 8 samples: 33 lags.
    const Design design{0.5, 11, {}, {}, {6, 2}};
    expect_needs<K>(design, {10, 32, 10});
    expect_needs<K>({0.5, 11}, {10, 10, 10});
    EXPECT_EQ(K::table_count(std::size_t{33}), 32U);
    EXPECT_EQ(K::past_count(std::size_t{33}), 32U);
    EXPECT_EQ(reach_of(5, {6, 2}), 33U);
    EXPECT_EQ(reach_of(design), 33U);
    EXPECT_EQ(reach_of(Design{0.5, 11}), 11U);
    EXPECT_EQ(reach_of(3, {3, 5}), 3U + 3U * 2U);
    EXPECT_EQ(reach_of(3, {0, 1}), 3U);
    // Two near taps and 27 doubled blocks reach 2^28 to the lag; one more is too far, as is a level without blocks, and
    // blocks beside which no tap is left.
    EXPECT_EQ(most_reach, std::size_t{1} << 28);
    EXPECT_EQ(reach_of(2, {27, 1}), most_reach);
    EXPECT_EQ(reach_of(3, {27, 1}), most_reach + 1);
    EXPECT_EQ(reach_of(2, {28, 1}), most_reach + 1);
    EXPECT_EQ(reach_of(2, {1, 0}), most_reach + 1);
    EXPECT_EQ(reach_of(Design{0.5, 6, {}, {}, {6, 2}}), most_reach + 1);
    EXPECT_EQ(reach_of(Design{0.5, 7, {}, {}, {6, 2}}), 1U + 28U);
    EXPECT_EQ(K::past_count(Design{0.5, 6, {}, {}, {6, 2}}), 0U);
    // At that reach it is the past that is missing, beyond it the design is refused; without blocks it is a length.
    typename K::State state{};
    std::vector<float> table(40);
    const auto prepared = [&](const Design& asked) { return K::prepare(state, asked, table, {}); };
    EXPECT_EQ(prepared({0.5, 29, {}, {}, {27, 1}}), Status::past_too_small);
    EXPECT_EQ(prepared({0.5, 30, {}, {}, {27, 1}}), Status::blocks_out_of_range);
    EXPECT_EQ(prepared({0.5, 30, {}, {}, {27, 0}}), Status::blocks_out_of_range);
    EXPECT_EQ(prepared({0.5, 30}), Status::past_too_small);
    EXPECT_EQ(prepared({0.5, 30, {}, {}, {1, 0}}), Status::blocks_out_of_range);
    EXPECT_EQ(prepared({0.5, most_reach + 1}), Status::table_too_small);
}

// Groups of four: a ring of G of them, and coefficients for the three outputs that lie between.
TEST(Needs, OfFourOutputsAtOnceAreWholeGroups) {
    using K = Sum<Block, OldestFma, F32>;
    expect_needs<K>({0.5, 1}, {0, 0, 0});
    for (const auto& [taps, groups] :
         {std::pair(2, 1), std::pair(5, 1), std::pair(6, 2), std::pair(9, 2), std::pair(601, 150)}) {
        const auto words = static_cast<std::size_t>(4 * groups);
        expect_needs<K>({0.5, static_cast<std::size_t>(taps)}, {words + 3, words, words + 2});
    }
}

#if defined(GLSUM_SIMD)
// Vectors of 64 bytes: 16 floats or 8 doubles.
TEST(Needs, OfVectorsAreWholeOnes) {
    using Dot = Sum<Mirror, Simd, F32>;
    for (const auto& [taps, table] :
         {std::pair(2U, 16U), std::pair(17U, 16U), std::pair(18U, 32U), std::pair(601U, 608U)}) {
        // A table and, beside the mirror, a block, both where the next 64 bytes begin.
        expect_needs<Dot>({0.5, taps}, {table + 15, 2 * table + 16 + 15, taps - 1});
    }
    expect_needs<Dot>({0.5, 1}, {0, 0, 0});
    EXPECT_EQ((Sum<Mirror, Simd, F64>::table_count(10)), 16U + 7U);
    // Of more than 1536 samples a copy of the table for each place in 16 bytes; none where products are fused.
    expect_needs<Dot>({0.5, 1537}, {1536 + 15, 2 * 1536 + 16 + 15, 1536});
    expect_needs<Dot>({0.5, 1538}, {4 * 1552 + 15, 2 * 1552 + 16 + 15, 1537});
    EXPECT_EQ((Sum<Mirror, Simd, F64>::table_count(1537)), 1536U + 7U);
    EXPECT_EQ((Sum<Mirror, Simd, F64>::table_count(1538)), 2U * 1544U + 7U);
    EXPECT_EQ((Sum<Mirror, SimdFma, F32>::table_count(1538)), 1552U + 15U);
    // Eight outputs at once: 32 words for what enters (7 of them and two vectors, in whole ones), then a table for each
    // output while all fit 32 KB, else one and eight words; a ring in eights, twice, between two vectors.
    using Eight = Sum<HostBlock, Simd, F32>;
    expect_needs<Eight>({0.5, 1}, {32, 0, 0});
    expect_needs<Eight>({0.5, 2}, {32 + 8 * 16, 16 + 2 * 8 + 16, 1});
    expect_needs<Eight>({0.5, 601}, {32 + 8 * 608, 16 + 2 * 600 + 16, 600});
    expect_needs<Eight>({0.5, 1025}, {32 + 8 * 1024, 16 + 2 * 1024 + 16, 1024});
    expect_needs<Eight>({0.5, 1026}, {32 + 1040 + 8, 16 + 2 * 1032 + 16, 1025});
    using EightDoubles = Sum<HostBlock, Simd, F64>;
    expect_needs<EightDoubles>({0.5, 513}, {16 + 8 * 512, 8 + 2 * 512 + 8, 512});
    expect_needs<EightDoubles>({0.5, 514}, {16 + 520 + 8, 8 + 2 * 520 + 8, 513});
    // A product, the vectors before it in its lane, the tree of lanes, seven more samples of its eight, and x_k.
    EXPECT_EQ(Eight::sum_roundings(0, 601), 1U);
    EXPECT_EQ(Eight::sum_roundings(7, 601), 1U + 608U / 16U + 4U + 7U + 1U);
    EXPECT_EQ(EightDoubles::sum_roundings(7, 601), 1U + 600U / 8U + 3U + 7U + 1U);
}
#endif

// Kernels of the host alone are those with a vector unit; histories that lie in one piece are not rings.
TEST(Needs, OnlyVectorsNeedTheHost) {
    Registry::for_each([&]<class K>() {
        if constexpr (!std::is_same_v<K, Null>) {
            EXPECT_EQ(K::host_only, K::name().find("_simd") != std::string_view::npos) << K::name();
            const bool doubles = K::name().ends_with("f64") || K::name().ends_with("f32a64");
            EXPECT_EQ(computes_in_double<K>(), doubles) << K::name();
            EXPECT_TRUE(K::order_in_range(0.5)) << K::name();
            EXPECT_TRUE(K::order_in_range(2.0)) << K::name();
            EXPECT_FALSE(K::order_in_range(std::nextafter(2.0, 3.0))) << K::name();
            const double lowest = keeps_increments<typename K::HistoryPart> ? -1.0 : -2.0;
            EXPECT_FALSE(K::order_in_range(lowest)) << K::name();
            EXPECT_TRUE(K::order_in_range(std::nextafter(lowest, 0.0))) << K::name();
        }
    });
    EXPECT_TRUE(Shift::contiguous && Mirror::contiguous && MirrorHold::contiguous && Modes::contiguous);
    EXPECT_FALSE(Ring::contiguous || Block::contiguous || Nested::contiguous);
    EXPECT_TRUE(Pairwise::contiguous_only && HornerSplit::contiguous_only && Scaled::contiguous_only);
    EXPECT_TRUE(Smlad::contiguous_only && Smlald::contiguous_only && SmlaldShaped::contiguous_only);
    EXPECT_FALSE(Plain::contiguous_only || Oldest::contiguous_only || Multi::contiguous_only);
    EXPECT_TRUE(Horner::horner_form && HornerSplit::horner_form);
    EXPECT_FALSE(Plain::horner_form || Fir::horner_form || Compensated::horner_form);
    EXPECT_TRUE(guesses_tail<MirrorHold> && guesses_tail<MirrorLinear>);
    EXPECT_FALSE(guesses_tail<Mirror> || guesses_tail<Modes>);
}

// A mantissa of 30 bits, rounded to nearest, and its shift: 62 at most, below 2^-33 with fewer bits.
TEST(FixedDecay, HasAMantissaOfThirtyBits) {
    const auto expect = [](double decay, std::int32_t mantissa, std::int32_t shift) {
        const FixedDecay found = to_fixed(decay);
        EXPECT_EQ(found.mantissa, mantissa) << decay;
        EXPECT_EQ(found.shift, shift) << decay;
    };
    expect(1.0, 1 << 30, 30);
    expect(0.5, 1 << 29, 30);
    expect(0.5 - 0x1p-31, (1 << 30) - 1, 31);
    expect(0.25 + 0x1.8p-32, (1 << 29) + 1, 31);  // 3/4 of a unit more
    expect(0x1p-33, 1 << 29, 62);
    expect(0x1p-34, 1 << 28, 62);
    expect(0x1p-62, 1, 62);
}

// High and low parts are the sum and the product to the last bit.
TEST(DoubleDouble, IsExact) {
    std::mt19937_64 generator(1);
    for (int k = 0; k < 1000; ++k) {
        const double a =
            std::ldexp(static_cast<double>(generator()) * 0x1p-63 - 1.0, static_cast<int>(generator() % 40));
        const double b =
            std::ldexp(static_cast<double>(generator()) * 0x1p-63 - 1.0, -static_cast<int>(generator() % 40));
        const DoubleDouble sum = two_sum(a, b);
        EXPECT_EQ(sum.high, a + b);
        EXPECT_EQ(reference::Real(sum.high) + reference::Real(sum.low), reference::Real(a) + reference::Real(b));
        const DoubleDouble product = two_product(a, b);
        EXPECT_EQ(product.high, a * b);
        EXPECT_EQ(product.low, std::fma(a, b, -product.high));
    }
}

// Blocks in turn: 2, 2, 4, 4, 8, ... lags; sums, means and magnitudes of their weights.
TEST(BlockWeightsOf, AreThoseOfTheirLags) {
    for (const double order : {0.5, 1.5, -0.5}) {
        Weights walk(order);
        std::vector<double> all = {1.0};
        for (int j = 1; j < 200; ++j) {
            walk.next();
            all.push_back(walk.weight());
        }
        Weights weights(order);
        weights.next();
        weights.next();
        BlockWeights blocks({7, 2}, weights);
        std::size_t from = 3;
        for (std::size_t b = 0; b < 7; ++b) {
            const std::size_t width = std::size_t{2} << (b / 2);
            long double sum = 0.0L;
            long double magnitude = 0.0L;
            for (std::size_t j = from; j < from + width; ++j) {
                sum += all[j];
                magnitude += std::fabs(all[j]);
            }
            from += width;
            blocks.next();
            EXPECT_EQ(blocks.level(), b / 2 + 1);
            EXPECT_NEAR(blocks.sum(), static_cast<double>(sum), 1e-16 * static_cast<double>(magnitude));
            EXPECT_NEAR(blocks.mean(), static_cast<double>(sum) / static_cast<double>(width), 1e-16);
            EXPECT_NEAR(blocks.absolute(), static_cast<double>(magnitude), 1e-15 * static_cast<double>(magnitude));
        }
    }
}

// Scales of q31 where a coefficient, or the sum, just fits and just does not.
TEST(Fixed, ScalesAtTheEdgesOfItsFormat) {
    using K = Sum<Ring, Plain, Q31>;
    struct Edge {
        double weight;
        int table_exponent, output_exponent;
    };
    for (const Edge& edge : {Edge{0.0, 0, 0}, Edge{1.0 - 0x1p-31, 0, 1}, Edge{1.0, 1, 1}, Edge{-1.0, 0, 1},
                             Edge{-1.0 - 0x1p-29, 1, 2}, Edge{-3.0, 2, 2}, Edge{-3.25, 2, 3}, Edge{0x1p-31, 0, 1},
                             Edge{0x1p-32, 0, 1},                // half a unit, which rounds to a whole one
                             Edge{1.0 - 0.497 * 0x1p-31, 1, 1},  // nearer to +1, which has no room, than to the last
                             Edge{-0x1p31, 31, 32}}) {
        const std::vector<double> weights = {edge.weight};
        bench::HostLine<K> line({0.5, 2, {}, weights});
        ASSERT_EQ(line.status(), Status::ok) << edge.weight;
        EXPECT_EQ(line.state().scale.table_exponent, edge.table_exponent) << edge.weight;
        EXPECT_EQ(line.state().scale.output_exponent, edge.output_exponent) << edge.weight;
        EXPECT_EQ(line.state().scale.output_shift, 31 - edge.table_exponent + edge.output_exponent) << edge.weight;
    }
    const auto status_of = [](double weight) {
        const std::vector<double> weights = {weight};
        return bench::HostLine<K>({0.5, 2, {}, weights}).status();
    };
    EXPECT_EQ(status_of(-0x1p31), Status::ok);
    EXPECT_EQ(status_of(0x1p31 - 1.0), Status::ok);
    EXPECT_EQ(status_of(0x1p31), Status::format_too_narrow);
    EXPECT_EQ(status_of(-0x1p31 - 1.0), Status::format_too_narrow);
    // Horner forms reach the square of the length: to 40 000.
    using Horners = Sum<Ring, Horner, Q31>;
    EXPECT_EQ(bench::HostLine<Horners>({0.5, 40'000}).status(), Status::ok);
    EXPECT_EQ(bench::HostLine<Horners>({0.5, 40'001}).status(), Status::format_too_narrow);
    // Weights whose magnitudes sum to a power of two just fit: 1 of order 0, 1 + 1 of order 1, 1 + 1 + 1 + 1 of -1.
    const auto horner_scale = [](double order, std::size_t taps) {
        bench::HostLine<Horners> line({order, taps});
        EXPECT_EQ(line.status(), Status::ok);
        EXPECT_EQ(line.state().scale.output_shift, line.state().scale.output_exponent);
        return static_cast<int>(line.state().scale.output_exponent);
    };
    EXPECT_EQ(horner_scale(0.0, 20), 0);
    EXPECT_EQ(horner_scale(1.0, 20), 1);
    EXPECT_EQ(horner_scale(1.001, 20), 2);
    EXPECT_EQ(horner_scale(-1.0, 4), 2);
    EXPECT_EQ(horner_scale(-1.0, 5), 3);
}

// s and e for an order, whatever the scale was before.
template <class Format, int accumulator_bits>
std::pair<int, int> scale_for(double order, std::size_t taps) {
    typename Format::Scale scale{5, 6, 7, 8};
    EXPECT_EQ(Format::template choose_scale<accumulator_bits>({order, taps}, scale), Status::ok);
    EXPECT_EQ(scale.saturations, 0U);
    return {scale.table_exponent, scale.output_exponent};
}

// All weights of order -1 are 1, which no fraction holds: s is 1 at least, and their sum, the length, fits 2^e. Where
// the accumulator has one bit beside those of the products, the sum is at most 2^(s+1).
TEST(Fixed, ScalesGrowWithTheSumOfTheWeights) {
    const struct {
        std::size_t taps;
        int table_exponent, output_exponent;
    } known[] = {{1, 0, 0}, {2, 1, 1}, {4, 1, 2}, {5, 2, 3}, {8, 2, 3}, {9, 3, 4}};
    for (const auto& one : known) {
        const std::pair narrow(one.table_exponent, one.output_exponent);
        EXPECT_EQ((scale_for<Q31, 64>(-1.0, one.taps)), narrow) << one.taps;
        EXPECT_EQ((scale_for<Q15, 32>(-1.0, one.taps)), narrow) << one.taps;
        // With room for many more, a coefficient alone decides.
        const std::pair wide(one.taps > 1 ? 1 : 0, one.output_exponent);
        EXPECT_EQ((scale_for<Q15, 64>(-1.0, one.taps)), wide) << one.taps;
        EXPECT_EQ((scale_for<Q15C31, 64>(-1.0, one.taps)), wide) << one.taps;
    }
}

// The Horner forms hold the factors (j - 1 - v)/j: s is 0 while all are in [-1, 1), also once rounded, else 1.
TEST(Fixed, HornerScalesFollowFromTheFactors) {
    const auto table_exponent = [](double order, std::size_t taps) {
        Q31::Scale scale{5, 6, 7, 8};
        EXPECT_EQ(Q31::choose_horner_scale({order, taps}, scale), Status::ok);
        EXPECT_EQ(scale.saturations, 0U);
        return static_cast<int>(scale.table_exponent);
    };
    EXPECT_EQ(table_exponent(1.5, 1), 0);  // no factor
    EXPECT_EQ(table_exponent(1.5, 2), 1);
    EXPECT_EQ(table_exponent(1.0, 4), 0);  // -1, 0, 1/3
    EXPECT_EQ(table_exponent(1.005, 2), 1);
    EXPECT_EQ(table_exponent(-0.5, 10), 0);
    EXPECT_EQ(table_exponent(-1.0, 3), 1);
    EXPECT_EQ(table_exponent(-(1.0 - 0x1p-31), 2), 0);
    EXPECT_EQ(table_exponent(-(1.0 - 0x1p-32), 2), 1);
}

TEST(Fixed, RoundsToIntegersAwayFromZero) {
    EXPECT_EQ(round_to_integer<std::int32_t>(0.5), 1);
    EXPECT_EQ(round_to_integer<std::int32_t>(-0.5), -1);
    EXPECT_EQ(round_to_integer<std::int32_t>(1.4999999), 1);
    EXPECT_EQ(round_to_integer<std::int32_t>(-1.4999999), -1);
    EXPECT_EQ(round_to_integer<std::int32_t>(2147483646.5), 2147483647);
    EXPECT_EQ(round_to_integer<std::int32_t>(-2147483647.5), std::numeric_limits<std::int32_t>::min());
    EXPECT_EQ(round_to_integer<std::int32_t>(-2147483646.6), -2147483647);
    EXPECT_EQ(round_to_integer<std::int32_t>(1e300), 2147483647);
    EXPECT_EQ(round_to_integer<std::int32_t>(std::nan("")), std::numeric_limits<std::int32_t>::min());
    // Shifts up: the last that fits, the first that does not, on either side.
    for (const int shift : {1, 5, 30}) {
        const std::int64_t last = std::int64_t{2147483647} >> shift;
        EXPECT_FALSE(round_shift(last, -shift).saturated);
        EXPECT_EQ(round_shift(last, -shift).value, last << shift);
        EXPECT_TRUE(round_shift(last + 1, -shift).saturated);
        EXPECT_FALSE(round_shift(-last - 1, -shift).saturated);
        EXPECT_EQ(round_shift(-last - 1, -shift).value, std::numeric_limits<std::int32_t>::min());
        EXPECT_TRUE(round_shift(-last - 2, -shift).saturated);
        EXPECT_EQ(round_shift(-last - 2, -shift).value, std::numeric_limits<std::int32_t>::min());
        EXPECT_EQ(round_shift(last + 1, -shift).value, 2147483647);
    }
    // Of every shift down halves go up, and all 64 bits are seen.
    for (int shift = 1; shift < 63; ++shift) {
        const std::int64_t half = std::int64_t{1} << (shift - 1);
        EXPECT_EQ(round_shift(half, shift).value, 1) << shift;
        EXPECT_EQ(round_shift(half - 1, shift).value, 0) << shift;
        EXPECT_EQ(round_shift(-half, shift).value, 0) << shift;
        EXPECT_EQ(round_shift(-half - 1, shift).value, -1) << shift;
    }
}

// The limit itself is within, of either sign; what is no number is not.
TEST(DesignRange, MagnitudesReachTheirLimit) {
    EXPECT_TRUE(is_magnitude_at_most(2.0, 2.0));
    EXPECT_TRUE(is_magnitude_at_most(-2.0, 2.0));
    EXPECT_FALSE(is_magnitude_at_most(std::nextafter(2.0, 3.0), 2.0));
    EXPECT_FALSE(is_magnitude_at_most(std::nextafter(-2.0, -3.0), 2.0));
    EXPECT_FALSE(is_magnitude_at_most(std::nan(""), 2.0));
}

// Both products of a pair, signs and all.
TEST(Dsp, MultipliesBothHalves) {
    const auto pair = [](int low, int high) {
        return static_cast<std::int32_t>((static_cast<std::uint32_t>(high) << 16) |
                                         (static_cast<std::uint32_t>(low) & 0xffffU));
    };
    const auto wide = dsp::smlald(pair(-300, 200), pair(100, -50), std::int64_t{7});
    EXPECT_EQ(wide, 7 - 300 * 100 - 200 * 50);
    EXPECT_EQ(dsp::smlald(pair(-32768, -32768), pair(-32768, -32768), std::int64_t{1}), 1 + 2LL * 32768 * 32768);
    EXPECT_EQ(dsp::smlad(pair(-300, 200), pair(100, -50), 7), 7 - 300 * 100 - 200 * 50);
}

// h^-v as mantissa and exponent, and what a gain makes of the least and the largest output.
TEST(Gain, ShiftsAsFarAsThereIsAnything) {
    const Gain one = make_gain(1.0);
    EXPECT_EQ(apply_gain(12345, 0, one, 0).value, 12345);
    EXPECT_EQ(apply_gain(12345, 3, one, 0).value, 12345 * 8);
    EXPECT_EQ(apply_gain(12345, 0, one, 3).value, 1543);  // 1543.1
    EXPECT_EQ(apply_gain(-12, 0, one, 3).value, -1);      // -1.5, halves up
    EXPECT_EQ(apply_gain(2147483647, 0, one, 31).value, 1);
    EXPECT_EQ(apply_gain(2147483647, 0, one, 32).value, 0);
    for (const int far : {33, 34, 60, 100}) {
        EXPECT_EQ(apply_gain(2147483647, 0, one, far).value, 0) << far;
        EXPECT_EQ(apply_gain(1, 100, one, far - 200).value, 2147483647) << far;
        EXPECT_EQ(apply_gain(-1, 100, one, far - 200).value, std::numeric_limits<std::int32_t>::min()) << far;
        EXPECT_EQ(apply_gain(0, 100, one, far - 200).value, 0) << far;
    }
    // A product has 62 bits: a shift by 63 leaves nothing of it, one up by 62 saturates all but 0.
    for (const auto& [result, shift] : {std::pair(32, 62), std::pair(33, 63), std::pair(34, 63), std::pair(100, 63),
                                        std::pair(-91, -61), std::pair(-92, -62), std::pair(-93, -62)}) {
        EXPECT_EQ(gain_shift(one, 0, result), shift) << result;
    }
    EXPECT_DOUBLE_EQ(step_factor(0.5, 0.25), 2.0);
    EXPECT_DOUBLE_EQ(step_factor(-1.0, 0.25), 0.25);
    // Half a unit of the mantissa goes up.
    EXPECT_EQ(make_gain(1.0 + 0x1p-31).mantissa, (1 << 30) + 1);
    EXPECT_EQ(make_gain(1.0 + 0x1.8p-32).mantissa, 1 << 30);
}

// What a buffer of so many taps takes at most is what the hungriest number of modes takes: no more, and no less.
template <class K>
void expect_enough_for_any_modes() {
    for (std::size_t taps = 1; taps < 40; ++taps) {
        std::size_t table = 0;
        std::size_t past = 0;
        for (std::size_t modes = 0; modes <= (taps - 1) / 2; ++modes) {
            table = std::max(table, K::table_count(taps, modes));
            past = std::max(past, K::past_count(taps, modes));
        }
        EXPECT_EQ(K::table_count(taps), table) << K::name() << ' ' << taps;
        EXPECT_EQ(K::past_count(taps), past) << K::name() << ' ' << taps;
    }
}

TEST(Needs, OfSoManyTapsAreThoseOfTheHungriestModes) {
    expect_enough_for_any_modes<Sum<Cascade, DirectForm2Transposed, F32>>();
    expect_enough_for_any_modes<Sum<Cascade, glsum::DirectForm1, Q31>>();
    expect_enough_for_any_modes<Sum<Modes, Plain, F32>>();
    expect_enough_for_any_modes<Sum<Modes, Plain, Q31>>();
}

}  // namespace
