// One step of the equation of motion: closed forms where there are any, else the equation as its header has it, written
// out here.
#include "gap/drive/balance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using gap::Balance;
using gap::Scenario;

constexpr double mass = 3.0;
constexpr double constant = 0.8;
constexpr double step_s = 0.05;
constexpr double pi = std::numbers::pi;

double increment(const Scenario& scenario, double forcing, double known, double y) {
    return Balance(scenario, mass, constant, step_s).increment(forcing, known, y);
}

double unbalanced(const Scenario& scenario, double forcing, double derivatives, double y, double e) {
    return Balance(scenario, mass, constant, step_s).unbalanced(forcing, derivatives, y, e);
}

// The first e from 0 in the direction of miss(0) where it changes its sign, by small steps and halving.
template <class Miss>
double first_root(const Miss& miss) {
    const double way = miss(0.0) > 0.0 ? 1.0 : -1.0;
    double from = 0.0;
    while (miss(from + way * 1e-3) * way > 0.0) {
        from += way * 1e-3;
        if (std::fabs(from) > 100.0) {
            return NAN;
        }
    }
    double to = from + way * 1e-3;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (from + to);
        (miss(middle) * way > 0.0 ? from : to) = middle;
    }
    return to;
}

TEST(Balance, OfALinearModelIsOneDivision) {
    const Scenario scenario;
    EXPECT_DOUBLE_EQ(increment(scenario, 2.0, 0.3, 0.5), (2.0 - 0.3 - 0.4) / 3.8);
    EXPECT_DOUBLE_EQ(increment(scenario, -2.0, -0.3, 0.5), (-2.0 + 0.3 - 0.4) / 3.8);
    EXPECT_EQ(increment(scenario, 0.4, 0.0, 0.5), 0.0);
}

TEST(Balance, FrictionHoldsAndThenTakesItsPart) {
    Scenario scenario;
    scenario.forces.friction_up = 0.5;
    scenario.forces.friction_down = 0.2;
    // What pushes is forcing - known - 0.8 y.
    EXPECT_EQ(increment(scenario, 0.89, 0.0, 0.5), 0.0);
    EXPECT_NEAR(increment(scenario, 0.91, 0.0, 0.5), 0.01 / 3.8, 1e-14);
    EXPECT_EQ(increment(scenario, 0.21, 0.0, 0.5), 0.0);
    EXPECT_NEAR(increment(scenario, 0.19, 0.0, 0.5), -0.01 / 3.8, 1e-14);
    // Without friction in the other direction it gives way there.
    scenario.forces.friction_up = 0.0;
    EXPECT_NEAR(increment(scenario, 0.41, 0.0, 0.5), 0.01 / 3.8, 1e-14);
    EXPECT_EQ(increment(scenario, 0.39, 0.0, 0.5), 0.0);
    scenario.forces = {};
    scenario.forces.friction_up = 0.5;
    EXPECT_NEAR(increment(scenario, 0.39, 0.0, 0.5), -0.01 / 3.8, 1e-14);
    EXPECT_EQ(increment(scenario, 0.41, 0.0, 0.5), 0.0);
}

