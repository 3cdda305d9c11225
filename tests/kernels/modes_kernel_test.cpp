// Kernels with modes: bit for bit as stated, within their bound of the design's own weights, and of full memory within
// the design's certificate beside it.
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

#include "bench/sweep/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/modes.hpp"
#include "reference/modes.hpp"
#include "tests/kernels/registered.hpp"

namespace {

using glsum::Design;
using glsum::Mode;
using glsum::design::Approximation;

template <class K>
using HasModes = std::is_same<typename K::HistoryPart, glsum::Modes>;
using ModesKernels = test::Filter<HasModes, test::Kernels>::Types;

template <class K>
class ModesKernelTest : public testing::Test {};
TYPED_TEST_SUITE(ModesKernelTest, ModesKernels, test::KernelNames);

Design design_of(double order, const Approximation& found) { return {order, found.length(), found.modes}; }

// The kernel as its header states it, one number at a time, the modes as they are designed: the slowest first.
template <class K>
class Stated {
    using Format = typename K::FormatPart;
    using Number = typename Format::Sample;
    static constexpr bool fixed = Format::fixed_point;

    struct Average {
        Number decay = 0;  // q31: its mantissa
        int shift = 0;
        Number gain = 0;
        Number value = 0;
        Number lost = 0;
    };

public:
    Stated(const Design& design, const typename Format::Scale& scale) : scale_(scale) {
        const std::size_t near_taps = design.taps - 2 * design.modes.size();
        const auto exact = reference::weights(reference::Real(design.order), near_taps);
        for (std::size_t j = 1; j < near_taps; ++j) {
            weights_.push_back(coefficient(static_cast<double>(exact[j])));
        }
        past_.assign(near_taps - 1, Number(0));
        for (const Mode& mode : design.modes) {
            Average average;
            if constexpr (fixed) {
                // The mantissa in [2^29, 2^30].
                average.shift = 29 - std::ilogb(mode.decay);
                average.decay = static_cast<Number>(std::llround(std::ldexp(mode.decay, average.shift)));
            } else {
                average.decay = static_cast<Number>(mode.decay);
            }
            average.gain = coefficient(mode.weight / mode.decay);
            averages_.push_back(average);
        }
    }

