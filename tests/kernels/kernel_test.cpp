// What holds for every kernel, whatever it is made of.
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <set>

#include "glsum/bound.hpp"
#include "tests/kernels/registered.hpp"

namespace {

using test::Line;

template <class K>
class KernelTest : public testing::Test {};
TYPED_TEST_SUITE(KernelTest, test::Kernels, test::KernelNames);

constexpr double orders[] = {0.2, 0.5, 0.98319, 1.0, 1.5, 1.9909, 2.0, -0.5, -1.0};
// 1, around the unroll of every loop (pairs, blocks of 8 and 16, four accumulators of them) and beyond it.
constexpr std::size_t lengths[] = {1, 2, 3, 4, 5, 8, 9, 15, 16, 17, 18, 31, 32, 33, 34, 63, 64, 65, 66, 128, 129, 200};

double noise(std::mt19937_64& generator) { return 0.9 * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0); }

TYPED_TEST(KernelTest, ImpulseGivesTheWeightsOverTheWholeWindowAndNothingAfter) {
    for (const double order : orders) {
        for (const std::size_t taps : lengths) {
            Line<TypeParam> line({order, taps});
            if (!TypeParam::order_in_range(order)) {
                ASSERT_EQ(line.status(), glsum::Status::order_out_of_range);
                continue;
            }
            ASSERT_EQ(line.status(), glsum::Status::ok);
            const std::size_t samples = 2 * taps + 3;
            const double bound = glsum::error_bound<TypeParam>({order, taps}, line.state(), 0.5, samples);
            std::vector<double> after(samples, 0.0);  // what follows the weights
            if constexpr (!test::takes_zero<TypeParam>) {
                std::vector<double> impulse(samples, 0.0);
                impulse[0] = 0.5;
                const auto exact = test::exact_sums<TypeParam>({order, taps}, impulse);
                std::transform(exact.begin(), exact.end(), after.begin(), [](const auto& sum) { return sum.high; });
            }
            glsum::Weights weights(order);
            double weight = 1.0;
            for (std::size_t k = 0; k < samples; ++k) {
                const double expected = k < taps ? 0.5 * weight : after[k];
                ASSERT_NEAR(line.step_real(k == 0 ? 0.5 : 0.0), expected, k < taps || after[k] != 0.0 ? bound : 0.0)
                    << "order " << order << ", taps " << taps << ", k " << k;
                weights.next();
                weight = weights.weight();
            }
        }
    }
}

// An impulse of each age while the history wraps several times: finds a sample lost or doubled at any position.
TYPED_TEST(KernelTest, WindowKeepsEverySampleOverManyTurns) {
    for (const std::size_t taps : {1U, 2U, 3U, 5U, 16U, 17U, 64U, 65U}) {
        Line<TypeParam> line({1.5, taps});
        const double bound = glsum::error_bound<TypeParam>({1.5, taps}, line.state(), 0.9);
        std::mt19937_64 generator(taps);
        std::vector<double> past;
        std::vector<double> weights{1.0};
        glsum::Weights walk(1.5);
        while (weights.size() < taps) {
            walk.next();
            weights.push_back(walk.weight());
        }
        for (std::size_t k = 0; k < 5 * taps + 7; ++k) {
            past.push_back(noise(generator));
            double expected = 0.0;
            if constexpr (test::takes_zero<TypeParam>) {
                for (std::size_t j = std::min(taps, past.size()); j > 0; --j) {
                    expected += weights[j - 1] * past[past.size() - j];
                }
            } else {
                expected = test::exact_sums<TypeParam>({1.5, taps}, past).back().high;
            }
            ASSERT_NEAR(line.step_real(past.back()), expected, bound + 1e-14) << "taps " << taps << ", k " << k;
        }
    }
}