TEST(Balance, FrictionOfTheLoadIsAShareOfWhatDrivesAndRestores) {
    Scenario scenario;
    scenario.forces.friction_share = 0.25;
    scenario.forces.friction_up = 0.1;
    scenario.forces.friction_down = 0.3;
    // Up: f - k - 3 e - 0.8 (y + e) = 0.1 + 0.25 (f + 0.8 (y + e)).
    EXPECT_NEAR(increment(scenario, 3.0, 0.2, 0.5), (3.0 - 0.2 - 0.4 - 0.1 - 0.25 * 3.4) / (3.8 + 0.2), 1e-12);
    // Down, where the load falls: f - k - 3 e - 0.8 (y + e) = -0.3 - 0.25 (f + 0.8 (y + e)), and f is 0.2.
    EXPECT_NEAR(increment(scenario, 0.2, 1.0, 0.5), (0.2 - 1.0 - 0.4 + 0.3 + 0.25 * 0.6) / (3.8 - 0.2), 1e-12);
    // Both signs of what drives and restores load it alike.
    EXPECT_NEAR(increment(scenario, -3.0, 0.2, -0.5), (-3.0 - 0.2 + 0.4 + 0.3 + 0.25 * 3.4) / (3.8 + 0.2), 1e-12);
    // It holds as far: at 0.1 + 0.25 (|f| + 0.4) upwards, f - 0.4 = 0.1 + 0.25 f + 0.1 where f = 0.8.
    EXPECT_EQ(increment(scenario, 0.799, 0.0, 0.5), 0.0);
    EXPECT_GT(increment(scenario, 0.801, 0.0, 0.5), 0.0);
    // Downwards where 0.4 - f = 0.3 + 0.25 f + 0.1: at once for f below 0.
    EXPECT_EQ(increment(scenario, 0.001, 0.0, 0.5), 0.0);
    EXPECT_LT(increment(scenario, -0.001, 0.0, 0.5), 0.0);
    // Alone it holds, too.
    scenario.forces.friction_up = scenario.forces.friction_down = 0.0;
    EXPECT_EQ(increment(scenario, 0.41, 0.0, 0.5), 0.0);
}

TEST(Balance, FrictionOfASpeedFollowsItsSign) {
    Scenario scenario;
    scenario.forces.friction_of_speed = true;
    scenario.forces.friction_up = 0.5;
    scenario.forces.friction_down = 0.2;
    scenario.operating_output = 0.1;
    // A speed of 0.6 stays one: against it, whichever way it changes.
    EXPECT_NEAR(increment(scenario, 1.4, 0.0, 0.5), (1.4 - 0.4 - 0.5) / 3.8, 1e-14);
    EXPECT_NEAR(increment(scenario, 0.4, 0.0, 0.5), (0.4 - 0.4 - 0.5) / 3.8, 1e-14);
    EXPECT_NEAR(increment(scenario, -1.4, 0.0, -0.5), (-1.4 + 0.4 + 0.2) / 3.8, 1e-14);
    // A speed of 0.01 that either friction would turn ends at rest.
    EXPECT_NEAR(increment(scenario, 0.0, 0.0, -0.09), -0.01, 1e-14);
    // Turned by force: with the friction of the other direction.
    EXPECT_NEAR(increment(scenario, -9.0, 0.0, -0.09), (-9.0 + 0.072 + 0.2) / 3.8, 1e-14);
    EXPECT_NEAR(increment(scenario, 9.0, 0.0, -0.11), (9.0 + 0.088 - 0.5) / 3.8, 1e-14);
}

TEST(Balance, DragGrowsWithTheSquare) {
    Scenario scenario;
    scenario.forces.drag = 0.02;
    const double drag = 0.02 / (step_s * step_s);
    for (const double net : {4.0, -4.0}) {
        // 3.8 e + drag e |e| = net
        const double size = (-3.8 + std::sqrt(3.8 * 3.8 + 4.0 * drag * 4.0)) / (2.0 * drag);
        EXPECT_NEAR(increment(scenario, net + 0.4, 0.0, 0.5), std::copysign(size, net), 1e-12);
    }
    EXPECT_EQ(increment(scenario, 0.4, 0.0, 0.5), 0.0);
}

