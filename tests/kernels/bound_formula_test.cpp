// Bounds by their derivations, to first order, counted anew from what their headers state: neither too small, which the
// signals of bound_test would show, nor larger than what was derived.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/gain.hpp"
#include "glsum/registry.hpp"

namespace {

using namespace glsum;

constexpr double u = 0x1p-24;

// a_1 ... a_last of an order.
std::vector<double> weights(double order, std::size_t last) {
    std::vector<double> all(last + 1, 1.0);
    for (std::size_t j = 1; j <= last; ++j) {
        all[j] = all[j - 1] * (1.0 - (order + 1.0) / static_cast<double>(j));
    }
    return all;
}

template <class K>
double bound_of(const Design& design, double peak, std::size_t samples = longest_record) {
    bench::HostLine<K> line(design);
    EXPECT_EQ(line.status(), Status::ok) << K::name();
    return error_bound<K>(design, line.state(), peak, samples);
}

// Higher orders are u times as large, times the terms.
void expect_first_order(double found, double expected) { EXPECT_NEAR(found / expected, 1.0, 2e-5); }

// Each sample rounded once, each coefficient once, each product once, and the additions from its own on: of a_j the
// L - j that follow in the order newest first.
TEST(BoundFormula, OfAPlainWindow) {
    constexpr std::size_t taps = 30;
    const auto a = weights(0.5, taps - 1);
    double roundings = 1.0 + (taps - 1);
    for (std::size_t j = 1; j < taps; ++j) {
        roundings += std::fabs(a[j]) * (2.0 + 1.0 + static_cast<double>(taps - j));
    }
    expect_first_order(bound_of<Sum<Ring, Plain, F32>>({0.5, taps}, 0.75), 0.75 * u * roundings);
    // Sums in double: their roundings are nothing beside the samples', the coefficients' and the output's.
    double data = 2.0;
    for (std::size_t j = 1; j < taps; ++j) {
        data += std::fabs(a[j]) * 3.0;
    }
    expect_first_order(bound_of<Sum<Ring, Plain, F32A64>>({0.5, taps}, 0.75), 0.75 * u * data);
}

// Exact sums: half a unit of each coefficient and sample, and of the output.
TEST(BoundFormula, OfAFixedWindow) {
    constexpr std::size_t taps = 30;
    const Design design{0.5, taps};
    bench::HostLine<Sum<Ring, Plain, Q31>> line(design);
    double absolute = 0.0;
    for (const double weight : weights(0.5, taps - 1)) {
        absolute += std::fabs(weight);
    }
    const double coefficient = std::ldexp(0.5, line.state().scale.table_exponent - 31);
    const double expected =
        0.75 * (taps - 1) * coefficient + absolute * 0x1p-32 + std::ldexp(1.0, line.state().scale.output_exponent - 32);
    EXPECT_NEAR((bound_of<Sum<Ring, Plain, Q31>>(design, 0.75)) / expected, 1.0, 1e-6);
}

// Short coefficients err by half a unit each in pairs, by a whole one where each takes over what others lost. Octaves
// that are scaled up, as far as all behind them stay below 1, err by half of their own unit.
TEST(BoundFormula, OfShortCoefficients) {
    constexpr std::size_t taps = 20;
    const auto check = []<class K>(double units, const bench::HostLine<K>& line) {
        ASSERT_EQ(line.status(), Status::ok);
        ASSERT_EQ(line.state().scale.table_exponent, 0);
        double absolute = 0.0;
        for (const double weight : weights(0.5, taps - 1)) {
            absolute += std::fabs(weight);
        }
        const double expected =
            0.75 * units * 0x1p-16 + absolute * 0x1p-16 + std::ldexp(1.0, line.state().scale.output_exponent - 32);
        EXPECT_NEAR((bound_of<K>({0.5, taps}, 0.75)) / expected, 1.0, 1e-6) << K::name();
    };
    check(19.0, bench::HostLine<Sum<Mirror, Smlald, Q15>>({0.5, taps}));
    check(19.0, bench::HostLine<Sum<Mirror, Smlad, Q15>>({0.5, taps}));
    check(38.0, bench::HostLine<Sum<Mirror, SmlaldShaped, Q15>>({0.5, taps}));
    // |a_1| = 1/2 by 1, a_2 = 1/8 by 4, a_4 = 0.039 by 16, a_8 = 0.0131 by 64, a_16 = 0.0045 by 128.
    check(1.0 + 2.0 / 4.0 + 4.0 / 16.0 + 8.0 / 64.0 + 4.0 / 128.0,
          bench::HostLine<Sum<Mirror, Scaled, Q15>>({0.5, taps}));
}

const std::vector<Mode> modes = {{0.001, -3e-5}, {0.02, -2e-4}, {0.25, -4e-3}};

// modes_bound.hpp: an average errs by 6 u + u/d, or compensated by 14 u; its term passes coefficient, product and the
// additions behind it as a tap does, the slowest last.
TEST(BoundFormula, OfModes) {
    const Design design{0.5, 16, modes};
    constexpr std::size_t near_taps = 10;
    constexpr std::size_t terms = 13;
    const auto a = weights(0.5, near_taps - 1);
    const auto expected = [&](bool compensated) {
        double sum = 1.0 + (terms - 1);
        for (std::size_t j = 1; j < near_taps; ++j) {
            sum += std::fabs(a[j]) * (2.0 + 1.0 + static_cast<double>(terms - j));
        }
        for (std::size_t m = 0; m < 3; ++m) {
            const std::size_t place = terms - 1 - m;
            const double average = compensated ? 14.0 : 6.0 + 1.0 / modes[m].decay;
            sum += std::fabs(modes[m].weight / modes[m].decay) *
                   (2.0 + 1.0 + static_cast<double>(terms - place) + average);
        }
        return 0.75 * u * sum;
    };
    EXPECT_NEAR((bound_of<Sum<Modes, Plain, F32>>(design, 0.75)) / expected(false), 1.0, 1e-4);  // of 1000 u squared
    EXPECT_NEAR((bound_of<Sum<Modes, Compensated, F32>>(design, 0.75)) / expected(true), 1.0, 1e-3);
    // Fixed point: d to 2^-30 of itself, twice; half a unit of the state for each step that it lives; half a unit of
    // each coefficient, sample and output.
    bench::HostLine<Sum<Modes, Plain, Q31>> line(design);
    const double coefficient = std::ldexp(0.5, line.state().scale.table_exponent - 31);
    double absolute = 1.0;
    double averages = 0.0;
    for (std::size_t j = 1; j < near_taps; ++j) {
        absolute += std::fabs(a[j]);
    }
    for (const Mode& mode : modes) {
        const double gain = std::fabs(mode.weight / mode.decay);
        absolute += gain;
        averages += (gain + coefficient) * (2.0 * 0x1p-30 + 0x1p-32 / mode.decay / 0.75);
    }
    const double fixed = 0.75 * (averages + 12.0 * coefficient) + absolute * 0x1p-32 +
                         std::ldexp(1.0, line.state().scale.output_exponent - 32);
    EXPECT_NEAR((bound_of<Sum<Modes, Plain, Q31>>(design, 0.75)) / fixed, 1.0, 1e-9);
}

// modes_bound.hpp beyond d = 1: of d = 1.5 an average reaches A = 3 peaks and forgets f = 1/2 of itself. It errs by
// A + A^2 of d, 2 A (1 + A) of its step and A/f of its state, or compensated by 14 A^2; coefficient, product and
// addition are of A peaks.
TEST(BoundFormula, OfAModeThatSwings) {
    const std::vector<Mode> swinging = {{1.5, -0.3}};
    const Design design{0.5, 3, swinging};
    const auto expected = [](double average) { return 0.75 * u * (1.0 + 1.0 + 0.2 * (3.0 * (2.0 + 2.0) + average)); };
    EXPECT_NEAR((bound_of<Sum<Modes, Plain, F32>>(design, 0.75)) / expected(12.0 + 24.0 + 6.0), 1.0, 1e-4);
    EXPECT_NEAR((bound_of<Sum<Modes, Compensated, F32>>(design, 0.75)) / expected(126.0), 1.0, 1e-4);
}

// A decay is rounded to the format, at worst by u = 2^-24 of itself. Of 2 - 2^-20 that leaves 7/8 of what a step
// forgets.
TEST(BoundFormula, OfADecayThatIsRoundedUp) {
    using K = Sum<Modes, Plain, F32>;
    EXPECT_NEAR(average_reach<K>(2.0 - 0x1p-20) / (0x1p21 * 8.0 / 7.0), 1.0, 1e-5);
    EXPECT_TRUE(std::isinf(average_reach<K>(2.0 - 0x1p-30)));
    EXPECT_DOUBLE_EQ(average_reach<K>(1.0), 1.0);
}

// cascade_bound.hpp: behind near taps the cascade is a term as a window's are. Its output, at most Y = P (1 + |H(1) -
// 1|), passes the last tap's coefficient, product and addition; what it has lost itself, which a cascade without other
// taps loses too, passes the coefficient alone.
TEST(BoundFormula, OfACascadeBehindNearTaps) {
    constexpr std::size_t near_taps = 4;
    const auto a = weights(0.5, near_taps - 1);
    const double lead = a[near_taps - 1];
    std::vector<Mode> of_lead_one = modes;
    double at_rest = 1.0;
    for (Mode& mode : of_lead_one) {
        mode.weight /= lead;
        at_rest += mode.weight / mode.decay;
    }
    using K = Sum<Cascade, DirectForm2Transposed, F32>;
    const double alone = bound_of<K>({0.5, 1 + 2 * 3, of_lead_one}, 0.75);
    const double together = bound_of<K>({0.5, near_taps + 2 * 3, modes}, 0.75);
    double roundings = near_taps + std::fabs(lead) * at_rest * (1.0 + 1.0 + 1.0);
    for (std::size_t j = 1; j + 1 < near_taps; ++j) {
        roundings += std::fabs(a[j]) * (2.0 + 1.0 + static_cast<double>(near_taps - j));
    }
    EXPECT_NEAR((together - std::fabs(lead) * alone) / (0.75 * u * roundings), 1.0, 1e-3);  // what is lost rounds, too
}

// nested_bound.hpp: a block of level l is a tap of the sum of its weights whose sample passed l additions.
TEST(BoundFormula, OfBlocks) {
    constexpr std::size_t near_taps = 5;
    constexpr std::size_t count = 6;
    constexpr std::size_t per_level = 2;
    constexpr std::size_t terms = near_taps + count;
    const Design design{0.5, terms, {}, {}, {count, per_level}};
    const auto a = weights(0.5, 100);
    double sum = 1.0 + (terms - 1);
    double absolute = 1.0;
    double means = 0.0;

    bench::HostLine<Sum<Nested, Plain, Q31>> line(design);
    const double coefficient = std::ldexp(0.5, line.state().scale.table_exponent - 31);
    for (std::size_t j = 1; j < near_taps; ++j) {
        sum += std::fabs(a[j]) * (2.0 + 1.0 + static_cast<double>(terms - j));
        absolute += std::fabs(a[j]);
    }
    std::size_t first = near_taps;
    for (std::size_t b = 0; b < count; ++b) {
        const std::size_t level = b / per_level + 1;  // of 2, 2, 4, 4, 8, 8 samples
        double weight = 0.0;
        for (std::size_t j = first; j < first + (std::size_t{1} << level); ++j) {
            weight += a[j];
        }
        first += std::size_t{1} << level;
        sum +=
            std::fabs(weight) * (2.0 + 1.0 + static_cast<double>(terms - near_taps - b) + static_cast<double>(level));
        absolute += std::fabs(weight);
        means += (std::fabs(weight) + coefficient) * static_cast<double>(level) * 0x1p-32;
    }
    expect_first_order(bound_of<Sum<Nested, Plain, F32>>(design, 0.75), 0.75 * u * sum);
    const double fixed = 0.75 * (terms - 1) * coefficient + means + absolute * 0x1p-32 +
                         std::ldexp(1.0, line.state().scale.output_exponent - 32);
    EXPECT_NEAR((bound_of<Sum<Nested, Plain, Q31>>(design, 0.75)) / fixed, 1.0, 1e-6);
}

// delta_bound.hpp: the inner sum over increments up to 2 P, each of which lost 4 u P. In fixed point all at half scale.
TEST(BoundFormula, OfIncrements) {
    constexpr std::size_t taps = 20;
    const Design design{0.75, taps};
    const Design inner{-0.25, taps};
    double absolute = 0.0;
    for (const double weight : weights(-0.25, taps - 1)) {
        absolute += std::fabs(weight);
    }
    expect_first_order(bound_of<Sum<MirrorDelta, Plain, F32>>(design, 0.75),
                       bound_of<Sum<Mirror, Plain, F32>>(inner, 1.5) + 4.0 * u * 0.75 * absolute);
    const double unit = 0x1p-31;
    EXPECT_NEAR((bound_of<Sum<MirrorDelta, Plain, Q31>>(design, 0.75)) /
                    (2.0 * (bound_of<Sum<Ring, Plain, Q31>>(inner, 0.75 + unit) + unit * absolute)),
                1.0, 1e-9);
    // In double below order 0.5 the order itself is rounded.
    constexpr double d = 0x1p-53;
    double of_low = 0.0;
    for (const double weight : weights(-0.75, taps - 1)) {
        of_low += std::fabs(weight);
    }
    const double low = bound_of<Sum<MirrorDelta, Oldest, F64>>({0.25, taps}, 0.75);
    EXPECT_NEAR((low - bound_of<Sum<Ring, Oldest, F64>>({-0.75, taps}, 1.5)) /
                    (4.0 * d * 0.75 * of_low + d * (1.0 + std::log(20.0)) * of_low * 1.5),
                1.0, 1e-3);
    for (const double order : {0.5, 0.5025}) {  // from 0.5 on it is exact
        double of_inner = 0.0;
        for (const double weight : weights(order - 1.0, taps - 1)) {
            of_inner += std::fabs(weight);
        }
        const double found = bound_of<Sum<MirrorDelta, Oldest, F64>>({order, taps}, 0.75);
        EXPECT_NEAR((found - bound_of<Sum<Ring, Oldest, F64>>({order - 1.0, taps}, 1.5)) / (4.0 * d * 0.75 * of_inner),
                    1.0, 1e-3)
            << order;
    }
}

// integral_bound.hpp: the inner sum and its last rounding, and of w_0 r, which reaches N P, five roundings and what the
// loss itself loses.
TEST(BoundFormula, OfARunningSum) {
    const std::vector<Mode> with_sum = {{0.0, 0.03}, {0.02, 2e-4}, {0.25, 4e-3}};
    const Design design{-0.5, 12, with_sum};
    const Design inner{-0.5, 10, std::span(with_sum).subspan(1)};
    double absolute = 0.0;
    for (const double weight : weights(-0.5, 5)) {
        absolute += std::fabs(weight);
    }
    for (std::size_t m = 1; m < 3; ++m) {
        absolute += std::fabs(with_sum[m].weight / with_sum[m].decay);
    }
    const double n = 3000.0;
    expect_first_order(bound_of<Sum<Integrator, Plain, F32>>(design, 0.75, 3000),
                       bound_of<Sum<Modes, Plain, F32>>(inner, 0.75) + u * 0.75 * absolute +
                           0.03 * n * 0.75 * (5.0 * u + n * u * n * u));
}

// tail_bound.hpp, of order 0.5 and so few samples that the walk is short enough to add up each step's roundings apart:
// of every later step's error the share |1 - v/i| of the steps between.
TEST(BoundFormula, OfAGuessedTail) {
    constexpr std::size_t taps = 10;
    constexpr std::size_t samples = 14;
    const auto a = weights(0.5, samples);
    double in_window = 0.0;
    for (std::size_t j = 0; j < taps; ++j) {
        in_window += a[j];
    }
    std::vector<double> tails = {0.0};
    for (std::size_t k = taps; k < samples; ++k) {
        tails.push_back(tails.back() + a[k]);
    }
    const auto made_at = [&](std::size_t k) {  // by the step to a_k
        const double before = tails[k - taps];
        return u * (0.5 / static_cast<double>(k) * (4.0 * std::fabs(in_window) + std::fabs(before)) +
                    6.0 * std::fabs(a[k]));
    };
    double held = 0.0;
    std::vector<double> of_tail;
    for (std::size_t last = taps; last < samples; ++last) {
        double carried = 0.0;
        for (std::size_t k = taps; k <= last; ++k) {
            double share = 1.0;
            for (std::size_t i = k + 1; i <= last; ++i) {
                share *= 1.0 - 0.5 / static_cast<double>(i);
            }
            carried += share * made_at(k);
        }
        of_tail.push_back(carried);
        held = std::max(held, carried + 4.0 * u * std::fabs(tails[last - taps + 1]));
    }
    EXPECT_NEAR((tail_error<Sum<MirrorHold, Plain, F32>>({0.5, taps}, samples)) / (1.001 * held), 1.0, 1e-5);
    EXPECT_EQ((tail_error<Sum<MirrorHold, Plain, F32>>({0.5, taps}, taps)), 0.0);
    // The line: its mean weight H over n steps errs by the mean of what went into it, with four roundings of T - H.
    double mean = 0.0;
    double of_mean = 0.0;
    double line = 0.0;
    for (std::size_t n = 1; n <= samples - taps; ++n) {
        const double tail = tails[n - 1];
        const double before = n > 1 ? of_tail[n - 2] : 0.0;
        const double entering = before + u * (std::fabs(tail) + std::fabs(mean) + 4.0 * std::fabs(tail - mean));
        of_mean = of_mean * (1.0 - 1.0 / static_cast<double>(n)) + entering / static_cast<double>(n);
        mean += (tail - mean) / static_cast<double>(n);
        const double now = tails[n];
        line = std::max(line, 2.0 * of_mean + of_tail[n - 1] + 5.0 * u * std::fabs(mean) +
                                  u * (std::fabs(now) + std::fabs(mean)) + 4.0 * u * std::fabs(now - mean));
    }
    EXPECT_NEAR((tail_error<Sum<MirrorLinear, Plain, F32>>({0.5, taps}, samples)) / (1.001 * line), 1.0, 1e-5);
    // Around them a window whose terms pass one or two additions more.
    const auto window = [&](double further) {
        double sum = 1.0 + (taps - 1) + further;
        for (std::size_t j = 1; j < taps; ++j) {
            sum += std::fabs(a[j]) * (2.0 + 1.0 + static_cast<double>(taps - j) + further);
        }
        return 0.75 * u * sum;
    };
    expect_first_order(bound_of<Sum<MirrorHold, Plain, F32>>({0.5, taps}, 0.75, samples),
                       window(1.0) + 0.75 * 1.001 * held);
    expect_first_order(bound_of<Sum<MirrorLinear, Plain, F32>>({0.5, taps}, 0.75, samples),
                       window(2.0) + 0.75 * 1.001 * line);
}

// The sum of the magnitudes, by its closed form where all behind a_0 have one sign: 1 + (1 - sum of all) for 0 < v < 1.
TEST(BoundFormula, AbsoluteSumsAreThoseOfTheWeights) {
    for (const double order : {0.5, 0.9, 1.5, -0.5, -1.5, 2.0, 0.0}) {
        double sum = 0.0;
        for (const double weight : weights(order, 49)) {
            sum += std::fabs(weight);
        }
        EXPECT_NEAR(absolute_sum(order, 50), sum, 1e-12 * sum) << order;
    }
}

// How many rounded operations the term of a_j passes, by the order in which each technique adds L terms up: of a
// product of its own one, none where it is fused; then each addition behind it.
TEST(Roundings, AreThoseOfTheOrderOfTheSum) {
    constexpr std::size_t taps = 23;
    for (std::size_t j = 0; j < taps; ++j) {
        const std::size_t behind = j == 0 ? taps - 1 : taps - j;  // newest first: x_k begins, a_1 is added first
        const std::size_t product = j == 0 ? 0 : 1;
        EXPECT_EQ(Plain::sum_roundings<F32>(j, taps), behind + product) << j;
        EXPECT_EQ(PlainFma::sum_roundings<F32>(j, taps), behind) << j;
        EXPECT_EQ(Fir::sum_roundings<F32>(j, taps), behind + product) << j;
        EXPECT_EQ(FirFma::sum_roundings<F32>(j, taps), behind) << j;
        // Oldest first: those after it, of which x_k is the last; the first addition, to nothing, counts as one.
        EXPECT_EQ(Oldest::sum_roundings<F32>(j, taps), j == 0 ? 1 : j + 2) << j;
        // Four chains in turn, then two additions of the four and what is left over, then x_k.
        EXPECT_EQ(Multi::sum_roundings<F32>(j, taps), j == 0 ? 1 : 1 + 22 / 4 + 2 + 3) << j;
        // Horner form: a product and an addition at each step, from its own to the newest.
        EXPECT_EQ(Horner::sum_roundings<F32>(j, taps), 2 * j + 1) << j;
        EXPECT_EQ(HornerFma::sum_roundings<F32>(j, taps), j + 1) << j;
        EXPECT_EQ(HornerSplit::sum_roundings<F32>(j, taps), 2 * (j / 4 + 1) + 4) << j;
        EXPECT_EQ(Compensated::sum_roundings<F32>(j, taps), 3U) << j;  // whatever the length, up to thousands
        // Coefficients that are its factors: one, or of the Horner forms each on its way.
        EXPECT_EQ(Plain::coefficient_roundings(j), product);
        EXPECT_EQ(Horner::coefficient_roundings(j), j);
        EXPECT_EQ(HornerSplit::coefficient_roundings(j), j == 0 ? 0 : (j + 3) / 4);
    }
    EXPECT_EQ(Compensated::sum_roundings<F32>(1, 4096), 5U);  // second order: L^2 u twice
    // 22 past samples are 16 and 6: a product, three additions among eight and one of two eights, which is joined to
    // the six, and x_k. One of the six: the product, six additions, one half that waits, and x_k.
    EXPECT_EQ(Pairwise::sum_roundings<F32>(0, taps), 1U);
    EXPECT_EQ(Pairwise::sum_roundings<F32>(1, taps), 1U + 3 + 1 + 1 + 1);
    EXPECT_EQ(Pairwise::sum_roundings<F32>(16, taps), 1U + 3 + 1 + 1 + 1);
    EXPECT_EQ(Pairwise::sum_roundings<F32>(17, taps), 1U + 6 + 1 + 1);
    // Each doubling of the length costs one.
    for (std::size_t doublings = 3; doublings < 20; ++doublings) {
        EXPECT_EQ(Pairwise::sum_roundings<F32>(1, (std::size_t{1} << doublings) + 1), doublings + 3) << doublings;
    }
    // Four accumulators of as many lanes as fit 64 bytes, then a tree of them all, and x_k.
    EXPECT_EQ(Simd::sum_roundings<F32>(0, 601), 1U);
    std::size_t tree = 0;
    for (std::size_t lanes = 1; lanes < Simd::accumulators * Simd::block<F32>; lanes *= 2) {
        ++tree;
    }
    EXPECT_EQ(Simd::sum_roundings<F32>(7, 601), 1U + 600U / (Simd::accumulators * Simd::block<F32>)+tree + 1U);
}

// The Horner form in fixed point: each factor errs by half a unit of the table, the product of the first j stands for
// a_j; each step loses half a unit of 2^-31, which a_j carries to the output.
TEST(BoundFormula, OfAHornerFormInFixedPoint) {
    constexpr std::size_t taps = 12;
    const Design design{0.5, taps};
    bench::HostLine<Sum<Ring, Horner, Q31>> line(design);
    const auto a = weights(0.5, taps - 1);
    const double unit = std::ldexp(0.5, line.state().scale.table_exponent - 31);
    double of_weights = 0.0;
    double of_steps = 0.0;
    double absolute = 0.0;
    for (std::size_t j = 0; j < taps; ++j) {
        absolute += std::fabs(a[j]);
        of_steps += j + 1 < taps ? std::fabs(a[j]) : 0.0;
        // d(c_1 c_2 ... c_j) to first order: each factor's half unit times the others.
        for (std::size_t i = 1; i <= j; ++i) {
            const double factor = a[i] / a[i - 1];
            of_weights += unit * std::fabs(a[j] / factor);
        }
    }
    const double expected = 0.75 * of_weights + of_steps * 0x1p-32 + absolute * 0x1p-32 +
                            std::ldexp(1.0, line.state().scale.output_exponent - 32);
    EXPECT_NEAR((bound_of<Sum<Ring, Horner, Q31>>(design, 0.75)) / expected, 1.0, 1e-6);
}

// Where nothing is summed up, products that vanish are left: half of the smallest denormal number for each term, or a
// whole one.
TEST(BoundFormula, OfSilenceAreDenormals) {
    constexpr double least = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ((bound_of<Sum<Ring, Plain, F32>>({0.5, 30}, 0.0)), 30.0 * least);
    EXPECT_EQ((bound_of<Sum<Shift, Plain, F64>>({0.5, 30}, 0.0)), 30.0 * std::numeric_limits<double>::denorm_min());
    EXPECT_EQ((bound_of<Sum<Modes, Plain, F32>>({0.5, 16}, 0.0)), 16.0 * least);
    EXPECT_EQ((bound_of<Sum<Nested, Plain, F32>>({0.5, 11, {}, {}, {6, 2}}, 0.0)), 11.0 * least);
    EXPECT_EQ((bound_of<Sum<MirrorHold, Plain, F32>>({0.5, 10}, 0.0, 14)), 18.0 * least);
    EXPECT_NEAR((bound_of<Sum<MirrorDelta, Plain, F32>>({1.0, 10}, 0.0)), (10.0 + 1.0) * least, 1e-3 * least);
    // A running sum that has lost as much at each of its samples.
    const std::vector<Mode> with_sum = {{0.0, 0.5}};
    EXPECT_NEAR((bound_of<Sum<Integrator, Plain, F32>>({-0.5, 6, with_sum}, 0.0, 1000)), (4.0 + 0.5 * 1000.0) * least,
                1e-3 * least);
}

// modes_bound.hpp: once = 6 u + u/d, or 14 u + 4 u^2/d, and what denormals lose; carried on for as long as it lives.
TEST(BoundFormula, OfAnAverage) {
    using Stops = Sum<Modes, Plain, F32>;
    using Carries = Sum<Modes, Compensated, F32>;
    constexpr double least = std::numeric_limits<float>::denorm_min();
    const auto carried = [](double once) { return once / (1.0 - once); };
    EXPECT_NEAR(average_error<Stops>(1e-3, 1.0) / carried(6.0 * u + 1e3 * u), 1.0, 1e-12);
    EXPECT_NEAR(average_error<Stops>(1.0, 1.0) / carried(7.0 * u), 1.0, 1e-12);
    EXPECT_NEAR(average_error<Carries>(1e-8, 1.0) / carried(14.0 * u + 4e8 * u * u), 1.0, 1e-12);
    EXPECT_NEAR(average_error<Carries>(0.5, 1e-40) / carried(14.0 * u + 8.0 * u * u + least / 0.5 / 1e-40), 1.0, 1e-12);
    EXPECT_EQ(average_error<Stops>(0.5 * u, 1.0), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isfinite(average_error<Stops>(2.0 * u, 1.0)));
    // What is wrong as much as it is large once has no bound any more: u/d of 1.005 and of 0.995.
    EXPECT_EQ(average_error<Stops>(u / 1.005, 1.0), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(average_error<Stops>(u / 0.995, 1.0), 0.995 / 0.005, 0.05);
    // Just beyond d = 1 already: A = d / (2 - d), f = 2 - d.
    for (const double d : {1.001, 1.0099, 1.5}) {
        const double reach = d / (2.0 - d);
        const double once = 3.0 * u * reach * (1.0 + reach) + u * reach / (2.0 - d);
        EXPECT_NEAR(average_error<Stops>(d, 1.0) / carried(once), 1.0, 1e-6) << d;
    }
    EXPECT_NEAR((average_error<Sum<Modes, Plain, Q31>>(0.01, 0.25)), 0x1p-29 + 0x1p-32 / 0.01 / 0.25, 1e-20);
}

// nested_bound.hpp, where the sums of weights are rounded as well: in double, and in fixed point to the last term.
TEST(BoundFormula, OfBlocksWhoseWeightsAreRoundedToo) {
    constexpr std::size_t near_taps = 5;
    constexpr std::size_t terms = 11;
    const Design design{1.5, terms, {}, {}, {6, 2}};
    const auto a = weights(1.5, 40);
    bench::HostLine<Sum<Nested, Plain, Q31>> line(design);
    const double coefficient = std::ldexp(0.5, line.state().scale.table_exponent - 31);
    double sum = 1.0 + (terms - 1);
    double absolute = 1.0;
    double means = 0.0;
    double of_blocks = 0.0;
    for (std::size_t j = 1; j < near_taps; ++j) {
        sum += std::fabs(a[j]) * (3.0 + static_cast<double>(terms - j));
        absolute += std::fabs(a[j]);
    }
    std::size_t from = near_taps;
    for (std::size_t b = 0; b < 6; ++b) {
        const std::size_t level = b / 2 + 1;
        double weight = 0.0;
        double magnitude = 0.0;
        for (std::size_t j = from; j < from + (std::size_t{1} << level); ++j) {
            weight += a[j];
            magnitude += std::fabs(a[j]);
        }
        from += std::size_t{1} << level;
        sum += std::fabs(weight) * (3.0 + static_cast<double>(terms - near_taps - b) + static_cast<double>(level));
        absolute += std::fabs(weight);
        of_blocks += magnitude;
        means += (std::fabs(weight) + coefficient) * static_cast<double>(level) * 0x1p-32 + 0x1p-52 * magnitude * 0.75;
    }
    EXPECT_NEAR((bound_of<Sum<Nested, Plain, F64>>(design, 0.75)) / (0.75 * (0x1p-53 * sum + 0x1.01p-52 * of_blocks)),
                1.0, 1e-9);
    const double fixed = 0.75 * (terms - 1) * coefficient + means + absolute * 0x1p-32 +
                         std::ldexp(1.0, line.state().scale.output_exponent - 32);
    EXPECT_NEAR((bound_of<Sum<Nested, Plain, Q31>>(design, 0.75)) / fixed, 1.0, 1e-11);
}

}  // namespace
