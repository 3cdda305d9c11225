// Cascades of second-order sections: bit for bit as stated, within their bound of the design's own taps and modes,
// which kernels with modes sum in parallel form; and never beyond their range.
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "bench/sweep/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/modes.hpp"
#include "reference/modes.hpp"
#include "tests/kernels/registered.hpp"

namespace {

using glsum::Design;
using glsum::Mode;
using glsum::Status;

template <class K>
using IsCascade = std::is_same<typename K::HistoryPart, glsum::Cascade>;
using CascadeKernels = test::Filter<IsCascade, test::Kernels>::Types;

template <class K>
class CascadeKernelTest : public testing::Test {};
TYPED_TEST_SUITE(CascadeKernelTest, CascadeKernels, test::KernelNames);

// Fast poles that lie apart, slow ones, a single one; weights of either sign; and one that swings, for floating point.
const std::vector<std::vector<Mode>> falling = {{{0.25, -0.125}},
                                                {{0.01, -0.002}, {0.5, -0.3}},
                                                {{0.001, -1e-4}, {0.03, -0.01}, {0.7, -0.5}},
                                                {{0.0005, 0.01}, {0.006, 0.03}, {0.05, 0.1}, {0.4, 0.2}},
                                                {{0.002, 0.004}, {0.01, 0.01}, {0.05, 0.03}, {0.2, 0.1}, {0.9, 0.05}}};
const std::vector<std::vector<Mode>> swinging = {{{0.01, -0.002}, {1.5, -0.3}}, {{0.3, 0.1}, {1.9, 0.04}}};

Design design_of(double order, std::size_t near_taps, const std::vector<Mode>& modes) {
    return {order, near_taps + 2 * modes.size(), modes};
}

// Its table read back, the recursion as its header states it: one number at a time, in q31 in integers without limit.
template <class K>
class Stated {
    using Number = typename K::Sample;
    static constexpr bool fixed = K::FormatPart::fixed_point;
    using Integer = boost::multiprecision::cpp_int;

    struct Of {
        std::vector<Number> b;  // b0 (q31), b1, b2
        std::vector<Number> a;  // -a1, -a2
        std::vector<Number> inputs{0, 0};
        std::vector<Number> outputs{0, 0};
        Integer dropped = Integer(1) << 28;
        Number first = 0;
        Number second = 0;
    };

public:
    explicit Stated(const typename K::State& state) : near_(state.near_samples), past_(near_, 0), scale_(state.scale) {
        const auto* at = state.table;
        weights_.assign(at, at + near_);
        at += near_;
        for (std::size_t left = state.modes; left > 0;) {
            const bool single = left % 2 != 0;
            Of section;
            const std::size_t b = fixed ? 3 : single ? 1 : 2;
            section.b.assign(at, at + b);
            const std::size_t a = fixed || !single ? 2 : 1;
            section.a.assign(at + b, at + b + a);
            at += b + a;
            left -= single ? 1 : 2;
            sections_.push_back(section);
        }
    }

    typename K::Output step(Number newest) {
        using Format = typename K::FormatPart;
        if (near_ == 0) {
            return through(newest);
        }
        typename Format::Accumulator sum = newest;
        if constexpr (fixed) {
            sum <<= 31 - scale_.table_exponent;
        }
        for (std::size_t i = 0; i < near_; ++i) {
            const Number term = i + 1 < near_ ? past_[i] : through(past_[i]);
            if constexpr (fixed) {
                sum += static_cast<std::int64_t>(weights_[i]) * term;
            } else {
                const volatile Number product = weights_[i] * term;
                sum += product;
            }
        }
        past_.insert(past_.begin(), newest);
        past_.pop_back();
        return Format::finish(sum, scale_);
    }

private:
    Number through(Number value) {
        for (Of& section : sections_) {
            value = through(section, value);
        }
        return value;
    }
    static Number through(Of& section, Number x) {
        if constexpr (fixed) {
            Integer sum = Integer(section.b[0]) * x + section.dropped;
            for (std::size_t i = 0; i < 2; ++i) {
                sum += Integer(section.b[i + 1]) * section.inputs[i] + Integer(section.a[i]) * section.outputs[i];
            }
            // Rounded down; what is left waits.
            const Integer unit = Integer(1) << 29;
            Integer down = sum / unit;
            down -= sum < down * unit ? 1 : 0;
            section.dropped = sum - down * unit;
            section.inputs = {x, section.inputs[0]};
            section.outputs = {down.convert_to<Number>(), section.outputs[0]};
            EXPECT_EQ(Integer(section.outputs[0]), down) << "an output beyond the range";
            return section.outputs[0];
        } else {
            const bool single = section.a.size() == 1;
            const volatile Number y = x + section.first;
            const volatile Number of_x = section.b[0] * x;
            const volatile Number of_y = section.a[0] * y;
            const volatile Number ahead = single ? of_x : section.second + of_x;
            section.first = ahead + of_y;
            if (!single) {
                const volatile Number second_of_x = section.b[1] * x;
                const volatile Number second_of_y = section.a[1] * y;
                section.second = second_of_x + second_of_y;
            }
            return y;
        }
    }