TYPED_TEST(KernelTest, WholeOrdersAreExact) {
    // Differences, the identity and the running sum of multiples of 1/64, exact in every format.
    const auto sample = [](std::size_t k) { return (static_cast<double>((5 * k * k + 3 * k) % 13) - 6.0) / 64.0; };
    for (const std::size_t taps : lengths) {
        for (const int order : {0, 1, 2, -1}) {
            const glsum::Design design{static_cast<double>(order), taps};
            if (!TypeParam::order_in_range(design.order)) {
                continue;
            }
            Line<TypeParam> line(design);
            if constexpr (!test::takes_zero<TypeParam>) {
                // Whole weights of what is dropped; but a share of one, where the line has any.
                if (reference::dropped_by<typename TypeParam::HistoryPart>() == reference::Dropped::line &&
                    order >= static_cast<int>(taps)) {
                    continue;
                }
                std::vector<double> record(2 * taps + 3);
                for (std::size_t k = 0; k < record.size(); ++k) {
                    record[k] = sample(k);
                }
                const auto exact = test::exact_sums<TypeParam>(design, record);
                for (std::size_t k = 0; k < record.size(); ++k) {
                    ASSERT_EQ(line.step_real(record[k]), exact[k].high)
                        << "order " << order << ", taps " << taps << ", k " << k;
                }
                continue;
            }
            double running = 0.0;
            for (std::size_t k = 0; k < 2 * taps + 3; ++k) {
                const double x0 = sample(k);
                const double x1 = k >= 1 && taps >= 2 ? sample(k - 1) : 0.0;
                const double x2 = k >= 2 && taps >= 3 ? sample(k - 2) : 0.0;
                running += x0 - (k >= taps ? sample(k - taps) : 0.0);
                const double expected = order == 0   ? x0
                                        : order == 1 ? x0 - x1
                                        : order == 2 ? x0 - 2.0 * x1 + x2
                                                     : running;
                ASSERT_EQ(line.step_real(x0), expected) << "order " << order << ", taps " << taps << ", k " << k;
            }
        }
    }
}

// Weights that no order has, as a merged table of several: they alone count, and a design that has too few of them, or
// one that is none, is refused.
TYPED_TEST(KernelTest, TakesNamedWeightsInPlaceOfThoseOfItsOrder) {
    const std::vector<double> weights = {-0.75, 0.5, 0.25, -0.125, 0.375, -0.0625, 0.4375, -0.25, 0.125};
    std::vector<typename TypeParam::Coefficient> table(TypeParam::table_count(10) + 1);
    std::vector<typename TypeParam::Sample> past(TypeParam::past_count(10) + 1);
    typename TypeParam::State state{};
    const auto prepare = [&](std::span<const double> named, std::size_t taps) {
        return TypeParam::prepare(state, {0.5, taps, {}, named}, table, past);
    };
    if constexpr (glsum::guesses_tail<typename TypeParam::HistoryPart>) {
        EXPECT_EQ(prepare(weights, 10), glsum::Status::weights_out_of_range);  // they do not say what lies behind
        EXPECT_EQ(prepare({}, 10), glsum::Status::ok);
        return;
    }
    constexpr bool nested = TypeParam::TechniquePart::word.starts_with("horner");
    constexpr bool refuses = nested && TypeParam::FormatPart::fixed_point;
    for (const std::size_t taps : {2U, 3U, 6U, 10U}) {
        const glsum::Design design{0.5, taps, {}, weights};
        Line<TypeParam> line(design);
        ASSERT_EQ(line.status(), refuses ? glsum::Status::weights_out_of_range : glsum::Status::ok);
        if (refuses) {
            continue;
        }
        const double bound = glsum::error_bound<TypeParam>(design, line.state(), 0.5);
        // Over increments: the weights of x_k - x_(k-1).
        const auto weight = [&](std::size_t j) { return j == 0 ? 1.0 : j < taps ? weights[j - 1] : 0.0; };
        constexpr bool increments = glsum::keeps_increments<typename TypeParam::HistoryPart>;
        for (std::size_t k = 0; k < 2 * taps + 3; ++k) {
            const double expected = 0.5 * (weight(k) - (increments && k > 0 ? weight(k - 1) : 0.0));
            ASSERT_NEAR(line.step_real(k == 0 ? 0.5 : 0.0), expected, k < taps || expected != 0.0 ? bound : 0.0)
                << taps << " " << k;
        }
    }
    EXPECT_EQ(prepare(std::span(weights).first(8), 10), glsum::Status::weights_out_of_range);
    for (const double none : {std::nan(""), static_cast<double>(INFINITY)}) {
        std::vector<double> bad = weights;
        bad[4] = none;
        EXPECT_EQ(prepare(bad, 10), glsum::Status::weights_out_of_range);
    }
    std::vector<double> gap = weights;
    gap[3] = 0.0;
    EXPECT_EQ(prepare(gap, 10), nested ? glsum::Status::weights_out_of_range : glsum::Status::ok);
    gap.assign(9, 0.0);
    gap[0] = 0.5;  // nothing behind the last: that can be nested
    EXPECT_EQ(prepare(gap, 10), refuses ? glsum::Status::weights_out_of_range : glsum::Status::ok);
}