TEST(Balance, SpringsThatBendAreSolvedWhereTheStepEnds) {
    for (const double forcing : {2.5, -1.7}) {
        for (const double y : {0.6, -0.9}) {
            Scenario cubic;
            cubic.forces.cubic = 0.7;
            EXPECT_NEAR(increment(cubic, forcing, 0.3, y), first_root([&](double e) {
                            const double at = y + e;
                            return forcing - 0.3 - mass * e - constant * (at + 0.7 * at * at * at);
                        }),
                        1e-11);
            Scenario pendulum;
            pendulum.forces.angle_per_unit = 1.3;
            pendulum.forces.cubic = 0.2;
            EXPECT_NEAR(increment(pendulum, forcing, 0.3, y), first_root([&](double e) {
                            const double at = y + e;
                            return forcing - 0.3 - mass * e -
                                   constant * (std::sin(1.3 * at) / 1.3 + 0.2 * at * at * at);
                        }),
                        1e-11);
            // The power 1 + c of |y| / r + 0.01, less what it is at 0, about the operating point 0.4.
            Scenario outflow;
            outflow.forces.outflow = gap::Outflow{0.6, 2.0};
            outflow.forces.cubic = 0.1;
            outflow.operating_output = 0.4;
            const auto bent = [](double level) {
                const double flow = std::pow(std::fabs(level) / 2.0 + 0.01, 1.6) - std::pow(0.01, 1.6);
                return std::copysign(2.0 * flow / (std::pow(1.01, 1.6) - std::pow(0.01, 1.6)), level);
            };
            Scenario braked;  // a speed, by drag
            braked.forces.drag_of_speed = 0.7;
            braked.operating_output = 0.4;
            EXPECT_NEAR(increment(braked, forcing, 0.3, y), first_root([&](double e) {
                            const double at = y + e + 0.4;
                            return forcing - 0.3 - mass * e - constant * (y + e) -
                                   0.7 * (at * std::fabs(at) - 0.4 * 0.4);
                        }),
                        1e-11);
            EXPECT_NEAR(increment(outflow, forcing, 0.3, y), first_root([&](double e) {
                            const double at = y + e;
                            return forcing - 0.3 - mass * e -
                                   constant * (bent(at + 0.4) - bent(0.4) + 0.1 * at * at * at);
                        }),
                        1e-11);
        }
    }
}

// A spring that softens under friction of the load.
TEST(Balance, FrictionOfTheLoadFollowsTheSpring) {
    Scenario scenario;
    scenario.forces.friction_share = 0.3;
    scenario.forces.angle_per_unit = 1.1;
    const auto spring = [](double at) { return constant * std::sin(1.1 * at) / 1.1; };
    for (const double y : {0.7, -0.7}) {
        for (const double forcing : {4.0, -4.0}) {
            const double way = forcing > 0.0 ? 1.0 : -1.0;
            EXPECT_NEAR(increment(scenario, forcing, 0.1, y), first_root([&](double e) {
                            return forcing - 0.1 - mass * e - spring(y + e) -
                                   way * 0.3 * (4.0 + std::fabs(spring(y + e)));
                        }),
                        1e-11);
        }
    }
}

TEST(Balance, CoggingIsLockedToThePlace) {
    Scenario scenario;
    scenario.operating_output = 0.2;
    scenario.forces.cogging = {{0.4, 0.9, 0.5, false}, {0.1, 2.1, -0.3, false}};
    for (const double forcing : {1.5, -1.1}) {
        EXPECT_NEAR(increment(scenario, forcing, 0.1, 0.5), first_root([&](double e) {
                        const double at = 0.5 + e + 0.2;
                        return forcing - 0.1 - mass * e - constant * (0.5 + e) +
                               0.4 * std::sin(2.0 * pi * 0.9 * at + 0.5) + 0.1 * std::sin(2.0 * pi * 2.1 * at - 0.3);
                    }),
                    1e-11);
    }
}

TEST(Balance, CoggingOfASpeedIsLockedToItsIntegral) {
    Scenario scenario;
    scenario.operating_output = 0.2;
    scenario.forces.cogging = {{1.4, 6.0, 0.5, true}};
    Balance balance(scenario, mass, constant, step_s);
    double travelled = 0.0;
    double y = 0.5;
    for (int k = 0; k < 20; ++k) {
        const double forcing = 3.0 - 0.2 * k;
        const double e = balance.increment(forcing, 0.1, y);
        EXPECT_NEAR(e, first_root([&](double by) {
                        const double at = travelled + step_s * (y + 0.2 + 0.5 * by);
                        return forcing - 0.1 - mass * by - constant * (y + by) +
                               1.4 * std::sin(2.0 * pi * 6.0 * at + 0.5);
                    }),
                    1e-11);
        balance.advance(y, e);
        travelled += step_s * (y + 0.2 + 0.5 * e);
        y += e;
    }
}