    std::size_t near_;
    std::vector<Number> weights_;
    std::vector<Number> past_;
    std::vector<Of> sections_;
    typename K::FormatPart::Scale scale_;
};

template <class K>
std::vector<std::vector<Mode>> designs() {
    std::vector<std::vector<Mode>> all = falling;
    if (!K::FormatPart::fixed_point) {
        all.insert(all.end(), swinging.begin(), swinging.end());
    }
    return all;
}

TYPED_TEST(CascadeKernelTest, EqualsTheStatedOrderBitForBit) {
    for (const auto& modes : designs<TypeParam>()) {
        for (const std::size_t near_taps : {1U, 2U, 4U}) {
            // Behind other near taps weights of the order's sign: those of v in (0, 1) are below 0 from a_1 on.
            const double order = modes.front().weight < 0.0 ? 0.5 : -0.5;
            test::Line<TypeParam> line(design_of(order, near_taps, modes));
            ASSERT_EQ(line.status(), Status::ok);
            Stated<TypeParam> stated(line.state());
            std::mt19937_64 generator(7);
            for (int k = 0; k < 3000; ++k) {
                auto x = TypeParam::from_real(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
                if (k > 1000) {
                    x = TypeParam::from_real(k % 500 < 250 ? 1.0 : -1.0);  // the ends of the range
                }
                ASSERT_EQ(line.step(x), stated.step(x)) << modes.size() << " modes, " << near_taps << ", k " << k;
            }
        }
    }
}

// Of any number of sections, however the loop over them is unrolled.
TYPED_TEST(CascadeKernelTest, OfManySectionsEqualsTheStatedOrderBitForBit) {
    std::vector<Mode> modes;
    for (std::size_t count = 1; count <= 36; ++count) {
        const double decay = 0.9 * std::pow(0.8, static_cast<double>(count - 1));
        modes.insert(modes.begin(), {decay, -0.02 * decay});  // the slowest comes first
        test::Line<TypeParam> line(design_of(0.5, 1, modes));
        ASSERT_EQ(line.status(), Status::ok) << count;
        Stated<TypeParam> stated(line.state());
        std::mt19937_64 generator(count);
        for (int k = 0; k < 200; ++k) {
            const auto x = TypeParam::from_real(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
            ASSERT_EQ(line.step(x), stated.step(x)) << count << " modes, k " << k;
        }
    }
}

// The worst record for a response h: its signs from the last sample on, so that the last sum is sum |h|.
std::vector<double> worst_record(const Design& design, std::size_t samples) {
    const auto weights = reference::weights_of(design, samples);
    std::vector<double> record(samples);
    for (std::size_t j = 0; j < samples; ++j) {
        record[samples - 1 - j] = weights[j] < 0 ? -1.0 : 1.0 - 0x1p-31;
    }
    return record;
}

TYPED_TEST(CascadeKernelTest, KeepsItsBoundOnEverySignalAndTheWorstRecord) {
    constexpr std::size_t samples = 4000;
    double largest_share = 0.0;
    for (const auto& modes : designs<TypeParam>()) {
        for (const std::size_t near_taps : {1U, 2U, 4U}) {
            const Design design = design_of(modes.front().weight < 0.0 ? 0.5 : -0.5, near_taps, modes);
            test::Line<TypeParam> line(design);
            ASSERT_EQ(line.status(), Status::ok);
            const double bound = glsum::error_bound<TypeParam>(design, line.state(), 1.0);
            std::vector<std::vector<double>> records;
            for (const std::string_view signal : bench::signal_names) {
                records.push_back(bench::make_signal(signal, samples, 1));
            }
            records.push_back(worst_record(design, samples));
            for (const auto& record : records) {
                const auto exact = reference::sums_of(design, record);
                TypeParam::reset(line.state());
                for (std::size_t k = 0; k < samples; ++k) {
                    const double off = std::fabs(exact[k].error_of(line.step_real(record[k])));
                    ASSERT_LE(off, bound) << modes.size() << " modes, " << near_taps << ", k " << k;
                    largest_share = std::max(largest_share, off / bound);
                }
            }
            if constexpr (TypeParam::FormatPart::fixed_point) {
                EXPECT_EQ(line.state().scale.saturations, 0U);
            }
        }
    }
    EXPECT_GE(largest_share, 0.02);
    this->RecordProperty("largest share of the bound", std::to_string(largest_share));
}

// The designs of a sum, as kernels with modes have them; those whose weights have one sign.
TYPED_TEST(CascadeKernelTest, SumsTheDesignsOfAnOrder) {
    constexpr std::size_t samples = 1000;
    for (const double order : {-0.9, -0.5, 0.2, 0.5, 0.9, 0.98319, 1.5, 1.9909}) {
        for (const double error : {1e-2, 1e-4}) {
            const auto found = glsum::design::design_modes({order, samples}, error);
            ASSERT_TRUE(found);
            const Design design{order, found->length(), found->modes};
            test::Line<TypeParam> line(design);
            ASSERT_EQ(line.status(), Status::ok) << order << " " << error;
            const double bound = glsum::error_bound<TypeParam>(design, line.state(), bench::signal_peak);
            const auto record = bench::make_signal("noise", samples, 1);
            const auto exact = reference::sums_of(design, record);
            for (std::size_t k = 0; k < samples; ++k) {
                ASSERT_LE(std::fabs(exact[k].error_of(line.step_real(record[k]))), bound)
                    << order << " " << error << ", k " << k;
            }
        }
    }
}

// H(1) = 1 + sum w/d: the slowest pole of q31 adds up no rounding, and in single precision the bound says how much.
TYPED_TEST(CascadeKernelTest, HoldsALevel) {
    const std::vector<Mode> slow = {{1e-4, -0.5e-4}, {0.5, -0.2}};
    const Design design = design_of(0.5, 1, slow);
    test::Line<TypeParam> line(design);
    ASSERT_EQ(line.status(), Status::ok);
    double last = 0.0;
    for (int k = 0; k < 300'000; ++k) {
        last = line.step_real(0.75);
    }
    const double off = std::fabs(last - 0.75 * (1.0 - 0.5 - 0.4));
    EXPECT_LE(off, glsum::error_bound<TypeParam>(design, line.state(), 0.75));
    EXPECT_LE(off, TypeParam::FormatPart::fixed_point ? 2e-5 : 3e-3);
}

TYPED_TEST(CascadeKernelTest, WithoutModesItIsTheWindowOfItsTaps) {
    using Format = typename TypeParam::FormatPart;
    using History = std::conditional_t<Format::fixed_point, glsum::Ring, glsum::Shift>;
    for (const double order : {0.5, 1.9909, -1.5}) {
        for (const std::size_t taps : {1U, 2U, 3U, 40U}) {
            test::Line<TypeParam> line({order, taps});
            test::Line<glsum::Sum<History, glsum::Plain, Format>> window({order, taps});
            std::mt19937_64 generator(taps);
            for (std::size_t k = 0; k < 3 * taps; ++k) {
                const auto x = TypeParam::from_real(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
                ASSERT_EQ(line.step(x), window.step(x)) << order << " " << taps << " " << k;
            }
        }
    }
}

TYPED_TEST(CascadeKernelTest, RefusesWhatHasNoRealSectionsAndBuffersThatAreTooSmall) {
    std::vector<typename TypeParam::Coefficient> table(TypeParam::table_count(9));
    std::vector<typename TypeParam::Sample> past(TypeParam::past_count(9));
    typename TypeParam::State state{};
    constexpr bool fixed = TypeParam::FormatPart::fixed_point;
    const auto prepare = [&](const std::vector<Mode>& modes, std::size_t taps = 9) {
        return TypeParam::prepare(state, {0.5, taps, modes}, table, past);
    };
    const std::vector<Mode> three = {{0.125, -0.1}, {0.25, -0.1}, {1.0, -0.1}};
    EXPECT_EQ(prepare(three), Status::ok);
    EXPECT_EQ(prepare(three, 7), Status::ok);
    EXPECT_EQ(prepare(three, 6), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.0, -0.1}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{-0.5, -0.1}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{1.5, -0.1}}), fixed ? Status::modes_out_of_range : Status::ok);
    EXPECT_EQ(prepare({{1.005, -0.1}}), fixed ? Status::modes_out_of_range : Status::ok);
    EXPECT_EQ(prepare({{2.0, -0.1}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{2.005, -0.1}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{std::nan(""), -0.1}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.5, std::nan("")}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.5, -INFINITY}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.5, 0.0}}), Status::modes_out_of_range);
    EXPECT_EQ(prepare({{0.1, -0.1}, {0.5, 0.1}}), Status::modes_out_of_range) << "weights of both signs";
    EXPECT_EQ(prepare({{0.1, -0.1}, {0.5, 0.0}}), Status::modes_out_of_range) << "no weight behind a negative one";
    EXPECT_EQ(prepare({{0.1, 0.1}, {0.5, 0.0}}), Status::modes_out_of_range) << "no weight behind a positive one";
    EXPECT_EQ(prepare({{0.5, -0.1}, {0.1, -0.1}}), Status::modes_out_of_range) << "the slowest comes first";
    EXPECT_EQ(prepare({{0.5, -0.1}, {0.5, -0.1}}), Status::modes_out_of_range) << "twice the same pole";
    // Two slow poles so near that rounding makes one of them, or a complex pair.
    EXPECT_EQ(prepare({{1e-6, -1e-7}, {1.000001e-6, -1e-7}}), Status::format_too_narrow);
    EXPECT_EQ(prepare({{1e-12, -1e-13}}), Status::format_too_narrow) << "a pole that rounds to 1";
    EXPECT_EQ(prepare({{1e-9, 1.0}}), Status::format_too_narrow) << "an integral of 10^9";
    // What one design needs is enough for it, and a word less is not.
    for (const std::size_t modes : {1U, 2U, 3U}) {
        const Design design{0.5, 9, std::span(three).first(modes)};
        const std::size_t table_words = glsum::table_needed<TypeParam>(design);
        const std::size_t past_words = glsum::past_needed<TypeParam>(design);
        ASSERT_LE(table_words, table.size());
        ASSERT_LE(past_words, past.size());
        const auto with = [&](std::size_t less_table, std::size_t less_past) {
            return TypeParam::prepare(state, design, std::span(table).first(table_words - less_table),
                                      std::span(past).first(past_words - less_past));
        };
        EXPECT_EQ(with(0, 0), Status::ok);
        EXPECT_EQ(with(1, 0), Status::table_too_small);
        EXPECT_EQ(with(0, 1), Status::past_too_small);
    }
}