    typename K::Output step(Number newest) {
        Number leaving = newest;
        typename Format::Accumulator sum = newest;
        if constexpr (fixed) {
            sum <<= 31 - scale_.table_exponent;
        }
        for (std::size_t i = 0; i < past_.size(); ++i) {
            add(sum, weights_[i], past_[i]);
            leaving = past_[i];
        }
        for (auto average = averages_.rbegin(); average != averages_.rend(); ++average) {
            add(sum, average->gain, average->value);
            update(*average, leaving);
        }
        past_.insert(past_.begin(), newest);
        past_.pop_back();
        return Format::finish(sum, scale_);
    }

private:
    Number coefficient(double real) const {
        if constexpr (fixed) {
            return static_cast<Number>(std::llround(std::ldexp(real, 31 - scale_.table_exponent)));
        } else {
            return static_cast<Number>(real);
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
    static void update(Average& average, Number leaving) {
        if constexpr (fixed) {
            // Rounded to nearest, halves up, in integers without limit.
            using Integer = boost::multiprecision::cpp_int;
            const Integer unit = Integer(1) << average.shift;
            const Integer doubled = 2 * Integer(average.decay) * (Integer(leaving) - Integer(average.value)) + unit;
            Integer quotient = doubled / (2 * unit);
            quotient -= doubled < 0 && doubled % (2 * unit) != 0 ? 1 : 0;
            average.value = Integer(Integer(average.value) + quotient).convert_to<Number>();
        } else {
            const volatile Number difference = leaving - average.value;
            const volatile Number product = average.decay * difference;
            if constexpr (K::compensated) {
                const volatile Number step = product + average.lost;
                const volatile Number after = average.value + step;
                const volatile Number taken = after - average.value;
                average.lost = step - taken;
                average.value = after;
            } else {
                average.value = average.value + product;
            }
        }
    }

    typename Format::Scale scale_;
    std::vector<Number> weights_;
    std::vector<Number> past_;
    std::vector<Average> averages_;
};

TYPED_TEST(ModesKernelTest, EqualsTheStatedOrderBitForBit) {
    for (const double order : {0.2, 0.5, 0.98319, 1.9909, -0.5}) {
        for (const double error : {1e-2, 1e-4, 1e-6}) {
            const auto found = glsum::design::design_modes({order, 1000}, error);
            ASSERT_TRUE(found);
            const Design design = design_of(order, *found);
            test::Line<TypeParam> line(design);
            ASSERT_EQ(line.status(), glsum::Status::ok);
            Stated<TypeParam> stated(design, line.state().scale);
            std::mt19937_64 generator(7);
            for (int k = 0; k < 3000; ++k) {
                auto x = TypeParam::from_real(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
                if (k > 2000) {
                    x = TypeParam::from_real(k % 500 < 250 ? 1.0 : -1.0);  // the ends of the range
                }
                ASSERT_EQ(line.step(x), stated.step(x)) << "order " << order << ", error " << error << ", k " << k;
            }
        }
    }
}

TYPED_TEST(ModesKernelTest, KeepsItsBoundOnEverySignalOrderAndDesign) {
    constexpr std::size_t samples = 1000;
    double largest_share = 0.0;
    for (const double order : {-0.9, -0.5, 0.2, 0.5, 0.9, 0.98319, 1.5, 1.9909}) {
        for (const double error : {1e-2, 1e-5, 1e-8}) {
            const auto found = glsum::design::design_modes({order, samples}, error);
            ASSERT_TRUE(found) << order << " " << error;
            const Design design = design_of(order, *found);
            for (const std::string_view signal : bench::signal_names) {
                const auto record = bench::make_signal(signal, samples, 1);
                const auto exact = reference::sums_of(design, record);
                test::Line<TypeParam> line(design);
                ASSERT_EQ(line.status(), glsum::Status::ok);
                const double bound = glsum::error_bound<TypeParam>(design, line.state(), bench::signal_peak);
                for (std::size_t k = 0; k < samples; ++k) {
                    const double off = std::fabs(exact[k].error_of(line.step_real(record[k])));
                    ASSERT_LE(off, bound) << "order " << order << ", error " << error << ", " << signal << ", k " << k;
                    largest_share = std::max(largest_share, off / bound);
                }
            }
        }
    }
    EXPECT_GE(largest_share, 0.02);
    this->RecordProperty("largest share of the bound", std::to_string(largest_share));
}

// Modes whose weights change their sign from lag to lag, as fits to a derivative have one: floating point's alone.
const std::vector<std::vector<Mode>> swinging = {
    {{0.01, 0.002}, {1.5, -0.3}}, {{0.3, -0.1}, {1.9, 0.4}}, {{1.97, -0.02}}};

TYPED_TEST(ModesKernelTest, ASwingingModeKeepsItsOrderAndItsBound) {
    if constexpr (!TypeParam::FormatPart::fixed_point) {
        constexpr std::size_t samples = 1000;
        for (const std::vector<Mode>& modes : swinging) {
            const Design design{0.5, 1 + 2 * modes.size(), modes};
            double largest_share = 0.0;
            // The worst record alternates, and the average reaches d/(2-d) of its peak.
            std::vector<std::vector<double>> records = {bench::make_signal("noise", samples, 1)};
            records.emplace_back();
            for (std::size_t k = 0; k < samples; ++k) {
                records.back().push_back(k % 2 == 0 ? 0.7 : -0.7);
            }
            for (const std::vector<double>& record : records) {
                test::Line<TypeParam> line(design);
                ASSERT_EQ(line.status(), glsum::Status::ok);
                Stated<TypeParam> stated(design, line.state().scale);
                const auto exact = reference::sums_of(design, record);
                const double bound = glsum::error_bound<TypeParam>(design, line.state(), bench::signal_peak);
                for (std::size_t k = 0; k < samples; ++k) {
                    const auto x = TypeParam::from_real(record[k]);
                    const auto found = line.step(x);
                    ASSERT_EQ(found, stated.step(x)) << modes.back().decay << " " << k;
                    const double off = std::fabs(exact[k].error_of(TypeParam::to_real(line.state(), found)));
                    ASSERT_LE(off, bound) << modes.back().decay << " " << k;
                    largest_share = std::max(largest_share, off / bound);
                }
            }
            EXPECT_GE(largest_share, 1e-3) << modes.back().decay;
        }
    }
}

// The worst record there is, the signs of what the design misses, reaches the certificate; none goes beyond.
TYPED_TEST(ModesKernelTest, IsAsFarFromFullMemoryAsTheCertificateSays) {
    constexpr std::size_t samples = 800;
    for (const double order : {-0.5, 0.5, 0.9, 1.5}) {
        for (const double error : {1e-1, 1e-3}) {
            const auto found = glsum::design::design_modes({order, samples - 1}, error);
            ASSERT_TRUE(found);
            const Design design = design_of(order, *found);
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
            EXPECT_LE(off, 0.875 * found->error * (1 + 1e-9) + bound) << order << " " << error;
            EXPECT_GE(off, 0.875 * found->error * (1 - 1e-9) - bound) << order << " " << error;
        }
    }
}

// In numbers that every format holds: order 2 has the weights 1, -2, 1; two modes in halves and quarters.
TYPED_TEST(ModesKernelTest, AnswersAnImpulseWithItsWeights) {
    const std::vector<Mode> modes = {{0.25, 0.125}, {0.5, -0.25}};
    for (const std::size_t near_taps : {1U, 2U, 3U, 6U}) {
        test::Line<TypeParam> line({2.0, near_taps + 4, modes});
        ASSERT_EQ(line.status(), glsum::Status::ok);
        const double second[] = {1.0, -2.0, 1.0, 0.0, 0.0, 0.0};
        for (std::size_t j = 0; j < near_taps + 8; ++j) {
            const double past = static_cast<double>(j) - static_cast<double>(near_taps);
            const double expected =
                j < near_taps ? second[j] : 0.125 * std::pow(0.75, past) - 0.25 * std::pow(0.5, past);
            EXPECT_EQ(line.step_real(j == 0 ? -0.5 : 0.0), -0.5 * expected) << near_taps << " " << j;
        }
    }
}

TYPED_TEST(ModesKernelTest, WithoutModesItIsTheWindowOfItsTaps) {
    using Format = typename TypeParam::FormatPart;
    using History = std::conditional_t<Format::fixed_point, glsum::Ring, glsum::Shift>;
    using Window = glsum::Sum<History, glsum::Plain, Format>;
    for (const double order : {0.5, 1.9909, -1.5}) {
        for (const std::size_t taps : {1U, 2U, 3U, 40U}) {
            test::Line<TypeParam> line({order, taps});
            test::Line<Window> window({order, taps});
            std::mt19937_64 generator(taps);
            for (std::size_t k = 0; k < 3 * taps; ++k) {
                const auto x = TypeParam::from_real(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
                ASSERT_EQ(line.step(x), window.step(x)) << order << " " << taps << " " << k;
            }
        }
    }
}

TYPED_TEST(ModesKernelTest, RefusesModesThatDoNotDecayAndBuffersThatAreTooSmall) {
    std::vector<typename TypeParam::Coefficient> table(TypeParam::table_count(9));
    std::vector<typename TypeParam::Sample> past(TypeParam::past_count(9));
    typename TypeParam::State state{};
    const auto prepare = [&](const std::vector<Mode>& modes, std::size_t taps = 9) {
        return TypeParam::prepare(state, {0.5, taps, modes}, table, past);
    };
    const std::vector<Mode> three = {{0.125, -0.1}, {0.25, -0.1}, {1.0, -0.1}};
    EXPECT_EQ(prepare(three), glsum::Status::ok);
    EXPECT_EQ(prepare(three, 7), glsum::Status::ok);
    EXPECT_EQ(prepare(three, 6), glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.0, -0.1}}), glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{-0.5, -0.1}}), glsum::Status::modes_out_of_range);
    constexpr bool may_swing = !TypeParam::FormatPart::fixed_point;
    EXPECT_EQ(prepare({{1.5, -0.1}}), may_swing ? glsum::Status::ok : glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{1.005, -0.1}}), may_swing ? glsum::Status::ok : glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{2.0, -0.1}}), glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{2.005, -0.1}}), glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{std::nan(""), -0.1}}), glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.5, std::nan("")}}), glsum::Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.5, INFINITY}}), glsum::Status::modes_out_of_range);
    if constexpr (!std::is_same_v<typename TypeParam::Coefficient, double>) {
        EXPECT_EQ(prepare({{1e-50, -1e-50}}), glsum::Status::format_too_narrow);
        EXPECT_EQ(prepare({{1e-10, -1e30}}), glsum::Status::format_too_narrow);
        EXPECT_EQ(prepare({{2.0 - 1e-12, -0.1}}),
                  may_swing ? glsum::Status::format_too_narrow : glsum::Status::modes_out_of_range);
    }
    // What one design needs is enough for it, and a word less is not.
    const Design design{0.5, 9, three};
    const std::size_t table_words = glsum::table_needed<TypeParam>(design);
    const std::size_t past_words = glsum::past_needed<TypeParam>(design);
    ASSERT_LE(table_words, table.size());
    ASSERT_LE(past_words, past.size());
    EXPECT_EQ(past_words, 2 + 3 * TypeParam::words_of_mode);
    const auto with = [&](std::size_t less_table, std::size_t less_past) {
        return TypeParam::prepare(state, design, std::span(table).first(table_words - less_table),
                                  std::span(past).first(past_words - less_past));
    };
    EXPECT_EQ(with(0, 0), glsum::Status::ok);
    EXPECT_EQ(with(1, 0), glsum::Status::table_too_small);
    EXPECT_EQ(with(0, 1), glsum::Status::past_too_small);
}

