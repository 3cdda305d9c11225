// Kernels with blocks: bit for bit as stated, within their bound of the design's own weights, and of full memory within
// the design's error beside it.
#include <cmath>
#include <random>

#include "bench/sweep/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/blocks.hpp"
#include "reference/blocks.hpp"
#include "tests/kernels/registered.hpp"

namespace {

using glsum::Blocks;
using glsum::Design;

template <class K>
using HasBlocks = std::bool_constant<glsum::keeps_blocks<typename K::HistoryPart>>;
using NestedKernels = test::Filter<HasBlocks, test::Kernels>::Types;

template <class K>
class NestedKernelTest : public testing::Test {};
TYPED_TEST_SUITE(NestedKernelTest, NestedKernels, test::KernelNames);

Design design_of(double order, std::size_t near_taps, const Blocks& blocks, std::span<const double> weights = {}) {
    return {order, near_taps + blocks.count, {}, weights, blocks};
}

// One of every kind: none or one near tap, part of a level or whole ones, more a level than there are.
const std::vector<std::pair<std::size_t, Blocks>> layouts = {{1, {1, 1}}, {1, {2, 1}}, {2, {5, 1}}, {4, {7, 1}},
                                                             {1, {6, 2}}, {3, {7, 2}}, {2, {3, 3}}, {9, {8, 3}},
                                                             {5, {4, 9}}, {3, {0, 1}}, {1, {0, 1}}};

double noise(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0; }

// The kernel as its header states it, from all samples of the record: every block's sum by halves.
template <class K>
class Stated {
    using Format = typename K::FormatPart;
    using Number = typename Format::Sample;
    static constexpr bool fixed = Format::fixed_point;

public:
    Stated(const Design& design, const typename Format::Scale& scale)
        : scale_(scale), near_taps_(design.taps - design.blocks.count), blocks_(design.blocks) {
        glsum::Weights walk(design.order);
        while (weights_.size() < design.taps - 1) {
            reference::Real sum = 0;  // exact, but for what the weights of the lags are rounded to
            const std::size_t width = width_of(weights_.size());
            for (std::size_t i = 0; i < width; ++i) {
                walk.next();
                sum += walk.weight();
            }
            if constexpr (fixed) {
                weights_.push_back(static_cast<Number>(
                    std::llround(std::ldexp(static_cast<double>(sum), 31 - scale_.table_exponent))));
            } else {
                weights_.push_back(static_cast<Number>(static_cast<double>(sum / width)));
            }
        }
    }

    typename K::Output step(Number newest) {
        record_.push_back(newest);
        typename Format::Accumulator sum = newest;
        if constexpr (fixed) {
            sum <<= 31 - scale_.table_exponent;
        }
        std::size_t lag = 1;
        for (std::size_t t = 0; t < weights_.size(); ++t) {
            const std::size_t width = width_of(t);
            add(sum, weights_[t], block(lag, width));
            lag += width;
        }
        return Format::finish(sum, scale_);
    }

private:
    /// Samples that term t, behind x_k, stands for.
    [[nodiscard]] std::size_t width_of(std::size_t t) const {
        return t < near_taps_ - 1 ? 1 : std::size_t{2} << (t - (near_taps_ - 1)) / blocks_.per_level;
    }
    Number block(std::size_t lag, std::size_t width) const {
        if (width == 1) {
            return lag < record_.size() ? record_[record_.size() - 1 - lag] : Number(0);
        }
        const Number younger = block(lag, width / 2);
        const Number older = block(lag + width / 2, width / 2);
        if constexpr (fixed) {
            return static_cast<Number>((std::int64_t{younger} + older + 1) >> 1);
        } else {
            return younger + older;
        }
    }
    static void add(typename Format::Accumulator& sum, Number a, Number x) {
        if constexpr (fixed) {
            sum += static_cast<std::int64_t>(a) * x;
        } else {
            const volatile Number product = a * x;
            sum += product;
        }
    }

