// The blind cases' linear plant with what no list of effects has, and with what takes its time: closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/failure.hpp"
#include "drive/stand/blind/plant.hpp"

namespace {

namespace blind = stand::blind;
using blind::Held;
using blind::Unlisted;
using stand::Stand;

// 0.5 y' + y = u
const blind::Plant lagging{
    .gain = 1.0, .terms = {{0.5, 1.0}, {1.0, 0.0}}, .delay_s = 0.0, .full_input = 1.0, .full_output = 1.0};

/// One level until `change_s`, another from then on.
Held two_levels(double first, double change_s, double second, double until_s) {
    Held held;
    for (int k = 0; k * 0.01 <= until_s + 1e-9; ++k) {
        held.time_s.push_back(k * 0.01);
        held.input.push_back(k * 0.01 < change_s - 1e-9 ? first : second);
    }
    return held;
}
Held constant(double level, double until_s) { return two_levels(level, 0.0, level, until_s); }

using Change = std::function<void(Stand&)>;
const Change nothing = [](Stand&) {};

double reads(const Held& held, double at_s, const Unlisted& unlisted, const Change& change = nothing) {
    Stand effects = blind::no_effects();
    change(effects);
    return blind::respond(lagging, effects, unlisted, held, std::vector{at_s}, 0.001).front();
}
double first_order(double t) { return t > 0.0 ? 1.0 - std::exp(-t / 0.5) : 0.0; }

// The root of a function that rises, by halving.
double root_of(const std::function<double(double)>& f) {
    double low = 0.0;
    double high = 2.0;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0.0 ? low : high) = middle;
    }
    return low;
}

TEST(BlindPlant, RestsWhereItsUnlistedForcesBalance) {
    const Held held = constant(0.8, 8.0);
    EXPECT_NEAR(reads(held, 8.0, {.near_gain = 0.4}),
                root_of([](double y) { return y - 0.8 * (1.0 + 0.4 * std::exp(-3.0 * y)); }), 1e-5);
    EXPECT_NEAR(reads(held, 8.0, {.cogging_force = 0.05, .cogging_per_unit = 9.0}),
                root_of([](double y) { return y + 0.05 * std::sin(9.0 * y) - 0.8; }), 1e-5);
    // Dahl's friction bends by 0.4 % of the full output before it slips: y + F (1 - e^(-y / bend)) = u.
    EXPECT_NEAR(reads(constant(0.03, 8.0), 8.0, {}, [](Stand& s) { s.friction = 0.05; }),
                root_of([](double y) { return y + 0.05 * (1.0 - std::exp(-y / 0.004)) - 0.03; }), 2e-5);
    // Each side has its own; coming down, friction holds it above.
    const Held down = two_levels(1.0, 4.0, 0.4, 12.0);
    EXPECT_NEAR(reads(down, 12.0, {}, [](Stand& s) { s.friction_down = 0.2; }), 0.6, 1e-4);
    EXPECT_NEAR(reads(down, 12.0, {}, [](Stand& s) { s.friction = 0.1; }), 0.5, 1e-4);
    EXPECT_NEAR(reads(down, 3.99, {}, [](Stand& s) { s.friction_up = 0.1; }), 0.9, 1e-3);
}

TEST(BlindPlant, BendsItsInputAsAsked) {
    EXPECT_NEAR(reads(two_levels(1.0, 4.0, 0.5, 12.0), 12.0, {.falling_gain = 0.2}), 0.4, 1e-5);
    EXPECT_NEAR(reads(two_levels(0.5, 4.0, 1.0, 12.0), 12.0, {.falling_gain = 0.2}), 1.0, 1e-5);
    // Play of 0.2 follows 0.1 below where it rises and 0.1 above where it falls.
    EXPECT_NEAR(reads(two_levels(1.0, 4.0, 0.5, 12.0), 12.0, {.hysteresis = 0.2}), 0.6, 1e-5);
    EXPECT_NEAR(reads(two_levels(0.5, 4.0, 1.0, 12.0), 12.0, {.hysteresis = 0.2}), 0.9, 1e-5);
    // At the threshold itself it starts; the dead zone ends at its width.
    EXPECT_NEAR(reads(constant(0.8, 8.0), 8.0, {}, [](Stand& s) { s.threshold = 0.8; }), 0.8, 1e-5);
    EXPECT_EQ(reads(constant(0.8, 8.0), 8.0, {}, [](Stand& s) { s.dead_zone = 0.9; }), 0.0);
    const Change bent = [](Stand& s) {
        s.thrust_curvature = 0.5;
        s.thrust_reference = 1.6;
        s.gain = 1.1;
    };
    EXPECT_NEAR(reads(constant(0.8, 8.0), 8.0, {}, bent), 1.1 * 0.8 * (0.5 + 0.5 * 0.8 / 1.6), 1e-5);
}

