// A fractional PID controller stepped with a few modes: against full memory, and in a loop against the exact one.
#include "drive/realtime_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/failure.hpp"
#include "drive/closed_loop.hpp"
#include "glsum/weights.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::FractionalPid;
using drive::RealtimeController;
using drive::RealtimeModel;
using drive::Writing;

constexpr double h = 0.001;

template <class K>
class Stepped {
public:
    explicit Stepped(const glsum::ControllerDesign& design)
        : table_(K::table_count(design.design().taps)), past_(K::past_count(design.design().taps)) {
        EXPECT_EQ(glsum::Controller<K>::prepare(state_, design, table_, past_), glsum::Status::ok);
    }
    double step(double error) { return glsum::Controller<K>::step(state_, static_cast<typename K::Sample>(error)); }

private:
    std::vector<typename K::Coefficient> table_;
    std::vector<typename K::Sample> past_;
    typename glsum::Controller<K>::State state_{};
};

template <class K>
class Plant {
public:
    explicit Plant(const glsum::ModelDesign& design)
        : table_(glsum::Stepper<K>::table_count(design.tables[0])),
          past_(glsum::Stepper<K>::past_count(design.tables[0])),
          line_(glsum::Stepper<K>::line_count(design.delay)) {
        EXPECT_EQ(glsum::Stepper<K>::prepare(state_, design, table_, past_, line_), glsum::Status::ok);
    }
    double step(double input) {
        return static_cast<double>(glsum::Stepper<K>::step(state_, static_cast<typename K::Sample>(input)));
    }

private:
    std::vector<typename K::Coefficient> table_;
    std::vector<typename K::Sample> past_;
    std::vector<typename K::Sample> line_;
    typename glsum::Stepper<K>::State state_{};
};

using Full = glsum::Sum<glsum::Ring, glsum::Oldest, glsum::F64>;
using Modes = glsum::Sum<glsum::Modes, glsum::Plain, glsum::F32>;
using Carried = glsum::Sum<glsum::Modes, glsum::Compensated, glsum::F32>;

const FractionalPid pi{.kp = 0.3, .ki = 0.5, .integral_order = 0.9};

// 16 multiplications beside full memory, on errors of every kind.
TEST(RealtimeController, AFewModesStandForFullMemory) {
    for (const FractionalPid& gains :
         {pi, FractionalPid{.kp = 1.0, .ki = 2.0, .kd = 0.05, .integral_order = 0.6, .derivative_order = 0.7},
          FractionalPid{.kp = 0.5, .ki = 1.0, .integral_order = 1.0},
          FractionalPid{.ki = 1.0, .integral_order = 0.3}}) {
        constexpr std::size_t count = 20'000;
        const RealtimeController full(gains, {count}, h, count);
        const RealtimeController few(gains, {3 + 2 * 9, 9}, h, count);
        Stepped<Full> exact(full.design());
        Stepped<Carried> modes(few.design());
        double largest = 0.0;
        double scale = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const double error = k < 4000          ? 1.0
                                 : k < 9000        ? std::sin(0.002 * static_cast<double>(k))
                                 : k % 3000 < 1500 ? -0.5
                                                   : 0.7;
            const double expected = exact.step(error);
            largest = std::max(largest, std::fabs(modes.step(error) - expected));
            scale = std::max(scale, std::fabs(expected));
        }
        EXPECT_LE(largest, few.error() + 2e-5 * scale) << gains.integral_order;
        EXPECT_LE(largest, 2e-3 * scale) << gains.integral_order;
    }
}