TYPED_TEST(KernelTest, IsLinear) {
    const glsum::Design design{0.7, 77};
    Line<TypeParam> one(design);
    Line<TypeParam> other(design);
    Line<TypeParam> both(design);
    const double bound = 3.0 * glsum::error_bound<TypeParam>(design, one.state(), 0.9);
    std::mt19937_64 generator(7);
    for (int k = 0; k < 300; ++k) {
        const double x = noise(generator);
        const double y = noise(generator);
        ASSERT_NEAR(both.step_real(0.5 * x - 0.25 * y), 0.5 * one.step_real(x) - 0.25 * other.step_real(y), bound);
    }
}

TYPED_TEST(KernelTest, ResetForgetsAndRepeats) {
    Line<TypeParam> line({0.5, 33});
    std::vector<typename TypeParam::Output> first;
    for (int round = 0; round < 2; ++round) {
        std::mt19937_64 generator(3);
        for (std::size_t k = 0; k < 100; ++k) {
            const auto output = TypeParam::step(line.state(), TypeParam::from_real(noise(generator)));
            if (round == 0) {
                first.push_back(output);
            } else {
                ASSERT_EQ(std::memcmp(&output, &first[k], sizeof output), 0) << "k " << k;
            }
        }
        TypeParam::reset(line.state());
    }
}

template <class K>
void expect_halves_are_the_step() {
    for (const std::size_t taps : {1, 2, 3, 4, 5, 6, 9, 33}) {
        Line<K> whole({0.5, taps});
        Line<K> halves({0.5, taps});
        std::mt19937_64 generator(5);
        for (std::size_t k = 0; k < 100; ++k) {
            const auto sample = K::from_real(noise(generator));
            const auto expected = K::step(whole.state(), sample);
            typename K::Output output;
            if (generator() % 4 == 0) {  // either may be called, from sample to sample
                output = K::step(halves.state(), sample);
            } else {
                output = K::answer(halves.state(), sample);
                K::settle(halves.state(), sample);
            }
            ASSERT_EQ(std::memcmp(&output, &expected, sizeof output), 0)
                << K::name() << ", taps " << taps << ", k " << k;
        }
    }
}

TEST(Halves, AreTheWholeStep) {
    int kernels = 0;
    glsum::Registry::for_each([&]<class K>() {
        if constexpr (glsum::InHalves<K>) {
            ++kernels;
            expect_halves_are_the_step<K>();
        }
    });
    EXPECT_EQ(kernels, 2);
}

