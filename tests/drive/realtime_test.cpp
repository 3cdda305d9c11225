// Models stepped in real time, on this machine: against the exact response, and against the scheme written plainly.
#include "drive/realtime.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/failure.hpp"
#include "drive/response.hpp"
#include "drive/simulation.hpp"
#include "qemu/emulate/model_run.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Writing;

constexpr double h = 0.001;
const std::vector<double> ones{1.0};

std::vector<double> stepped(const drive::RealtimeModel& model, const std::string& kernel, std::size_t steps) {
    return qemu::step_model_here({kernel, &model.design(), ones, steps}).output;
}

double largest_error(const drive::Model& model, const std::vector<double>& output) {
    std::vector<double> time;
    for (std::size_t k = 0; k < output.size(); ++k) {
        time.push_back(static_cast<double>(k) * h);
    }
    const auto exact = drive::respond(model, std::vector<drive::Change>{{0.0, 1.0}}, time);
    double largest = 0.0;
    for (std::size_t k = 0; k < output.size(); ++k) {
        largest = std::max(largest, std::fabs(output[k] - exact[k]));
    }
    return largest;
}

// 5 s behind the dead time of 1 s.
double error_of(Writing writing, std::size_t taps, const std::string& kernel) {
    const drive::RealtimeModel model(plants::niopdt(), writing, {taps}, h);
    return largest_error(plants::niopdt(), stepped(model, kernel, 6000));
}

TEST(Realtime, IncrementsInSinglePrecisionReachWhatIsPromised) {
    for (const char* kernel : {"ring_plain_f32", "ring_oldest_f32", "mirror_multi_f32", "mirror_multifma_f32"}) {
        EXPECT_LT(error_of(Writing::delta, 600, kernel), 7e-3) << kernel;
        // Newest first, the sum of thousands of small terms costs a little more.
        const bool plain = std::string(kernel) == "ring_plain_f32";
        EXPECT_LT(error_of(Writing::delta, 5001, kernel), plain ? 8e-4 : 6e-4) << kernel;
    }
    EXPECT_LT(error_of(Writing::delta, 600, "ring_plain_q31"), 7e-3);
    EXPECT_LT(error_of(Writing::delta, 5001, "ring_plain_q31"), 6e-4);
}