// A constant error for a long time: the integral of order 1 grows straight on, and none of the fit's error is
// integrated.
TEST(RealtimeController, DoesNotDrift) {
    const RealtimeController whole({.ki = 1.0, .integral_order = 1.0}, {3}, h);
    Stepped<Modes> line(whole.design());
    double u = 0.0;
    for (int k = 0; k < 1'000'000; ++k) {
        u = line.step(0.001);
    }
    EXPECT_NEAR(u, 1.0, 2e-6);  // 1e6 samples of 1e-6
    // A pulse long ago: what is left of it, by the definition, and never more than it was.
    const RealtimeController few(pi, {3 + 2 * 9, 9}, h);
    Stepped<Carried> other(few.design());
    constexpr std::size_t length = 5000;
    constexpr std::size_t later = 50'000;
    std::vector<double> position = {1.0};
    for (glsum::Weights walk(-pi.integral_order); position.size() <= later;) {
        walk.next();
        position.push_back(walk.weight());
    }
    double expected = 0.0;
    for (std::size_t i = 0; i < length; ++i) {
        expected += pi.ki * std::pow(h, pi.integral_order) * position[later - i];
    }
    double most = 0.0;
    for (std::size_t k = 0; k <= 1'000'000; ++k) {
        const double now = other.step(k < length ? 1.0 : 0.0);
        if (k < length) {
            most = now;
        } else {
            ASSERT_LE(std::fabs(now), most) << k;
        }
        if (k == later) {
            EXPECT_NEAR(now, expected, 1e-3 * expected);
        }
    }
}

TEST(RealtimeController, StopsAtItsLimitsAndComesBackAtOnce) {
    RealtimeController whole({.kp = 0.5, .ki = 1.0, .integral_order = 1.0}, {3}, h);
    glsum::ControllerDesign design = whole.design();
    design.low = -0.25;
    design.high = 1.0;
    Stepped<Modes> line(design);
    for (int k = 0; k < 10'000; ++k) {
        ASSERT_LE(line.step(1.0), 1.0);
    }
    EXPECT_EQ(line.step(1.0), 1.0);
    EXPECT_LT(line.step(-0.5), 0.3);  // by kp (1 - -0.5): nothing was wound up
    for (int k = 0; k < 10'000; ++k) {
        ASSERT_GE(line.step(-1.0), -0.25);
    }
    EXPECT_EQ(line.step(-1.0), -0.25);
}

// Plant (12) behind its dead time in a loop: controller and plant in single precision with a few modes each, against
// the exact loop, in which the controller's output is held and the plant continuous.
TEST(RealtimeController, HoldsALoopAroundThePlant) {
    constexpr std::size_t count = 12'000;
    std::vector<double> time;
    std::vector<double> reference;
    for (std::size_t k = 0; k < count; ++k) {
        time.push_back(static_cast<double>(k) * h);
        reference.push_back(k < 6000 ? 1.0 : 0.4);
    }
    const drive::Model controller = drive::to_model({.kp = pi.kp, .ki = pi.ki, .integral_order = 0.9}, "pi");
    const auto exact = drive::run_loop(plants::niopdt(), controller, time, reference);
    const RealtimeController few(pi, {3 + 2 * 9, 9}, h);
    drive::Model sooner = plants::niopdt();  // a step returns the output before the sample that it is given acts
    sooner.delay_s -= h;
    const auto off = [&]<class K>(Plant<K> plant) {
        Stepped<Carried> line(few.design());
        double output = 0.0;
        double largest = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            largest = std::max(largest, std::fabs(output - exact.output[k]));
            output = plant.step(line.step(reference[k] - output));
        }
        return largest;
    };
    const RealtimeModel first(sooner, Writing::delta, {16, 7}, h);
    const RealtimeModel second(sooner, Writing::bdf2, {23, 9}, h);
    EXPECT_LT(off(Plant<Modes>(first.design())), 6.55e-4);  // as docs/drive-models.md has them
    EXPECT_LT(off(Plant<Modes>(second.design())), 4.35e-4);
    // What a window makes of it, in the same numbers.
    const RealtimeModel window(sooner, Writing::delta, {600}, h);
    EXPECT_GT(off(Plant<glsum::Sum<glsum::Mirror, glsum::Multi, glsum::F32>>(window.design())), 3e-3);
    EXPECT_NEAR(few.error(), 5.3e-4, 5e-6);
    EXPECT_NEAR(drive::loop_gain(few, pi, plants::niopdt(), h), 1.1e-3, 5e-5);
    EXPECT_LT(drive::loop_gain(few, pi, plants::niopdt(), h),
              drive::loop_gain(RealtimeController(pi, {3 + 2 * 4, 4}, h), pi, plants::niopdt(), h));
}