// Behind a sine's top the force gives way, and the balance lies farther off than its slope says; without inertia and
// beyond what the sine can hold there is none.
TEST(Balance, ThatGivesWayIsFoundFartherOff) {
    Scenario scenario;
    scenario.forces.angle_per_unit = 1.0;
    const double light = 0.05;
    const auto miss = [&](double e) { return 0.9 - light * e - std::sin(1.2 + e); };
    EXPECT_NEAR(Balance(scenario, light, 1.0, step_s).increment(1.0, 0.1, 1.2),
                std::sin(1.2) > 0.9 ? first_root(miss) : NAN, 1e-11);
    EXPECT_NEAR(Balance(scenario, light, 1.0, step_s).increment(0.95, 0.0, 1.2),
                first_root([&](double e) { return 0.95 - light * e - std::sin(1.2 + e); }), 1e-11);
    EXPECT_TRUE(std::isnan(Balance(scenario, 0.0, 1.0, step_s).increment(1.5, 0.0, 1.2)));
}

// A motion of even increments that goes over into one with these forces.
TEST(Balance, WhatNothingBalancesIsWithoutTheFrictionOnTheWay) {
    Scenario scenario;
    EXPECT_NEAR(unbalanced(scenario, 2.0, 0.3, 0.5, 0.1), 2.0 - 0.3 - 0.4, 1e-14);
    scenario.forces.friction_up = 0.5;
    scenario.forces.friction_down = 0.2;
    EXPECT_NEAR(unbalanced(scenario, 2.0, 0.3, 0.5, 0.1), 1.3 - 0.5, 1e-14);
    EXPECT_NEAR(unbalanced(scenario, 2.0, 0.3, 0.5, -0.1), 1.3 + 0.2, 1e-14);
    // At rest what friction does not hold.
    EXPECT_NEAR(unbalanced(scenario, 1.0, 0.0, 0.5, 0.0), 0.1, 1e-14);
    EXPECT_EQ(unbalanced(scenario, 0.8, 0.0, 0.5, 0.0), 0.0);
    EXPECT_EQ(unbalanced(scenario, 0.3, 0.0, 0.5, 0.0), 0.0);
    EXPECT_NEAR(unbalanced(scenario, 0.1, 0.0, 0.5, 0.0), -0.1, 1e-14);
    scenario.forces.friction_share = 0.25;  // of 2 + 0.4
    EXPECT_NEAR(unbalanced(scenario, 2.0, 0.3, 0.5, 0.1), 1.3 - 0.5 - 0.6, 1e-14);
    EXPECT_NEAR(unbalanced(scenario, 2.0, 0.3, 0.5, -0.1), 1.3 + 0.2 + 0.6, 1e-14);
    // Of a speed: against its sign, whichever way it changes.
    scenario.forces.friction_share = 0.0;
    scenario.forces.friction_of_speed = true;
    scenario.operating_output = 0.1;
    EXPECT_NEAR(unbalanced(scenario, 2.0, 0.3, 0.5, -0.1), 1.3 - 0.5, 1e-14);
    EXPECT_NEAR(unbalanced(scenario, 2.0, 0.3, -0.5, 0.1), 2.1 + 0.2, 1e-14);
    EXPECT_EQ(unbalanced(scenario, 0.1, 0.0, -0.1, 0.3), 0.0);
    // Cogging and a bent spring are those of the place.
    Scenario bent;
    bent.operating_output = 0.2;
    bent.forces.cubic = 0.7;
    bent.forces.cogging = {{0.4, 0.9, 0.5, false}};
    EXPECT_NEAR(unbalanced(bent, 2.0, 0.3, 0.5, 0.1),
                1.7 - constant * (0.5 + 0.7 * 0.125) + 0.4 * std::sin(2.0 * pi * 0.9 * 0.7 + 0.5), 1e-14);
}

}  // namespace