TYPED_TEST(ModesKernelTest, ResetForgetsTheAveragesToo) {
    const auto found = glsum::design::design_modes({-0.5, 5000}, 1e-3);
    test::Line<TypeParam> line(design_of(-0.5, *found));
    std::vector<typename TypeParam::Output> first;
    for (int round = 0; round < 2; ++round) {
        for (std::size_t k = 0; k < 400; ++k) {
            const auto output = line.step(TypeParam::from_real(0.625));
            if (round == 0) {
                first.push_back(output);
            } else {
                ASSERT_EQ(output, first[k]) << k;
            }
        }
        TypeParam::reset(line.state());
    }
}

// A slow mode under a constant: without the carry word it stops where a step is half a unit of its state, 2^-25/d short
// of the constant, which the bound allows for; with it, it arrives.
TEST(Modes, TheCarryWordKeepsSlowAveragesMoving) {
    const std::vector<Mode> slow = {{1e-5, 1e-5}};
    const auto miss = [&]<class K>(test::Line<K> line) {
        double last = 0.0;
        for (int k = 0; k < 3'000'000; ++k) {
            last = line.step_real(0.75);
        }
        const double missed = std::fabs(1.5 - last);
        EXPECT_LE(missed, glsum::error_bound<K>({0.5, 3, slow}, line.state(), 0.75)) << K::name();
        return missed;
    };
    EXPECT_GT(miss(test::Line<glsum::Sum<glsum::Modes, glsum::Plain, glsum::F32>>({0.5, 3, slow})), 1e-3);
    EXPECT_LT(miss(test::Line<glsum::Sum<glsum::Modes, glsum::Compensated, glsum::F32>>({0.5, 3, slow})), 5e-7);
    EXPECT_LT(miss(test::Line<glsum::Sum<glsum::Modes, glsum::Plain, glsum::F64>>({0.5, 3, slow})), 1e-11);
}

}  // namespace
