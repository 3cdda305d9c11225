// Kernels that do not take what leaves their window as 0: increments, and guesses of the dropped tail. Bit for bit as
// stated, exact where they promise it, within their bound over a million samples.
#include <cmath>
#include <random>

#include "bench/sweep/signals.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/modes.hpp"
#include "reference/dropped.hpp"
#include "tests/kernels/registered.hpp"

namespace {

using glsum::Design;
using reference::Dropped;
using reference::Real;
using test::Line;

std::vector<double> noise(std::size_t samples, double peak = 0.9) {
    std::mt19937_64 generator(samples);
    std::vector<double> x(samples);
    for (double& sample : x) {
        sample = peak * (static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
    }
    return x;
}

reference::Sums full_sums(double order, std::span<const double> record) {
    const std::size_t full[] = {record.size()};
    return reference::sums(reference::weights(Real(order), record.size()), record, full).front();
}

// The farthest that a kernel of these taps gets from sums.
template <class K>
double farthest(const Design& design, std::span<const double> record, const reference::Sums& exact) {
    Line<K> line(design);
    EXPECT_EQ(line.status(), glsum::Status::ok);
    double largest = 0.0;
    for (std::size_t k = 0; k < record.size(); ++k) {
        largest = std::max(largest, std::fabs(exact[k].error_of(line.step_real(record[k]))));
    }
    return largest;
}

template <class K>
double bound_of(const Design& design, std::size_t samples, double peak = 0.9) {
    return glsum::error_bound<K>(design, Line<K>(design).state(), peak, samples);
}

// The registered kernel that gives the bits of a mirrored window: plain and oldest sum in one accumulator, wherever the
// samples lie.
template <class K>
using Window = glsum::Sum<std::conditional_t<K::TechniquePart::word == "plain" || K::TechniquePart::word == "oldest",
                                             glsum::Ring, glsum::Mirror>,
                          typename K::TechniquePart, typename K::FormatPart>;

// --- increments

template <class K>
using IsDelta = std::bool_constant<glsum::keeps_increments<typename K::HistoryPart>>;
using DeltaKernels = test::Filter<IsDelta, test::Kernels>::Types;

template <class K>
class DeltaTest : public testing::Test {};
TYPED_TEST_SUITE(DeltaTest, DeltaKernels, test::KernelNames);

// Designs of windows, and with modes where the kernel takes them.
template <class K>
std::vector<Design> designs(double order) {
    std::vector<Design> all = {{order, 1}, {order, 2}, {order, 7}, {order, 50}};
    if constexpr (glsum::keeps_modes<typename K::HistoryPart>) {
        static std::vector<glsum::design::Approximation> made;  // one at a time: a test takes its designs in turn
        made.clear();
        made.reserve(3);
        for (const double error : {1e-2, 1e-4, 1e-6}) {
            if (glsum::design::has_tail(order - 1.0)) {
                made.push_back(*glsum::design::design_modes({order - 1.0, 1000}, error));
                all.push_back({order, made.back().length(), made.back().modes});
            }
        }
    }
    return all;
}

TYPED_TEST(DeltaTest, IsTheInnerSumOfItsIncrementsBitForBit) {
    using Inner = std::conditional_t<glsum::keeps_modes<typename TypeParam::HistoryPart>, typename TypeParam::Inner,
                                     Window<TypeParam>>;
    using Sample = typename TypeParam::Sample;
    for (const double order : {-0.5, 0.2, 0.5, 0.98319, 1.0, 1.9909, 2.0}) {
        for (const Design& design : designs<TypeParam>(order)) {
            Line<TypeParam> line(design);
            Line<Inner> inner({order - 1.0, design.taps, design.modes});
            ASSERT_EQ(line.status(), glsum::Status::ok);
            std::mt19937_64 generator(design.taps);
            Sample before = 0;
            unsigned saturated = 0;
            for (int k = 0; k < 400; ++k) {
                Sample x = TypeParam::from_real(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
                Sample increment = 0;
                if constexpr (std::is_integral_v<Sample>) {
                    x = k < 200 ? x : static_cast<Sample>(generator());  // then beyond |x| = 1
                    const std::int64_t exact = std::int64_t{x} - before;
                    const std::int64_t highest = std::numeric_limits<Sample>::max();
                    saturated += exact > highest || exact < -highest - 1 ? 1 : 0;
                    increment = static_cast<Sample>(std::clamp(exact, -highest - 1, highest));
                } else {
                    increment = x - before;
                }
                before = x;
                ASSERT_EQ(line.step(x), inner.step(increment)) << order << " " << design.taps << " " << k;
                if constexpr (std::is_integral_v<Sample>) {
                    ASSERT_EQ(line.state().scale.saturations, inner.state().scale.saturations + saturated);
                }
            }
            if constexpr (std::is_integral_v<Sample>) {
                EXPECT_GT(saturated, 10U);
            }
            TypeParam::reset(line.state());
            Inner::reset(inner.state());
            const Sample x = TypeParam::from_real(0.5);
            ASSERT_EQ(line.step(x), inner.step(x)) << "after reset";
        }
    }
}

TYPED_TEST(DeltaTest, TakesOrdersAboveMinusOne) {
    for (const double order : {-0.99, -0.5, 0.0, 1.0, 2.0}) {
        EXPECT_EQ(Line<TypeParam>({order, 5}).status(), glsum::Status::ok) << order;
    }
    for (const double order : {-1.0, -1.5, 2.01, std::nan("")}) {
        EXPECT_EQ(Line<TypeParam>({order, 5}).status(), glsum::Status::order_out_of_range) << order;
    }
}

// By full length it is the sum of order v.
TYPED_TEST(DeltaTest, EqualsTheOrderByFullLength) {
    constexpr std::size_t samples = 300;
    const auto record = noise(samples);
    for (const double order : {-0.5, 0.2, 0.5, 0.98319, 1.5, 2.0}) {
        const Design design{order, samples};
        EXPECT_LE(farthest<TypeParam>(design, record, full_sums(order, record)), bound_of<TypeParam>(design, samples));
    }
}

// A level that lasts, behind a window: the sum is 0, and what full memory still has is a_0 + ... + a_k of the step.
TYPED_TEST(DeltaTest, MissesOfAStepWhatFadesWithTheRecord) {
    constexpr std::size_t samples = 300;
    const std::vector<double> step(samples, 0.875);
    for (const double order : {0.2, 0.5, 0.98319, 1.5}) {
        const auto a = reference::weights(Real(order), samples);
        for (const std::size_t taps : {2U, 20U}) {
            Line<TypeParam> line({order, taps});
            Real level = 0;
            for (std::size_t k = 0; k < samples; ++k) {
                level += 0.875 * a[k];
                const double sum = line.step_real(step[k]);
                if (k < taps) {
                    ASSERT_NEAR(sum, static_cast<double>(level), bound_of<TypeParam>({order, taps}, samples));
                } else {
                    ASSERT_EQ(sum, 0.0) << order << " " << taps << " " << k;
                }
            }
        }
    }
}

TYPED_TEST(DeltaTest, KeepsItsBoundOnEverySignalAndDesign) {
    constexpr std::size_t samples = 600;
    double largest_share = 0.0;
    for (const double order : {-0.5, 0.2, 0.5, 0.98319, 1.9909}) {
        for (const Design& design : designs<TypeParam>(order)) {
            for (const std::string_view signal : bench::signal_names) {
                const auto record = bench::make_signal(signal, samples, 1);
                const double share =
                    farthest<TypeParam>(design, record, reference::sums_of(Dropped::increments, design, record)) /
                    bound_of<TypeParam>(design, samples);
                ASSERT_LE(share, 1.0) << order << " " << design.taps << " " << signal;
                largest_share = std::max(largest_share, share);
            }
        }
    }
    EXPECT_GE(largest_share, 0.01);
    this->RecordProperty("largest share of the bound", std::to_string(largest_share));
}

TEST(Delta, InFixedPointSamplesAreHeldAtHalfScale) {
    using K = glsum::Sum<glsum::MirrorDelta, glsum::Plain, glsum::Q31>;
    Line<K> line({1.0, 4});
    EXPECT_EQ(K::from_real(1.0), 1 << 30);
    EXPECT_EQ(line.step_real(0.75), 0.75);
    EXPECT_EQ(line.step_real(-0.75), -1.5);
    EXPECT_EQ(line.state().scale.saturations, 0U);
    line.step(std::numeric_limits<std::int32_t>::max());  // x = 2
    EXPECT_EQ(line.state().scale.saturations, 1U);
    K::reset(line.state());
    EXPECT_EQ(line.state().scale.saturations, 0U);
    EXPECT_EQ(line.step_real(0.75), 0.75);
}

// --- guesses of the tail

template <class K>
using IsGuess = std::bool_constant<glsum::guesses_tail<typename K::HistoryPart>>;
using GuessKernels = test::Filter<IsGuess, test::Kernels>::Types;

template <class K>
class GuessTest : public testing::Test {};
TYPED_TEST_SUITE(GuessTest, GuessKernels, test::KernelNames);

// The weights as wrap/tail.hpp states them, one rounding at a time.
template <class Number>
struct StatedWeights {
    struct Carried {
        Number value = 0;
        Number lost = 0;
        void add(Number step) {
            const volatile Number whole = step + lost;
            const volatile Number after = value + whole;
            // Whichever is larger: exact either way.
            if (std::fabs(value) >= std::fabs(whole)) {
                const volatile Number taken = after - value;
                lost = whole - taken;
            } else {
                const volatile Number taken = after - whole;
                lost = value - taken;
            }
            value = after;
        }
    };
    Number order;
    Number in_window;
    Carried tail;
    Carried mean;

    void advance(std::size_t k, std::size_t taps) {
        const volatile Number apart = tail.value - mean.value;
        const volatile Number share = apart / static_cast<Number>(k - taps + 1);
        mean.add(share);
        const volatile Number all = in_window + tail.value;
        const volatile Number product = all * order;
        const volatile Number weight = product / static_cast<Number>(k);
        tail.add(-weight);
    }
};

TYPED_TEST(GuessTest, EqualsTheStatedOrderBitForBit) {
    using Number = typename TypeParam::Sample;
    for (const double order : {0.2, 0.5, 0.98319, 1.0, 1.9909, -0.5, -1.3}) {
        for (const std::size_t taps : {1U, 2U, 3U, 8U, 50U}) {
            Line<TypeParam> line({order, taps});
            Line<Window<TypeParam>> window({order, taps});
            const auto exact = reference::weights(Real(order), taps);
            Real in_window = 0;
            for (const Real& weight : exact) {
                in_window += weight;
            }
            // A is promised to four units of a double, not to its last bit.
            ASSERT_NEAR(static_cast<double>(line.state().in_window), static_cast<double>(in_window),
                        std::fabs(static_cast<double>(in_window)) * 4.0 *
                            static_cast<double>(std::numeric_limits<Number>::epsilon()));
            StatedWeights<Number> weights{static_cast<Number>(order), line.state().in_window, {}, {}};
            std::vector<Number> past;
            std::mt19937_64 generator(taps);
            for (std::size_t k = 0; k < 3 * taps + 300; ++k) {
                const auto x = static_cast<Number>(static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0);
                past.push_back(x);
                Number sum = window.step(x);
                if (k >= taps) {
                    weights.advance(k, taps);
                    const Number of_first = weights.tail.value - weights.mean.value;
                    const bool to_first = TypeParam::HistoryPart::to_first;
                    const volatile Number oldest =
                        (to_first ? weights.mean.value : weights.tail.value) * past[k - taps + 1];
                    const volatile Number first = of_first * past.front();
                    sum = sum + oldest;
                    sum = to_first ? sum + first : sum;
                }
                ASSERT_EQ(line.step(x), sum) << "order " << order << ", taps " << taps << ", k " << k;
            }
        }
    }
}

// A step, whatever its record's length; with a line a ramp too, which hold misses.
TYPED_TEST(GuessTest, IsExactForAStepAndTheLineForARamp) {
    constexpr std::size_t samples = 1000;
    const std::vector<double> step(samples, 0.875);
    std::vector<double> ramp(samples);
    for (std::size_t k = 0; k < samples; ++k) {
        ramp[k] = 0.25 + static_cast<double>(k) / 2048.0;
    }
    for (const double order : {0.2, 0.5, 0.98319, 1.5, -0.5}) {
        const auto of_step = full_sums(order, step);
        const auto of_ramp = full_sums(order, ramp);
        for (const std::size_t taps : {3U, 50U}) {
            const Design design{order, taps};
            const double bound = bound_of<TypeParam>(design, samples);
            EXPECT_LE(farthest<TypeParam>(design, step, of_step), bound) << order << " " << taps;
            const double on_ramp = farthest<TypeParam>(design, ramp, of_ramp);
            if (TypeParam::HistoryPart::to_first) {
                EXPECT_LE(on_ramp, bound) << order << " " << taps;
            } else if (order <= 0.5) {  // beyond, little is dropped
                EXPECT_GT(on_ramp, 100.0 * bound) << order << " " << taps;
            }
        }
    }
    // Against truncation by decades, at v = 0.5.
    const Design design{0.5, 50};
    const auto exact = full_sums(0.5, step);
    EXPECT_LT(farthest<TypeParam>(design, step, exact), 1e-3 * farthest<Window<TypeParam>>(design, step, exact));
}

// No guess within the range of the samples is farther off than twice what was dropped, whatever the signal: noise, a
// wave that the window just holds, and the worst for an extrapolation, alternating signs.
TYPED_TEST(GuessTest, NeverErrsByMoreThanAGuessWithinTheSamplesCan) {
    constexpr std::size_t samples = 500;
    std::vector<double> alternating(samples);
    for (std::size_t k = 0; k < samples; ++k) {
        alternating[k] = k % 2 == 0 ? 0.9 : -0.9;
    }
    for (const double order : {0.2, 0.5, 0.98319, 1.5}) {
        for (const std::size_t taps : {3U, 16U}) {
            const Design design{order, taps};
            const double dropped = glsum::absolute_sum(order, samples) - glsum::absolute_sum(order, taps);
            for (const auto& record : {noise(samples), alternating, bench::make_signal("sine50", samples, 1)}) {
                const auto exact = full_sums(order, record);
                EXPECT_LE(farthest<TypeParam>(design, record, exact),
                          2.0 * 0.9 * dropped + bound_of<TypeParam>(design, samples))
                    << order << " " << taps;
            }
        }
    }
}

// A million samples: the sums within the bound, and the carried weight within what its header says of it.
TYPED_TEST(GuessTest, KeepsItsBoundOverAMillionSamples) {
    using Number = typename TypeParam::Sample;
    constexpr double u = std::numeric_limits<Number>::epsilon() / 2.0;
    constexpr std::size_t samples = 1'000'000;
    for (const double order : {0.5, -0.5}) {
        const Design design{order, 3};
        Line<TypeParam> line(design);
        const double bound = bound_of<TypeParam>(design, samples, 1.0);
        const std::vector<Real> a = reference::weights(Real(order), design.taps);
        const Real in_window = a[0] + a[1] + a[2];
        Real level = in_window;  // a_0 + ... + a_k = (1 - v/k) of that before
        Real tails = 0;          // T_L-1 + ... + T_(k-1)
        double share = 0.0;
        std::mt19937_64 generator(5);
        double past[3] = {};
        double first = 0.0;
        for (std::size_t k = 0; k < samples; ++k) {
            const double x = static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0;
            first = k == 0 ? x : first;
            past[2] = past[1];
            past[1] = past[0];
            past[0] = x;
            const double found = line.step_real(x);
            if (k >= design.taps) {
                tails += level - in_window;
                level *= Real(static_cast<double>(k) - order) / Real(k);
            }
            if (k > 1000 && k % 97 != 0 && k + 1 != samples) {
                continue;
            }
            Real exact = Real(past[0]) + a[1] * Real(past[1]) + a[2] * Real(past[2]);
            if (k >= design.taps) {
                const Real tail = level - in_window;
                const Real mean = TypeParam::HistoryPart::to_first ? Real(tails / Real(k - 2)) : tail;
                exact += mean * Real(past[2]) + (tail - mean) * Real(first);
                const auto n = static_cast<double>(k);
                const auto& carried = line.state().tail;
                const double off =
                    std::fabs(static_cast<double>(Real(Real(carried.value) + Real(carried.lost) - tail)));
                const double of_weights = std::fabs(static_cast<double>(tail));  // of one sign
                const double stated =
                    order > 0.0 ? of_weights : -order * (1.0 / 3.0 + std::log(n / 3.0)) * static_cast<double>(level);
                ASSERT_LE(off, 11.0 * u * stated + n * u * u * of_weights) << "order " << order << ", k " << k;
            }
            const double error = std::fabs(reference::Exact(exact).error_of(found));
            ASSERT_LE(error, bound) << "order " << order << ", k " << k;
            share = std::max(share, error / bound);
        }
        EXPECT_GE(share, 0.01) << order;
    }
}

// A number of six digits, of which terms of second order show, too.
template <bool line>
struct Coarse {
    struct FormatPart {
        static constexpr double data_roundoff = 0x1p-6;
    };
    struct HistoryPart {
        static constexpr bool to_first = line;
    };
};

// The walk that wrap/tail_bound.hpp states, of errors of T and H; products of these are a thousandth more.
TEST(GuessBound, IsTheWalkThatItsHeaderStates) {
    constexpr double u = 0x1p-6;
    constexpr std::size_t taps = 4;
    constexpr std::size_t samples = 15;
    for (const double order : {0.5, -0.5, 1.5}) {
        double weight = 1.0;  // a_(k-1), then a_k
        double in_window = 1.0;
        double tail = 0.0;
        double mean = 0.0;
        double of_tail = 0.0;
        double of_mean = 0.0;
        double hold = 0.0;
        double line = 0.0;
        for (std::size_t i = 1; i < samples; ++i) {
            const auto k = static_cast<double>(i);
            weight *= 1.0 - (order + 1.0) / k;
            if (i < taps) {
                in_window += weight;
                continue;
            }
            const double n = k - taps + 1.0;
            of_mean = (1.0 - 1.0 / n) * of_mean +
                      (of_tail + u * std::fabs(tail) + u * std::fabs(mean) + 4.0 * u * std::fabs(tail - mean)) / n +
                      u * u * std::fabs(mean);
            mean += (tail - mean) / n;
            of_tail = std::fabs(1.0 - order / k) * of_tail +
                      std::fabs(order) / k * (4.0 * u * std::fabs(in_window) + u * std::fabs(tail)) +
                      6.0 * u * std::fabs(weight) + u * u * std::fabs(tail);
            tail += weight;
            hold = std::max(hold, of_tail + 4.0 * u * std::fabs(tail));
            // H x_(k-L+1) and (T - H) x_0: five roundings of the first, four and both words' own of the other.
            line = std::max(line, of_mean + 5.0 * u * std::fabs(mean) + of_tail + of_mean + u * std::fabs(tail) +
                                      u * std::fabs(mean) + 4.0 * u * std::fabs(tail - mean));
        }
        EXPECT_NEAR((glsum::tail_error<Coarse<false>>({order, taps}, samples)) / (1.001 * hold), 1.0, 1e-12) << order;
        EXPECT_NEAR((glsum::tail_error<Coarse<true>>({order, taps}, samples)) / (1.001 * line), 1.0, 1e-12) << order;
    }
}

TYPED_TEST(GuessTest, WeightsStayWhereTheyAreAtTheLastCount) {
    Line<TypeParam> line({0.5, 5});
    for (int k = 0; k < 20; ++k) {
        line.step_real(0.5);
    }
    line.state().count = TypeParam::last_count - 1;
    line.step_real(0.5);
    const auto tail = line.state().tail.value;
    const double sum = line.step_real(0.5);
    EXPECT_EQ(line.state().count, TypeParam::last_count);
    EXPECT_EQ(line.step_real(0.5), sum);
    EXPECT_EQ(line.state().tail.value, tail);
}

// A record begins with the first sample after a reset: its value and the count, not only its window.
TYPED_TEST(GuessTest, ResetBeginsANewRecord) {
    Line<TypeParam> line({0.5, 4});
    Line<TypeParam> fresh({0.5, 4});
    for (const double x : noise(100)) {
        line.step_real(x);
    }
    TypeParam::reset(line.state());
    for (const double x : noise(60)) {
        ASSERT_EQ(line.step_real(x), fresh.step_real(x));
    }
}

}  // namespace