TYPED_TEST(CascadeKernelTest, ResetForgetsTheSectionsToo) {
    test::Line<TypeParam> line(design_of(-0.5, 1, falling[3]));
    std::vector<typename TypeParam::Output> first;
    for (int round = 0; round < 2; ++round) {
        for (std::size_t k = 0; k < 400; ++k) {
            const auto output = line.step(TypeParam::from_real(k % 3 == 0 ? 0.625 : 0.1));
            if (round == 0) {
                first.push_back(output);
            } else {
                ASSERT_EQ(output, first[k]) << k;
            }
        }
        TypeParam::reset(line.state());
    }
}

// Zeros and poles of the product give the sum's response: at every frequency, and at rest.
TEST(Series, IsTheSameFilterAsTheSum) {
    for (const auto& sets : {falling, swinging}) {
        for (const auto& modes : sets) {
            const double lead = modes.front().weight < 0.0 ? 1.0 : -0.25;  // zeros on either side of their poles
            const glsum::Series series(modes, lead);
            ASSERT_TRUE(series.interlaces());
            for (const double angle : {0.0, 1e-4, 0.01, 0.5, 2.0, std::numbers::pi}) {
                const std::complex<double> q = std::polar(1.0, -angle);
                std::complex<double> sum = lead;
                std::complex<double> product = lead;
                for (std::size_t m = 0; m < modes.size(); ++m) {
                    const std::complex<double> below = 1.0 - (1.0 - modes[m].decay) * q;
                    sum += modes[m].weight * q / below;
                    product *= (1.0 - (1.0 - series.zero(m)) * q) / below;
                }
                EXPECT_LE(std::abs(sum - product), 1e-12 * std::abs(sum) + 1e-13) << modes.size() << " " << angle;
            }
        }
    }
}

}  // namespace