TYPED_TEST(KernelTest, PrepareServesAnyLengthAndOrderWithinTheCapacity) {
    glsum::Line<TypeParam, 50> line;
    EXPECT_EQ(line.prepare({0.5, 50}), glsum::Status::ok);
    for (int k = 0; k < 60; ++k) {
        line.step(TypeParam::from_real(0.25));
    }
    ASSERT_EQ(line.prepare({1.0, 7}), glsum::Status::ok);
    EXPECT_EQ(TypeParam::to_real(line.state(), line.step(TypeParam::from_real(0.5))), 0.5);
    EXPECT_EQ(TypeParam::to_real(line.state(), line.step(TypeParam::from_real(0.5))), 0.0);
    EXPECT_EQ(line.prepare({0.5, 0}), glsum::Status::no_taps);
    EXPECT_NE(line.prepare({0.5, 1000}), glsum::Status::ok);
    EXPECT_EQ(line.prepare({-2.0, 7}), glsum::Status::order_out_of_range);
    EXPECT_EQ(line.prepare({2.1, 7}), glsum::Status::order_out_of_range);
    EXPECT_EQ(line.prepare({std::nan(""), 7}), glsum::Status::order_out_of_range);
    // A refusal leaves the kernel as it was.
    EXPECT_EQ(TypeParam::to_real(line.state(), line.step(TypeParam::from_real(0.25))), -0.25);
}

TYPED_TEST(KernelTest, StaysInsideItsBuffersAndWorksAtAnyAlignmentOfItsType) {
    using Coefficient = typename TypeParam::Coefficient;
    using Sample = typename TypeParam::Sample;
    constexpr std::size_t guard = 32;
    const std::size_t taps = 37;
    for (const std::size_t offset : {0U, 1U, 3U}) {
        std::vector<Coefficient> table(TypeParam::table_count(taps) + 2 * guard + offset, Coefficient(77));
        std::vector<Sample> past(TypeParam::past_count(taps) + 2 * guard + offset, Sample(77));
        typename TypeParam::State state{};
        ASSERT_EQ(TypeParam::prepare(state, {0.5, taps},
                                     std::span(table).subspan(guard + offset, TypeParam::table_count(taps)),
                                     std::span(past).subspan(guard + offset, TypeParam::past_count(taps))),
                  glsum::Status::ok);
        Line<TypeParam> aligned({0.5, taps});
        std::mt19937_64 generator(9);
        for (int k = 0; k < 200; ++k) {
            const Sample x = TypeParam::from_real(noise(generator));
            ASSERT_EQ(TypeParam::step(state, x), aligned.step(x));
        }
        for (std::size_t i = 0; i < guard; ++i) {
            ASSERT_EQ(table[i], Coefficient(77));
            ASSERT_EQ(table[table.size() - 1 - i], Coefficient(77));
            ASSERT_EQ(past[i], Sample(77));
            ASSERT_EQ(past[past.size() - 1 - i], Sample(77));
        }
    }
}

TYPED_TEST(KernelTest, RefusesBuffersThatAreTooSmall) {
    std::vector<typename TypeParam::Coefficient> table(glsum::table_needed<TypeParam>({0.5, 20}));
    std::vector<typename TypeParam::Sample> past(glsum::past_needed<TypeParam>({0.5, 20}));
    typename TypeParam::State state{};
    const auto prepare = [&](std::size_t less_table, std::size_t less_past) {
        return TypeParam::prepare(state, {0.5, 20}, std::span(table).first(table.size() - less_table),
                                  std::span(past).first(past.size() - less_past));
    };
    EXPECT_EQ(prepare(0, 0), glsum::Status::ok);
    EXPECT_EQ(prepare(1, 0), glsum::Status::table_too_small);
    EXPECT_EQ(prepare(0, 1), glsum::Status::past_too_small);
}

TEST(Registry, NamesAreDistinctAndHaveThreeWords) {
    std::set<std::string_view> names;
    glsum::Registry::for_each([&]<class K>() {
        EXPECT_TRUE(names.insert(K::name()).second) << K::name();
        EXPECT_EQ(std::count(K::name().begin(), K::name().end(), '_'), K::name() == "null" ? 0 : 2) << K::name();
    });
    EXPECT_EQ(names.size(), glsum::Registry::count);
}

TEST(Null, ReturnsItsArgument) {
    glsum::Line<glsum::Null, 1> line;
    EXPECT_EQ(line.prepare({0.5, 1}), glsum::Status::ok);
    EXPECT_EQ(line.step(0.25F), 0.25F);
}

}  // namespace
