// What holds for every kernel, whatever it is made of.
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <set>

#include "bench/sweep/host_line.hpp"
#include "glsum/registry.hpp"
#include "tests/kernels/any_kernel.hpp"

namespace {

using glsum::Status;

class KernelTest : public test::EveryKernel {};
INSTANTIATE_TEST_SUITE_P(, KernelTest, testing::ValuesIn(test::any_kernels()), test::name_of);

constexpr double orders[] = {0.2, 0.5, 0.98319, 1.0, 1.5, 1.9909, 2.0, -0.5, -1.0};
// 1, around the unroll of every loop (pairs, blocks of 8 and 16, four accumulators of them) and beyond it.
constexpr std::size_t lengths[] = {1, 2, 3, 4, 5, 8, 9, 15, 16, 17, 18, 31, 32, 33, 34, 63, 64, 65, 66, 128, 129, 200};

double noise(std::mt19937_64& generator) { return 0.9 * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0); }

TEST_P(KernelTest, ImpulseGivesTheWeightsOverTheWholeWindowAndNothingAfter) {
    for (const double order : orders) {
        for (const std::size_t taps : lengths) {
            const auto line = kernel.line({order, taps});
            if (!kernel.order_in_range(order)) {
                ASSERT_EQ(line->status(), Status::order_out_of_range);
                continue;
            }
            ASSERT_EQ(line->status(), Status::ok);
            const std::size_t samples = 2 * taps + 3;
            const double bound = line->bound({order, taps}, 0.5, samples);
            std::vector<double> after(samples, 0.0);  // what follows the weights
            if (!kernel.takes_zero()) {
                std::vector<double> impulse(samples, 0.0);
                impulse[0] = 0.5;
                const auto exact = kernel.exact_sums({order, taps}, impulse);
                std::transform(exact.begin(), exact.end(), after.begin(), [](const auto& sum) { return sum.high; });
            }
            glsum::Weights weights(order);
            double weight = 1.0;
            for (std::size_t k = 0; k < samples; ++k) {
                const double expected = k < taps ? 0.5 * weight : after[k];
                ASSERT_NEAR(line->step(k == 0 ? 0.5 : 0.0), expected, k < taps || after[k] != 0.0 ? bound : 0.0)
                    << "order " << order << ", taps " << taps << ", k " << k;
                weights.next();
                weight = weights.weight();
            }
        }
    }
}

// An impulse of each age while the history wraps several times: finds a sample lost or doubled at any position.
TEST_P(KernelTest, WindowKeepsEverySampleOverManyTurns) {
    for (const std::size_t taps : {1U, 2U, 3U, 5U, 16U, 17U, 64U, 65U}) {
        const auto line = kernel.line({1.5, taps});
        const double bound = line->bound({1.5, taps}, 0.9);
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
            if (kernel.takes_zero()) {
                for (std::size_t j = std::min(taps, past.size()); j > 0; --j) {
                    expected += weights[j - 1] * past[past.size() - j];
                }
            } else {
                expected = kernel.exact_sums({1.5, taps}, past).back().high;
            }
            ASSERT_NEAR(line->step(past.back()), expected, bound + 1e-14) << "taps " << taps << ", k " << k;
        }
    }
}