TEST(BlindPlant, DelaysSmallInputsMore) {
    const Unlisted slow_at_rest{.delay_at_rest_s = 0.5};
    EXPECT_NEAR(reads(constant(0.6, 3.0), 1.0, slow_at_rest), 0.6 * first_order(0.8), 1e-4);
    EXPECT_NEAR(reads(constant(1.0, 3.0), 1.0, slow_at_rest), first_order(1.0), 1e-4);
    // A later command that would come sooner waits for the one before.
    EXPECT_NEAR(reads(two_levels(0.2, 0.1, 1.0, 3.0), 1.0, slow_at_rest), first_order(0.6), 1e-4);
}

// (0.5 + g t) y' + y = 1 from rest: y = 1 - (1 + g t / 0.5)^(-1/g).
TEST(BlindPlant, IsDampedMoreAsTimeGoesOn) {
    for (const double t : {0.7, 1.5}) {
        EXPECT_NEAR(reads(constant(1.0, 3.0), t, {.damping_growth = 0.08}),
                    1.0 - std::pow(1.0 + 0.08 * t / 0.5, -1.0 / 0.08), 1e-4);
    }
}

// 0.5 v + d v^2 = 1 - y with v = y': 0.5 ln v + 2 d v falls by t.
TEST(BlindPlant, IsDraggedAsItsSpeedSquared) {
    constexpr double d = 0.05;
    const double first = (-0.5 + std::sqrt(0.25 + 4.0 * d)) / (2.0 * d);
    for (const double share : {0.7, 0.4, 0.1}) {
        const double v = share * first;
        const double t = 0.5 * std::log(first / v) + 2.0 * d * (first - v);
        EXPECT_NEAR(reads(constant(1.0, 8.0), t, {}, [](Stand& s) { s.drag = d; }), 1.0 - 0.5 * v - d * v * v, 2e-4);
    }
}

// A force h sin(w t) against 0.5 y' + y, from rest.
TEST(BlindPlant, HumsByItself) {
    const double w = 2.0 * std::numbers::pi * 0.7;
    const double h = 0.1;
    for (const double t : {0.3, 1.1, 2.9}) {
        const double swings =
            h / (1.0 + 0.25 * w * w) * (std::sin(w * t) - 0.5 * w * std::cos(w * t) + 0.5 * w * std::exp(-t / 0.5));
        EXPECT_NEAR(reads(constant(0.8, 3.0), t, {.hum_force = h, .hum_hz = 0.7}), 0.8 * first_order(t) - swings, 1e-4);
    }
}

// What is lost grows by the way times how hard the plant is driven, 1 - y here: to s (y - y^2 / 2).
TEST(BlindPlant, SlipsWhereItIsDrivenHard) {
    for (const double t : {0.5, 2.0}) {
        const double y = first_order(t);
        EXPECT_NEAR(reads(constant(1.0, 3.0), t, {.slip_per_unit = 0.3}), y - 0.3 * (y - 0.5 * y * y), 1e-3);
    }
    // As a share of the full input.
    blind::Plant larger = lagging;
    larger.full_input = 2.0;
    EXPECT_NEAR(
        blind::respond(larger, blind::no_effects(), {.slip_per_unit = 0.3}, constant(1.0, 8.0), std::vector{8.0}, 0.001)
            .front(),
        1.0 - 0.5 * 0.3 * 0.5, 1e-3);
}

