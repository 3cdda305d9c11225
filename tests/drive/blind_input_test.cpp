// What reaches a blind case's plant: the mean of its input over the step around each node. A plant without memory, y =
// u, shows it, and so the closed forms hold to rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "drive/stand/blind/plant.hpp"

namespace {

namespace blind = stand::blind;
using blind::Held;
using blind::Unlisted;
using stand::Stand;

constexpr double step_s = 0.001;
constexpr double rounding = 1e-9;

// y = u, as late as `delay_s`
std::vector<double> seen(const Held& held, const std::function<void(Stand&)>& change, double delay_s = 0.0,
                         const Unlisted& unlisted = {}) {
    const blind::Plant rigid{
        .gain = 1.0, .terms = {{1.0, 0.0}}, .delay_s = delay_s, .full_input = 1.0, .full_output = 1.0};
    Stand effects = blind::no_effects();
    change(effects);
    std::vector<double> nodes;
    for (int k = 0; k <= 100; ++k) {
        nodes.push_back(k * step_s);
    }
    return blind::respond(rigid, effects, unlisted, held, nodes, step_s);
}

const Held one{{0.0, 0.1}, {1.0, 1.0}};
constexpr auto nothing = [](Stand&) {};

TEST(BlindInput, BeginsInTheMiddleOfItsFirstStep) {
    const auto y = seen(one, nothing);
    EXPECT_NEAR(y[0], 0.5, 1e-6);
    EXPECT_NEAR(y[1], 1.0, rounding);
}

// A change 0.3 of a step behind node 12 is seen by the last 0.2 of its step.
TEST(BlindInput, ChangesByTheShareOfTheStepThatIsLeft) {
    for (const auto& y : {seen(one, nothing, 0.0123), seen(one, [](Stand& s) { s.extra_delay_s = 0.0123; }),
                          seen({{0.0, 0.0123, 0.1}, {0.0, 1.0, 1.0}}, nothing)}) {
        EXPECT_NEAR(y[11], 0.0, rounding);
        EXPECT_NEAR(y[12], 0.2, 1e-6);
        EXPECT_NEAR(y[13], 1.0, rounding);
    }
}

TEST(BlindInput, RisesAndFallsAtItsRate) {
    const auto limited = [](Stand& s) { s.rate_per_s = 20.0; };
    const auto y = seen({{0.0, 0.06, 0.1}, {1.0, 0.2, 0.2}}, limited);
    for (int k = 1; k <= 100; ++k) {
        const double t = k * step_s;
        // Half of what is left of the ramp in the steps in which it begins or ends, at 0, 0.05, 0.06 and 0.1 s.
        const double corner = k == 50 ? -0.125 * 20.0 * step_s : k == 60 ? -0.125 * 20.0 * step_s : 0.0;
        const double ramp = t <= 0.05 ? 20.0 * t : t <= 0.06 ? 1.0 : 1.0 - 20.0 * (t - 0.06);
        EXPECT_NEAR(y[k], k == 100 ? 0.2 + 0.125 * 20.0 * step_s : ramp + corner, rounding) << k;
    }
}

TEST(BlindInput, LagsByItsMotor) {
    constexpr double tau = 0.02;
    const auto y = seen(one, [](Stand& s) { s.motor_tau_s = 0.02; });
    for (const int k : {1, 10, 50}) {
        const double from = (k - 0.5) * step_s;
        const double to = (k + 0.5) * step_s;
        EXPECT_NEAR(y[k], 1.0 - tau / step_s * (std::exp(-from / tau) - std::exp(-to / tau)), 1e-7) << k;
    }
}

TEST(BlindInput, IsWeakenedByTimeLoadAndCharge) {
    const auto drifting = seen(one, [](Stand& s) { s.drift_per_s = 2.0; });
    const auto sagging = seen(one, [](Stand& s) { s.sag_per_unit_s = 2.0; });
    const auto loaded = seen(one, [](Stand& s) { s.battery_resistance = 0.25; });
    for (const int k : {1, 10, 50}) {
        EXPECT_NEAR(drifting[k], 1.0 + 2.0 * k * step_s, rounding);     // at the middle of the step
        EXPECT_NEAR(sagging[k], 1.0 - 2.0 * (k + 0.5) * step_s, 1e-8);  // what was taken by its end
        EXPECT_NEAR(loaded[k], 0.75, rounding);
    }
}

TEST(BlindInput, IsWhatItsActuatorMakesOfIt) {
    const Held half{{0.0, 0.1}, {0.5, 0.5}};
    const auto rest = [&](const std::function<void(Stand&)>& change, const Unlisted& unlisted = {}) {
        return seen(half, change, 0.0, unlisted)[50];
    };
    EXPECT_NEAR(rest([](Stand& s) { s.gain = 1.25; }), 0.625, rounding);
    EXPECT_NEAR(rest([](Stand& s) { s.dead_zone = 0.125; }), 0.375, rounding);
    EXPECT_NEAR(rest([](Stand& s) { s.input_limit = 0.25; }), 0.25, rounding);
    EXPECT_NEAR(rest([](Stand& s) { s.threshold = 0.5; }), 0.5, rounding);
    EXPECT_NEAR(rest([](Stand& s) { s.threshold = 0.51; }), 0.0, rounding);
    EXPECT_NEAR(rest(nothing, {.hysteresis = 0.25}), 0.375, rounding);
    EXPECT_NEAR(rest(nothing, {.input_step = 0.2}), 0.6, rounding);  // 2.5 steps are rounded away from 0
}

// Behind the dead zone the curve: at its reference it changes nothing.
TEST(BlindInput, BendsBehindItsDeadZone) {
    const auto bent = [](Stand& s) {
        s.dead_zone = 0.25;
        s.thrust_curvature = 0.4;
        s.thrust_reference = 0.5;
    };
    EXPECT_NEAR(seen({{0.0, 0.1}, {0.75, 0.75}}, bent)[50], 0.5, rounding);
    EXPECT_NEAR(seen({{0.0, 0.1}, {0.5, 0.5}}, bent)[50], 0.25 * (0.6 + 0.4 * 0.5), rounding);
}

// A command at rest is late by all of the delay at rest, one at full input by none; none overtakes another.
TEST(BlindInput, IsLateByItsLevel) {
    const auto y = seen({{0.0, 0.01, 0.1}, {0.25, 1.0, 1.0}}, nothing, 0.004, {.delay_at_rest_s = 0.04});
    EXPECT_NEAR(y[33], 0.0, rounding);  // 4 + 30 ms, and in its wake the full input, due at 14
    EXPECT_NEAR(y[34], 0.5, 1e-6);
    EXPECT_NEAR(y[35], 1.0, rounding);
}

}  // namespace