TEST_P(KernelTest, WholeOrdersAreExact) {
    // Differences, the identity and the running sum of multiples of 1/64, exact in every format.
    const auto sample = [](std::size_t k) { return (static_cast<double>((5 * k * k + 3 * k) % 13) - 6.0) / 64.0; };
    for (const std::size_t taps : lengths) {
        for (const int order : {0, 1, 2, -1}) {
            const glsum::Design design{static_cast<double>(order), taps};
            if (!kernel.order_in_range(design.order)) {
                continue;
            }
            const auto line = kernel.line(design);
            if (!kernel.takes_zero()) {
                // Whole weights of what is dropped; but a share of one, where the line has any.
                if (kernel.dropped == reference::Dropped::line && order >= static_cast<int>(taps)) {
                    continue;
                }
                std::vector<double> record(2 * taps + 3);
                for (std::size_t k = 0; k < record.size(); ++k) {
                    record[k] = sample(k);
                }
                const auto exact = kernel.exact_sums(design, record);
                for (std::size_t k = 0; k < record.size(); ++k) {
                    ASSERT_EQ(line->step(record[k]), exact[k].high)
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
                ASSERT_EQ(line->step(x0), expected) << "order " << order << ", taps " << taps << ", k " << k;
            }
        }
    }
}

// Weights that no order has, as a merged table of several: they alone count, and a design that has too few of them, or
// one that is none, is refused.
TEST_P(KernelTest, TakesNamedWeightsInPlaceOfThoseOfItsOrder) {
    const std::vector<double> weights = {-0.75, 0.5, 0.25, -0.125, 0.375, -0.0625, 0.4375, -0.25, 0.125};
    const auto prepare = [line = kernel.line({0.5, 10})](std::span<const double> named) {
        return line->prepare({0.5, 10, {}, named});
    };
    if (kernel.guesses()) {
        EXPECT_EQ(prepare(weights), Status::weights_out_of_range);  // they do not say what lies behind
        EXPECT_EQ(prepare({}), Status::ok);
        return;
    }
    const bool refuses = kernel.horner() && kernel.fixed_point;
    for (const std::size_t taps : {2U, 3U, 6U, 10U}) {
        const glsum::Design design{0.5, taps, {}, weights};
        const auto line = kernel.line(design);
        ASSERT_EQ(line->status(), refuses ? Status::weights_out_of_range : Status::ok);
        if (refuses) {
            continue;
        }
        const double bound = line->bound(design, 0.5);
        // Over increments: the weights of x_k - x_(k-1).
        const auto weight = [&](std::size_t j) { return j == 0 ? 1.0 : j < taps ? weights[j - 1] : 0.0; };
        const bool increments = kernel.dropped == reference::Dropped::increments;
        for (std::size_t k = 0; k < 2 * taps + 3; ++k) {
            const double expected = 0.5 * (weight(k) - (increments && k > 0 ? weight(k - 1) : 0.0));
            ASSERT_NEAR(line->step(k == 0 ? 0.5 : 0.0), expected, k < taps || expected != 0.0 ? bound : 0.0)
                << taps << " " << k;
        }
    }
    EXPECT_EQ(prepare(std::span(weights).first(8)), Status::weights_out_of_range);
    for (const double none : {std::nan(""), static_cast<double>(INFINITY)}) {
        std::vector<double> bad = weights;
        bad[4] = none;
        EXPECT_EQ(prepare(bad), Status::weights_out_of_range);
    }
    std::vector<double> gap = weights;
    gap[3] = 0.0;
    EXPECT_EQ(prepare(gap), kernel.horner() ? Status::weights_out_of_range : Status::ok);
    gap.assign(9, 0.0);
    gap[0] = 0.5;  // nothing behind the last: that has a Horner form
    EXPECT_EQ(prepare(gap), refuses ? Status::weights_out_of_range : Status::ok);
}

// As the formats promise. A coefficient of 0 for a sample that has left would not do: it makes NaN of infinity.
TEST_P(KernelTest, KeepsWhatIsNotFiniteForTheLengthOfTheMemory) {
    if (kernel.fixed_point || !kernel.of_window || !kernel.takes_zero()) {
        return;
    }
    for (const std::size_t taps : {2U, 5U, 17U, 18U, 33U, 40U, 50U}) {
        for (const double none : {static_cast<double>(INFINITY), std::nan("")}) {
            const auto line = kernel.line({0.5, taps});
            for (int k = 0; k < 3; ++k) {
                line->step(0.25);
            }
            for (std::size_t k = 0; k < 3 * taps; ++k) {
                EXPECT_EQ(std::isfinite(line->step(k == 0 ? none : 0.25)), k >= taps)
                    << taps << ' ' << none << ' ' << k;
            }
        }
    }
}

TEST_P(KernelTest, IsLinear) {
    const glsum::Design design{0.7, 77};
    const auto one = kernel.line(design);
    const auto other = kernel.line(design);
    const auto both = kernel.line(design);
    const double bound = 3.0 * one->bound(design, 0.9);
    std::mt19937_64 generator(7);
    for (int k = 0; k < 300; ++k) {
        const double x = noise(generator);
        const double y = noise(generator);
        ASSERT_NEAR(both->step(0.5 * x - 0.25 * y), 0.5 * one->step(x) - 0.25 * other->step(y), bound);
    }
}

TEST_P(KernelTest, ResetForgetsAndRepeats) {
    const auto line = kernel.line({0.5, 33});
    std::vector<std::uint64_t> first;
    for (int round = 0; round < 2; ++round) {
        std::mt19937_64 generator(3);
        for (std::size_t k = 0; k < 100; ++k) {
            const auto bits = std::bit_cast<std::uint64_t>(line->step(noise(generator)));
            if (round == 0) {
                first.push_back(bits);
            } else {
                ASSERT_EQ(bits, first[k]) << "k " << k;
            }
        }
        line->reset();
    }
}

template <class K>
void expect_halves_are_the_step() {
    for (const std::size_t taps : {1, 2, 3, 4, 5, 6, 9, 33}) {
        bench::HostLine<K> whole({0.5, taps});
        bench::HostLine<K> halves({0.5, taps});
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
    EXPECT_EQ(kernels, 3);
}

TEST_P(KernelTest, PrepareServesAnyLengthAndOrderWithinTheCapacity) {
    const auto line = kernel.line({0.5, 50});
    EXPECT_EQ(line->status(), Status::ok);
    for (int k = 0; k < 60; ++k) {
        line->step(0.25);
    }
    ASSERT_EQ(line->prepare({1.0, 7}), Status::ok);
    EXPECT_EQ(line->step(0.5), 0.5);
    EXPECT_EQ(line->step(0.5), 0.0);
    EXPECT_EQ(line->prepare({0.5, 0}), Status::no_taps);
    EXPECT_NE(line->prepare({0.5, 1000}), Status::ok);
    EXPECT_EQ(line->prepare({-2.0, 7}), Status::order_out_of_range);
    EXPECT_EQ(line->prepare({2.1, 7}), Status::order_out_of_range);
    EXPECT_EQ(line->prepare({std::nan(""), 7}), Status::order_out_of_range);
    // A refusal leaves the kernel as it was.
    EXPECT_EQ(line->step(0.25), -0.25);
}

// On a microcontroller a state may lie anywhere and begin as anything.
TEST_P(KernelTest, PrepareLeavesNothingOfWhatLayInItsMemory) {
    for (const std::size_t taps : {1U, 2U, 5U, 33U}) {
        const glsum::Design design{0.5, taps};
        const auto fresh = kernel.line(design);
        const auto spoilt = kernel.line(design);
        spoilt->spoil();
        ASSERT_EQ(spoilt->prepare(design), Status::ok);
        std::mt19937_64 generator(4);
        for (int k = 0; k < 100; ++k) {
            const double x = noise(generator);
            ASSERT_EQ(std::bit_cast<std::uint64_t>(spoilt->step(x)), std::bit_cast<std::uint64_t>(fresh->step(x)))
                << taps << " taps, k " << k;
        }
    }
}

TEST_P(KernelTest, StaysInsideItsBuffersAndWorksAtAnyAlignmentOfItsType) {
    const glsum::Design design{0.5, 37};
    for (const std::size_t offset : {0U, 1U, 3U}) {
        const auto line = kernel.line(design, offset);
        const auto aligned = kernel.line(design);
        ASSERT_EQ(line->status(), Status::ok);
        std::mt19937_64 generator(9);
        for (int k = 0; k < 200; ++k) {
            const double x = noise(generator);
            ASSERT_EQ(line->step(x), aligned->step(x));
        }
        ASSERT_TRUE(line->guards_hold());
    }
}

TEST_P(KernelTest, RefusesBuffersThatAreTooSmall) {
    const auto line = kernel.line({0.5, 20});
    EXPECT_EQ(line->prepare({0.5, 20}), Status::ok);
    EXPECT_EQ(line->prepare({0.5, 20}, 1, 0), Status::table_too_small);
    EXPECT_EQ(line->prepare({0.5, 20}, 0, 1), Status::past_too_small);
}

// The convenient way to use a kernel; its capacity says what its buffers hold.
template <class K>
void expect_line_holds_its_capacity() {
    glsum::Line<K, 50> line;
    ASSERT_EQ(line.prepare({0.5, 50}), Status::ok) << K::name();
    bench::HostLine<K> other({0.5, 50});
    std::mt19937_64 generator(11);
    for (int k = 0; k < 120; ++k) {
        const auto x = K::from_real(noise(generator));
        ASSERT_EQ(line.step(x), other.step(x)) << K::name() << " " << k;
    }
    line.reset();
    EXPECT_EQ(K::to_real(line.state(), line.step(K::from_real(0.5))), 0.5) << K::name();
    EXPECT_NE(line.prepare({0.5, 1000}), Status::ok) << K::name();
}

TEST(Line, HoldsItsCapacity) {
    expect_line_holds_its_capacity<glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>>();
    expect_line_holds_its_capacity<glsum::Sum<glsum::Mirror, glsum::Smlald, glsum::Q15>>();
    expect_line_holds_its_capacity<glsum::Sum<glsum::Modes, glsum::Plain, glsum::F64>>();
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
    EXPECT_EQ(line.prepare({0.5, 1}), Status::ok);
    EXPECT_EQ(line.step(0.25F), 0.25F);
}

}  // namespace