TEST(BlindPlant, SwingsByItsOwnResonance) {
    const double w = 2.0 * std::numbers::pi * 1.5;
    const double damped = w * std::sqrt(0.99);
    for (const double t : {0.2, 0.9}) {
        const double swing =
            0.3 * (1.0 - std::exp(-0.1 * w * t) * (std::cos(damped * t) + 0.1 * w / damped * std::sin(damped * t)));
        EXPECT_NEAR(reads(constant(1.0, 3.0), t, {},
                          [](Stand& s) {
                              s.resonance_share = 0.3;
                              s.resonance_hz = 1.5;
                              s.resonance_damping = 0.1;
                          }),
                    first_order(t) + swing, 1e-3);
    }
}

TEST(BlindPlant, FollowsDownByTheLagForDown) {
    const Change two_lags = [](Stand& s) {
        s.tau_up_s = 0.05;
        s.tau_down_s = 0.2;
    };
    // From rest at 1 down: lags of 0.5 and 0.2 s in a row.
    const double t = 1.0;
    const double both = (0.5 * std::exp(-t / 0.5) - 0.2 * std::exp(-t / 0.2)) / 0.3;
    EXPECT_NEAR(reads(two_levels(1.0, 8.0, 0.0, 12.0), 8.0 + t, {}, two_lags), both, 1e-3);
}

TEST(BlindPlant, IsDisturbedFromAndTo) {
    const Change blown = [](Stand& s) {
        s.disturbance_size = 0.3;
        s.disturbance_from_s = 1.0;
        s.disturbance_to_s = 1.5;
    };
    for (const double t : {0.999, 1.2, 1.5, 2.5}) {
        EXPECT_NEAR(reads(constant(0.8, 3.0), t, {}, blown),
                    0.8 * first_order(t) - 0.3 * (first_order(t - 1.0) - first_order(t - 1.5)), 4e-4)
            << t;
    }
}

TEST(BlindPlant, LeansOnItsStopUntilItIsDrawnOff) {
    const Change stopped = [](Stand& s) { s.upper_stop_rad = 0.6; };
    const Held held = two_levels(1.0, 3.0, 0.3, 12.0);
    EXPECT_EQ(reads(held, 3.0, {}, stopped), 0.6);
    // It leaves from the stop, at once: from 0.6 towards 0.3.
    EXPECT_NEAR(reads(held, 3.5, {}, stopped), 0.3 + 0.3 * std::exp(-0.5 / 0.5), 2e-3);
}

// The charge that was taken, the load and time weaken the input, each by its share.
TEST(BlindPlant, WeakensAsItsSupplyDoes) {
    const double at_rest = reads(constant(0.8, 10.0), 10.0, {}, [](Stand& s) {
        s.battery_resistance = 0.25;
        s.sag_per_unit_s = 0.01;
        s.drift_per_s = 0.02;
    });
    // Of what acts 0.5 s ago, for the ramps are followed by a lag of that.
    const auto factor = [](double t) { return (1.0 + 0.02 * t) * (1.0 - 0.01 * 0.8 * t) * (1.0 - 0.25 * 0.8); };
    EXPECT_NEAR(at_rest, 0.8 * factor(9.5), 2e-4);
}

TEST(BlindPlant, IsReadBetweenItsNodes) {
    const Held held = constant(1.0, 3.0);
    for (const double t : {1.0, 1.00025, 1.0005, 1.0009}) {
        EXPECT_NEAR(reads(held, t, {}), first_order(t), 2e-6) << t;
    }
    EXPECT_EQ(reads(held, -0.5, {}), reads(held, 0.0, {}));
    EXPECT_EQ(blind::static_output(lagging, 0.3), 0.3);
}

TEST(BlindPlant, ThatRunsAwayIsRefused) {
    EXPECT_THROW((void)reads(constant(1.0, 8.0), 8.0, {.stiffening = -2.0}), glsum::Failure);
}

}  // namespace