// Full memory in single precision, for 60 s: errors against the exact response and multiplications a step.
TEST(Realtime, AFewModesReachWhatIsPromised) {
    struct Promise {
        Writing writing;
        drive::Memory memory;
        const char* kernel;
        double error;
        std::size_t multiplications;
    };
    for (const Promise& promise : {Promise{Writing::delta, {16, 7}, "modes_plain_f32", 7e-4, 18},
                                   Promise{Writing::bdf2, {23, 9}, "modes_plain_f32", 1e-4, 24},
                                   Promise{Writing::bdf2, {27, 11}, "modes_compensated_f32", 2e-5, 32}}) {
        const drive::RealtimeModel model(plants::niopdt(), promise.writing, promise.memory, h);
        EXPECT_EQ(model.memory().text(), promise.memory.text());
        const auto found = qemu::step_model_here({promise.kernel, &model.design(), ones, 61'000});
        EXPECT_LE(found.multiplications, promise.multiplications) << promise.memory.text();
        std::vector<std::size_t> at;
        for (std::size_t k = 0; k <= 61'000; k += k < 3000 ? 1 : 50) {
            at.push_back(k);
        }
        std::vector<double> time(at.size());
        std::transform(at.begin(), at.end(), time.begin(), [](std::size_t k) { return static_cast<double>(k) * h; });
        const auto exact = drive::respond(plants::niopdt(), std::vector<drive::Change>{{0.0, 1.0}}, time);
        for (std::size_t i = 0; i < at.size(); ++i) {
            ASSERT_NEAR(found.output[at[i]], exact[i], promise.error) << promise.memory.text() << " at " << time[i];
        }
    }
}

// Not a step alone: stairs up and down, and one back to rest, within the same errors of a step's height.
TEST(Realtime, ModesHoldForOtherInputsToo) {
    const std::vector<drive::Change> changes = {{0.0, 0.5}, {0.7, 0.5}, {2.1, -1.25}, {3.5, 0.25}, {9.0, 1.0}};
    std::vector<double> input;
    std::vector<double> time;
    for (int k = 0; k <= 14'000; ++k) {
        time.push_back(k * h);
        double value = 0.0;
        for (const drive::Change& change : changes) {
            value += time.back() >= change.time_s - 1e-9 ? change.size : 0.0;
        }
        input.push_back(value);
    }
    const auto exact = drive::respond(plants::niopdt(), changes, time);
    const auto off = [&](Writing writing, const drive::Memory& memory, const char* kernel) {
        const drive::RealtimeModel model(plants::niopdt(), writing, memory, h);
        const auto found = qemu::step_model_here({kernel, &model.design(), input, input.size() - 1}).output;
        double largest = 0.0;
        for (std::size_t k = 0; k < input.size(); ++k) {
            largest = std::max(largest, std::fabs(found[k] - exact[k]));
        }
        return largest;
    };
    EXPECT_LT(off(Writing::delta, {16, 7}, "modes_plain_f32"), 2 * 7e-4);
    EXPECT_LT(off(Writing::delta, {16, 7}, "modes_plain_q31"), 2 * 7e-4);
    EXPECT_LT(off(Writing::bdf2, {23, 9}, "modes_plain_f32"), 2 * 1e-4);
    EXPECT_LT(off(Writing::bdf2, {27, 11}, "modes_compensated_f32"), 2 * 2e-5);
    // A window that a step would flatter.
    EXPECT_GT(off(Writing::delta, {600}, "ring_plain_f32"), 5e-3);
}

// The second-order scheme itself, by windows of full memory: a hundredth of the first-order error.
TEST(Realtime, Bdf2IsOfSecondOrder) {
    EXPECT_LT(error_of(Writing::bdf2, 6001, "ring_oldest_f64"), 1e-5);
    EXPECT_GT(error_of(Writing::delta, 6001, "ring_oldest_f64"), 5e-4);
}

TEST(Realtime, TheTextbookFormFailsInSinglePrecisionAndNotInDouble) {
    EXPECT_GT(error_of(Writing::merged, 5001, "ring_plain_f32"), 0.1);
    EXPECT_GT(error_of(Writing::apart, 5001, "ring_plain_f32"), 0.1);
    EXPECT_LT(error_of(Writing::merged, 5001, "ring_oldest_f64"), 6e-4);
    EXPECT_LT(error_of(Writing::apart, 5001, "ring_oldest_f64"), 6e-4);
}

TEST(Realtime, StepsTheSameSchemeAsTheSimulation) {
    for (const auto& plant : {plants::fopdt(), plants::sopdt(), plants::niopdt()}) {
        for (const Writing writing : {Writing::merged, Writing::delta, Writing::apart}) {
            for (const std::size_t taps : {3U, 50U, 400U}) {
                const drive::RealtimeModel model(plant, writing, {taps}, h);
                const auto found = stepped(model, "ring_oldest_f64", 3000);
                const auto expected =
                    drive::simulate(plant, {.step_s = h, .taps = taps, .increments = writing == Writing::delta},
                                    std::vector<double>(3001, 1.0));
                for (std::size_t k = 0; k < found.size(); ++k) {
                    ASSERT_NEAR(found[k], expected.output[k], 1e-8 * (1.0 + std::fabs(expected.output[k])))
                        << drive::to_text(plant) << " " << taps << " at " << k;
                }
            }
        }
    }
}

TEST(Realtime, WholeOrdersNeedNoMoreTermsThanTheyHave) {
    EXPECT_EQ(drive::RealtimeModel(plants::fopdt(), Writing::delta, {600}, h).memory().taps, 1U);
    EXPECT_EQ(drive::RealtimeModel(plants::sopdt(), Writing::delta, {600}, h).memory().taps, 2U);
    EXPECT_EQ(drive::RealtimeModel(plants::fopdt(), Writing::merged, {600}, h).memory().taps, 2U);
    EXPECT_EQ(drive::RealtimeModel(plants::sopdt(), Writing::merged, {600}, h).memory().taps, 3U);
    EXPECT_EQ(drive::RealtimeModel(plants::sopdt(), Writing::apart, {600}, h).design().tables.size(), 2U);
    EXPECT_EQ(drive::RealtimeModel(plants::niopdt(), Writing::delta, {600}, h).memory().taps, 600U);
}

// An input that goes against the scales as hard as it can: the sign of the impulse response, backward.
TEST(Realtime, FixedPointHoldsWhateverTheInput) {
    const drive::RealtimeModel model(plants::niopdt(), Writing::delta, {600}, h);
    std::vector<double> worst;
    for (int k = 0; k < 4000; ++k) {
        worst.push_back(k % 7 < 3 ? 1.0 : -1.0);
    }
    for (int k = 0; k < 4000; ++k) {
        worst.push_back(k / 1340 % 2 == 0 ? 1.0 : -1.0);
    }
    const qemu::PlannedModel planned{"ring_plain_q31", &model.design(), worst, worst.size() - 1};
    const auto fixed = qemu::step_model_here(planned);
    EXPECT_EQ(fixed.saturations, 0U);
    auto in_double = planned;
    in_double.kernel = "ring_oldest_f64";
    const auto expected = qemu::step_model_here(in_double).output;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_NEAR(fixed.output[k], expected[k], 2e-5) << k;
    }
}

// The published scheme's own warning: of second order with the first weights within the fit, it blows up.
TEST(Realtime, ModesAreStableByTheSmallGainTheorem) {
    const auto gain = [](Writing writing, const drive::Memory& memory) {
        return drive::RealtimeModel(plants::niopdt(), writing, memory, h).loop_gain();
    };
    EXPECT_LT(gain(Writing::delta, {4, 1}), 0.9);
    // As docs/drive-models.md has them.
    EXPECT_NEAR(gain(Writing::delta, {16, 7}), 0.030, 0.0005);
    EXPECT_NEAR(gain(Writing::bdf2, {23, 9}), 0.0051, 0.00005);
    EXPECT_NEAR(gain(Writing::bdf2, {27, 11}), 0.0013, 0.00005);
    EXPECT_EQ(gain(Writing::delta, {600}), 0.0);
    EXPECT_THROW((void)gain(Writing::bdf2, {22, 10}), glsum::Failure);
    EXPECT_THROW((void)gain(Writing::bdf2, {23, 10}), glsum::Failure);
}

TEST(Realtime, RefusesWhatItCannotStep) {
    drive::Model model = plants::niopdt();
    EXPECT_THROW(drive::RealtimeModel(model, Writing::delta, {0}, h), glsum::Failure);
    EXPECT_THROW(drive::RealtimeModel(model, Writing::delta, {10}, 0.0), glsum::Failure);
    for (const Writing writing : {Writing::merged, Writing::apart}) {
        EXPECT_THROW(drive::RealtimeModel(model, writing, {16, 7}, h), glsum::Failure);
    }
    EXPECT_THROW(drive::RealtimeModel(model, Writing::delta, {15, 7}, h), glsum::Failure);
    EXPECT_THROW(drive::RealtimeModel(model, Writing::delta, {14, 7}, h), glsum::Failure);
    EXPECT_EQ(drive::RealtimeModel(plants::sopdt(), Writing::delta, {16, 7}, h).memory().text(), "2");
    model.numerator = {{1.0, 0.5}, {1.0, 0.0}};
    EXPECT_THROW(drive::RealtimeModel(model, Writing::delta, {10}, h), glsum::Failure);
    EXPECT_THROW((void)qemu::step_model_here({"ring_plain_f33", nullptr, ones, 100}), std::out_of_range);
}

// T y' + y = K u at a step of h is (T/h + 1) y_k = T/h y_(k-1) + K u: every number of a design by hand.
TEST(Realtime, NumbersOfAFirstOrderAreThoseByHand) {
    const drive::Model model = drive::make_fopdt(2.0, 0.5, 0.25);
    for (const Writing writing : {Writing::merged, Writing::apart}) {
        const drive::RealtimeModel made(model, writing, {20}, 0.01);
        const glsum::ModelDesign& design = made.design();
        EXPECT_FALSE(design.increments);
        EXPECT_FALSE(design.half_input);
        EXPECT_EQ(design.delay, 25U);
        EXPECT_NEAR(design.input, 2.0 / 51.0, 1e-15);
        EXPECT_EQ(design.constant, 0.0);
        ASSERT_EQ(design.tables.size(), 1U);
        EXPECT_NEAR(design.tables[0].factor, -50.0 / 51.0, 1e-15);
        EXPECT_TRUE(design.tables[0].ratios.empty());
        EXPECT_EQ(design.input_full_scale, 2.0);
        EXPECT_EQ(design.output_full_scale,
                  4.0);  // an input of 1 never makes more than 2, and a hundredth for rounding
        EXPECT_EQ(design.stored_full_scale, 4.0);
        EXPECT_EQ(made.loop_gain(), 0.0);
        EXPECT_EQ(made.memory().text(), "2");  // the rest are zeros
    }
    const drive::RealtimeModel made(model, Writing::delta, {20}, 0.01);
    const glsum::ModelDesign& design = made.design();
    EXPECT_TRUE(design.increments);
    EXPECT_NEAR(design.input, 2.0 / 51.0, 1e-15);
    EXPECT_NEAR(design.constant, 1.0 / 51.0, 1e-15);
    EXPECT_TRUE(design.tables.empty());
    EXPECT_EQ(design.output_full_scale, 4.0);
    EXPECT_EQ(design.stored_full_scale, 0.125);  // up and down again by 2/51, and a hundredth
    // A dead time between two steps is rounded up, but not for what is left of a whole one.
    drive::Model later = model;
    for (const auto& [delay_s, steps] : {std::pair(0.2501, 26U), std::pair(0.25 + 1e-12, 25U), std::pair(0.0, 0U)}) {
        later.delay_s = delay_s;
        EXPECT_EQ(drive::RealtimeModel(later, Writing::delta, {20}, 0.01).design().delay, steps) << delay_s;
    }
    later.denominator[1].coefficient = 0.0;  // an integrator has no constant
    EXPECT_EQ(drive::RealtimeModel(later, Writing::delta, {20}, 0.01).design().constant, 0.0);
    EXPECT_TRUE(drive::RealtimeModel(model, Writing::bdf2, {20}, 0.01).design().half_input);
    EXPECT_EQ(drive::realtime_name("ring_oldest_f32", Writing::merged), "ring_oldest_f32");
    EXPECT_EQ(drive::realtime_name("ring_oldest_f32", Writing::delta), "ringdelta_oldest_f32");
    EXPECT_EQ(drive::realtime_name("ring_oldest_f32", Writing::apart), "ringapart_oldest_f32");
    EXPECT_EQ(drive::realtime_name("ring_oldest_f32", Writing::bdf2), "ringbdf2_oldest_f32");
    // A step takes a multiplication for the input, one for the constant, and for each sum those of its own and one
    // more.
    using K = glsum::Stepper<glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>>;
    EXPECT_EQ(K::multiplications(design), 2U);
    EXPECT_EQ(K::multiplications(drive::RealtimeModel(model, Writing::merged, {20}, 0.01).design()), 2U);
    const drive::RealtimeModel two(plants::niopdt(), Writing::apart, {20}, h);
    EXPECT_EQ(K::multiplications(two.design()), 1U + 2U * 19U);
    EXPECT_EQ(K::line_count(25), 26U);
}

// (1 + T s)^2 y = K u: T^2/h^2 (1 - z)^2 + 2 T/h (1 - z) + 1, with p for T/h. Increments take one factor 1 - z each.
TEST(Realtime, NumbersOfASecondOrderAreThoseByHand) {
    drive::Model model = drive::make_sopdt(2.0, 0.5, 0.0);
    model.numerator = {{3.0, 0.0}};
    constexpr double p = 50.0;  // at 0.01 s
    const double newest = p * p + 2.0 * p + 1.0;
    const drive::RealtimeModel merged(model, Writing::merged, {20}, 0.01);
    EXPECT_NEAR(merged.design().input, 6.0 / newest, 1e-14);
    ASSERT_EQ(merged.design().tables.size(), 1U);
    EXPECT_NEAR(merged.design().tables[0].factor, -(2.0 * p * p + 2.0 * p) / newest, 1e-12);
    ASSERT_EQ(merged.design().tables[0].ratios.size(), 1U);
    EXPECT_NEAR(merged.design().tables[0].ratios[0], -p * p / (2.0 * p * p + 2.0 * p), 1e-12);
    EXPECT_EQ(merged.memory().text(), "3");
    const drive::RealtimeModel apart(model, Writing::apart, {20}, 0.01);
    EXPECT_NEAR(apart.design().input, 6.0 / newest, 1e-14);
    EXPECT_EQ(apart.design().constant, 0.0);
    ASSERT_EQ(apart.design().tables.size(), 2U);
    EXPECT_NEAR(apart.design().tables[0].factor, -2.0 * p * p / newest, 1e-12);
    ASSERT_EQ(apart.design().tables[0].ratios.size(), 1U);
    EXPECT_NEAR(apart.design().tables[0].ratios[0], -0.5, 1e-12);
    EXPECT_NEAR(apart.design().tables[1].factor, -2.0 * p / newest, 1e-12);
    EXPECT_TRUE(apart.design().tables[1].ratios.empty());
    EXPECT_EQ(apart.memory().text(), "3");
    const drive::RealtimeModel delta(model, Writing::delta, {20}, 0.01);
    EXPECT_NEAR(delta.design().input, 6.0 / newest, 1e-14);
    EXPECT_NEAR(delta.design().constant, 1.0 / newest, 1e-14);
    ASSERT_EQ(delta.design().tables.size(), 1U);
    EXPECT_NEAR(delta.design().tables[0].factor, -p * p / newest, 1e-12);
    EXPECT_TRUE(delta.design().tables[0].ratios.empty());
    EXPECT_EQ(delta.memory().text(), "2");
    // By BDF2 1 - z becomes (3 - 4 z + z^2) / 2, which is (1 - z) (3 - z) / 2.
    const double second = 2.25 * p * p + 1.5 * 2.0 * p + 1.0;
    const drive::RealtimeModel bdf2(model, Writing::bdf2, {20}, 0.01);
    EXPECT_NEAR(bdf2.design().input, 6.0 / second, 1e-14);
    EXPECT_NEAR(bdf2.design().constant, 1.0 / second, 1e-14);
    ASSERT_EQ(bdf2.design().tables.size(), 1U);
    EXPECT_NEAR(bdf2.design().tables[0].factor, (-3.75 * p * p - 0.5 * 2.0 * p) / second, 1e-10);
}

// Powers of two above a hundredth more than any input of up to 1 can cause. The output can be K, its increments K/51 up
// and K/51 down again.
TEST(Realtime, ScalesHoldAHundredthMoreThanCanBe) {
    const auto scales = [](double gain, Writing writing) {
        const drive::RealtimeModel made(drive::make_fopdt(gain, 0.5, 0.0), writing, {20}, 0.01);
        return std::pair(made.design().output_full_scale, made.design().stored_full_scale);
    };
    EXPECT_EQ(scales(0.995 * 2.0 / 1.01, Writing::merged), std::pair(2.0, 2.0));
    EXPECT_EQ(scales(1.005 * 2.0 / 1.01, Writing::merged), std::pair(4.0, 4.0));
    EXPECT_EQ(scales(-1.005 * 2.0 / 1.01, Writing::merged), std::pair(4.0, 4.0));
    EXPECT_EQ(scales(0.995 * 0.125 * 25.5 / 1.01, Writing::delta), std::pair(4.0, 0.125));
    EXPECT_EQ(scales(1.005 * 0.125 * 25.5 / 1.01, Writing::delta), std::pair(4.0, 0.25));
}

TEST(Realtime, TheLargestLengthLiesOnTheLineThroughTwo) {
    EXPECT_EQ(drive::largest_taps(100, 650, 600, 3650, 216000), 35991U);
    EXPECT_EQ(drive::largest_taps(100, 650, 600, 3650, 10), 0U);
    EXPECT_EQ(drive::largest_taps(100, 650, 600, 3650, 56), 1U);  // 6 a tap, 50 beside them
    EXPECT_EQ(drive::largest_taps(100, 650, 600, 3650, 55), 0U);
    EXPECT_EQ(drive::largest_taps(100, 650, 600, 650, 1000), 0U);
    EXPECT_EQ(drive::largest_taps(100, 650, 600, 600, 1000), 0U);
}

// A lag far below the sample time: y follows at once, and its increments are twice as large as it is.
TEST(RealtimeModel, InQ31HoldsOutputsThatMoveAtOnce) {
    const drive::RealtimeModel model(drive::make_fopdt(0.6, 1e-4, 0.0), drive::Writing::delta, {2}, 0.001);
    using Stepper = glsum::Stepper<glsum::ring_plain_q31>;
    const glsum::ModelDesign& numbers = model.design();
    std::vector<std::int32_t> table(8);
    std::vector<std::int32_t> past(8);
    std::vector<std::int32_t> waiting(Stepper::line_count(numbers.delay));
    Stepper::State state;
    ASSERT_EQ(Stepper::prepare(state, numbers, table, past, waiting), glsum::Status::ok);
    double exact = 0.0;
    for (int k = 0; k < 20; ++k) {
        const double input = k % 2 == 0 ? 0.75 : -0.5;
        const double own = Stepper::to_real(numbers, Stepper::step(state, Stepper::from_real(numbers, input)));
        EXPECT_NEAR(own, exact, 1e-7) << k;
        exact = (0.1 * exact + 0.6 * input) / 1.1;
    }
}

}  // namespace