    typename Format::Scale scale_;
    std::size_t near_taps_;
    Blocks blocks_;
    std::vector<Number> weights_;
    std::vector<Number> record_;
};

TYPED_TEST(NestedKernelTest, EqualsTheStatedOrderBitForBit) {
    for (const double order : {0.5, 1.9909, -0.5}) {
        for (const auto& [near_taps, blocks] : layouts) {
            const Design design = design_of(order, near_taps, blocks);
            test::Line<TypeParam> line(design);
            ASSERT_EQ(line.status(), glsum::Status::ok);
            Stated<TypeParam> stated(design, line.state().scale);
            std::mt19937_64 generator(7);
            const std::size_t samples = 3 * glsum::reach_of(design) + 10;
            for (std::size_t k = 0; k < samples; ++k) {
                auto x = TypeParam::from_real(noise(generator));
                if (2 * k > samples) {
                    x = TypeParam::from_real(k % 50 < 25 ? 1.0 : -1.0);  // the ends of the range
                }
                ASSERT_EQ(line.step(x), stated.step(x))
                    << order << ", " << near_taps << "+" << blocks.count << " by " << blocks.per_level << ", k " << k;
            }
        }
    }
}

TYPED_TEST(NestedKernelTest, KeepsItsBoundOnEverySignalOrderAndDesign) {
    constexpr std::size_t samples = 1000;
    double largest_share = 0.0;
    for (const double order : {-1.5, -0.5, 0.2, 0.5, 0.98319, 1.0, 1.5, 1.9909}) {
        for (const std::size_t taps : {8U, 16U, 24U, 100U}) {
            const auto found = glsum::design::design_blocks({order, samples}, taps);
            const Design design = design_of(order, found.near_taps, found.blocks);
            for (const std::string_view signal : bench::signal_names) {
                const auto record = bench::make_signal(signal, samples, 1);
                const auto exact = reference::sums_of(design, record);
                test::Line<TypeParam> line(design);
                ASSERT_EQ(line.status(), glsum::Status::ok);
                const double bound = glsum::error_bound<TypeParam>(design, line.state(), bench::signal_peak);
                for (std::size_t k = 0; k < samples; ++k) {
                    const double off = std::fabs(exact[k].error_of(line.step_real(record[k])));
                    ASSERT_LE(off, bound) << "order " << order << ", taps " << taps << ", " << signal << ", k " << k;
                    largest_share = std::max(largest_share, off / bound);
                }
            }
        }
    }
    EXPECT_GE(largest_share, 0.02);
    this->RecordProperty("largest share of the bound", std::to_string(largest_share));
}

// What the bound counts for the levels alone, the means' halves in fixed point and the additions in floating point: a
// record whose every half rounds up, or whose sums lose what they can.
TYPED_TEST(NestedKernelTest, ItsBoundHasRoomForTheBlocksOwnRounding) {
    using Format = typename TypeParam::FormatPart;
    const Design design = design_of(-0.5, 2, {9, 1});
    test::Line<TypeParam> line(design);
    ASSERT_EQ(line.status(), glsum::Status::ok);
    const double bound = glsum::error_bound<TypeParam>(design, line.state(), 0.9);
    std::vector<double> record(2 * glsum::reach_of(design));
    std::mt19937_64 generator(5);
    for (std::size_t k = 0; k < record.size(); ++k) {
        record[k] = !Format::fixed_point ? 0.8 + 0.1 * noise(generator) : k % 2 == 0 ? 0.25 : 0.25 + 0x1p-31;
    }
    const auto exact = reference::sums_of(design, record);
    double largest = 0.0;
    for (std::size_t k = 0; k < record.size(); ++k) {
        largest = std::max(largest, std::fabs(exact[k].error_of(line.step_real(record[k]))));
    }
    EXPECT_LE(largest, bound);
    EXPECT_GE(largest, 0.01 * bound);
}

// The worst record there is, the signs of what the design misses, reaches its error; none goes beyond.
TYPED_TEST(NestedKernelTest, IsAsFarFromFullMemoryAsTheDesignSays) {
    constexpr std::size_t samples = 800;
    for (const double order : {-0.5, 0.5, 0.9, 1.5}) {
        for (const std::size_t taps : {6U, 12U, 30U}) {
            const auto found = glsum::design::design_blocks({order, samples - 1}, taps);
            const Design design = design_of(order, found.near_taps, found.blocks);
            const auto full = reference::weights(reference::Real(order), samples);
            const auto kept = reference::weights_of(design, samples);
            std::vector<double> record(samples);
            for (std::size_t j = 0; j < samples; ++j) {
                record[samples - 1 - j] = full[j] > kept[j] ? 0.875 : -0.875;
            }
            test::Line<TypeParam> line(design);
            double last = 0.0;
            for (const double x : record) {
                last = line.step_real(x);
            }
            const std::size_t whole[] = {samples};
            const double off = std::fabs(reference::sums(full, record, whole).front().back().error_of(last));
            const double bound = glsum::error_bound<TypeParam>(design, line.state(), 0.875);
            EXPECT_LE(off, 0.875 * found.error * (1 + 1e-9) + bound) << order << " " << taps;
            EXPECT_GE(off, 0.875 * found.error * (1 - 1e-9) - bound) << order << " " << taps;
        }
    }
}

// In numbers that every format holds, and of weights that no order has: each block answers with the mean of its own.
TYPED_TEST(NestedKernelTest, AnswersAnImpulseWithItsWeights) {
    const std::vector<double> named = {-0.5, 0.25, 0.125, -0.125, 0.5, 0.0, -0.25, 0.25, 0.125, 0.0};
    test::Line<TypeParam> line(design_of(0.5, 3, {3, 2}, named));
    ASSERT_EQ(line.status(), glsum::Status::ok);
    const double expected[] = {1.0, -0.5, 0.25, 0.0, 0.0, 0.25, 0.25, 0.03125, 0.03125, 0.03125, 0.03125, 0.0, 0.0};
    for (const double& weight : expected) {
        EXPECT_EQ(line.step_real(&weight == expected ? 0.5 : 0.0), 0.5 * weight);
    }
    // A lag too few of them is refused.
    const auto few = std::span(named).first(9);
    EXPECT_EQ(test::Line<TypeParam>(design_of(0.5, 3, {3, 2}, few)).status(), glsum::Status::weights_out_of_range);
}

// No drift: what has passed leaves no trace, however large it was.
TYPED_TEST(NestedKernelTest, ForgetsWhollyWhatLiesBehindItsReach) {
    const Design design = design_of(0.5, 4, {6, 1});
    test::Line<TypeParam> line(design);
    test::Line<TypeParam> fresh(design);
    std::mt19937_64 generator(11);
    for (int k = 0; k < 5000; ++k) {
        line.step_real(noise(generator));
    }
    for (std::size_t k = 0; k < 3 * glsum::reach_of(design); ++k) {
        const double x = 1e-3 * noise(generator);
        const double one = line.step_real(x);
        const double other = fresh.step_real(x);
        if (k + 1 >= glsum::reach_of(design)) {
            ASSERT_EQ(one, other) << k;
        }
    }
}

TYPED_TEST(NestedKernelTest, RefusesWhatLeavesNoTapAndBuffersThatAreTooSmall) {
    std::vector<typename TypeParam::Coefficient> table(20);
    std::vector<typename TypeParam::Sample> past(100);
    typename TypeParam::State state{};
    const auto prepare = [&](std::size_t taps, const Blocks& blocks) {
        return TypeParam::prepare(state, {0.5, taps, {}, {}, blocks}, table, past);
    };
    EXPECT_EQ(prepare(6, {5, 1}), glsum::Status::ok);
    EXPECT_EQ(prepare(5, {5, 1}), glsum::Status::blocks_out_of_range);
    EXPECT_EQ(prepare(4, {5, 1}), glsum::Status::blocks_out_of_range);
    EXPECT_EQ(prepare(6, {5, 0}), glsum::Status::blocks_out_of_range);
    EXPECT_EQ(prepare(29, {28, 1}), glsum::Status::blocks_out_of_range);  // 2^29 samples
    EXPECT_EQ(prepare(100, {99, 1}), glsum::Status::blocks_out_of_range);
    EXPECT_EQ(prepare(7, {6, 1}), glsum::Status::past_too_small);
    // What one design needs is enough for it, a window's memory, and a word less is not.
    const Design design = design_of(0.5, 3, {5, 2});
    ASSERT_EQ(glsum::reach_of(design), 3 + 2 * 2 + 2 * 4 + 8U);
    EXPECT_EQ(glsum::table_needed<TypeParam>(design), 7U);
    EXPECT_EQ(glsum::past_needed<TypeParam>(design), 22U);
    const auto with = [&](std::size_t table_words, std::size_t past_words) {
        return TypeParam::prepare(state, design, std::span(table).first(table_words),
                                  std::span(past).first(past_words));
    };
    EXPECT_EQ(with(7, 22), glsum::Status::ok);
    EXPECT_EQ(with(6, 22), glsum::Status::table_too_small);
    EXPECT_EQ(with(7, 21), glsum::Status::past_too_small);
}

TYPED_TEST(NestedKernelTest, StaysInsideItsRingAndForgetsAtReset) {
    for (const auto& [near_taps, blocks] : layouts) {
        const Design design = design_of(0.5, near_taps, blocks);
        const std::size_t words = glsum::past_needed<TypeParam>(design);
        std::vector<typename TypeParam::Coefficient> table(glsum::table_needed<TypeParam>(design) + 1);
        std::vector<typename TypeParam::Sample> past(words + 16, 77);
        typename TypeParam::State state{};
        ASSERT_EQ(TypeParam::prepare(state, design, table, std::span(past).subspan(8, words)), glsum::Status::ok);
        std::vector<typename TypeParam::Output> first;
        for (int round = 0; round < 2; ++round) {
            std::mt19937_64 generator(3);
            for (std::size_t k = 0; k < 3 * words + 5; ++k) {
                const auto output = TypeParam::step(state, TypeParam::from_real(noise(generator)));
                if (round == 0) {
                    first.push_back(output);
                } else {
                    ASSERT_EQ(output, first[k]) << k;
                }
            }
            TypeParam::reset(state);
        }
        for (std::size_t i = 0; i < 8; ++i) {
            EXPECT_EQ(past[i], 77);
            EXPECT_EQ(past[past.size() - 1 - i], 77);
        }
    }
}

}  // namespace