// Of whole orders, u_k - u_(k-1) = (kp + ki h + kd / h) e_k - (kp + 2 kd / h) e_(k-1) + kd / h e_(k-2).
TEST(RealtimeController, NumbersOfAPidAreThoseByHand) {
    const RealtimeController whole({.kp = 2.0, .ki = 3.0, .kd = 0.5}, {5}, 0.25);
    const double first = 2.0 + 3.0 * 0.25 + 0.5 / 0.25;
    EXPECT_NEAR(whole.design().first, first, 1e-12);
    ASSERT_EQ(whole.design().ratios.size(), 4U);
    EXPECT_NEAR(whole.design().ratios[0], -(2.0 + 2.0 * 0.5 / 0.25) / first, 1e-12);
    EXPECT_NEAR(whole.design().ratios[1], 0.5 / 0.25 / first, 1e-12);
    EXPECT_NEAR(whole.design().ratios[2], 0.0, 1e-12);
    EXPECT_NEAR(whole.design().ratios[3], 0.0, 1e-12);
    EXPECT_NEAR(whole.error(), 0.0, 1e-12);
    EXPECT_EQ(whole.memory().text(), "5");
}

// D^0.5 has the weights 1, -0.5, -0.125, -0.0625, -0.0390625 times h^-0.5, here 2; the ratios are of their differences.
// Behind three taps the last weight goes on: by how much that is off is summed up to the horizon.
TEST(RealtimeController, NumbersOfAHalfOrderAreThoseByHand) {
    const FractionalPid half{.kd = 1.0, .derivative_order = 0.5};
    const RealtimeController made(half, {3}, 0.25, 4);
    EXPECT_NEAR(made.design().first, 2.0, 1e-12);
    ASSERT_EQ(made.design().ratios.size(), 2U);
    EXPECT_NEAR(made.design().ratios[0], -1.5, 1e-12);
    EXPECT_NEAR(made.design().ratios[1], 0.375, 1e-12);
    EXPECT_NEAR(made.error(), 2.0 * (0.0625 + 0.0859375), 1e-12);
    EXPECT_NEAR(RealtimeController(half, {3}, 0.25, 3).error(), 2.0 * 0.0625, 1e-12);
    EXPECT_NEAR(RealtimeController(half, {3}, 0.25, 1).error(), 2.0 * 0.0625, 1e-12);
    // An integral of a half sums up: 1, 0.5, 0.375, 0.3125 times h^0.5.
    const RealtimeController integral({.ki = 1.0, .integral_order = 0.5}, {3}, 0.25, 3);
    EXPECT_NEAR(integral.design().first, 0.5, 1e-12);
    EXPECT_NEAR(integral.design().ratios[0], -0.5, 1e-12);
    EXPECT_NEAR(integral.design().ratios[1], -0.125, 1e-12);
    EXPECT_NEAR(integral.error(), 0.5 * 0.0625, 1e-12);
}

TEST(RealtimeController, RefusesWhatItCannotStep) {
    EXPECT_THROW(RealtimeController({}, {10}, h), glsum::Failure);
    EXPECT_THROW(RealtimeController({.ki = 1.0, .integral_order = 1.2}, {10}, h), glsum::Failure);
    EXPECT_THROW(RealtimeController({.kd = 1.0, .derivative_order = 0.0}, {10}, h), glsum::Failure);
    EXPECT_THROW(RealtimeController(pi, {10}, 0.0), glsum::Failure);
    EXPECT_THROW(RealtimeController(pi, {2 + 2 * 5, 5}, h), glsum::Failure);
}

}  // namespace
