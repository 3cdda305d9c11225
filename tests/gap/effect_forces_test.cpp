// Forces of effects against a plain integration of the equation of motion in steps a hundred times as fine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/gap/effect_case.hpp"

namespace {

using effect_test::h;
using effect_test::largest_difference;
using effect_test::staircase;
using effect_test::Values;
using effect_test::with;

// --- Forces: m y'' + c y' + restoring(y) + drag y' |y'| + friction = w.

struct Truth {
    std::function<double(double y)> restoring = [](double y) { return y; };
    double drag = 0.0;
    double friction_up = 0.0;
    double friction_down = 0.0;
    double friction_share = 0.0;  // of |w| + |restoring|
    std::function<double(double t)> push = [](double) { return 0.0; };
    double limit = INFINITY;
    double restitution = 0.0;
    double from = 0.0;  // it is released here
    double damping = 0.6;
};
constexpr double mass = 0.25;
constexpr double damping = 0.6;

// By the midpoint rule, a hundred steps to an interval.
Values integrated(const Truth& truth, const gap::Record& record) {
    constexpr int steps = 100;
    const double dt = h / steps;
    Values outputs;
    double y = truth.from;
    double v = 0.0;
    for (std::size_t k = 0; k < record.size(); ++k) {
        outputs.push_back(y);
        for (int i = 0; i < steps; ++i) {
            const double t = record.time_s[k] + (i + 0.5) * dt;
            const double w = record.input[k] + truth.push(t);
            const auto acceleration = [&](double at, double speed) {
                const double load = truth.friction_share * (std::fabs(w) + std::fabs(truth.restoring(at)));
                const double friction = speed > 0.0   ? truth.friction_up + load
                                        : speed < 0.0 ? -truth.friction_down - load
                                                      : 0.0;
                return (w - truth.damping * speed - truth.restoring(at) - truth.drag * speed * std::fabs(speed) -
                        friction) /
                       mass;
            };
            if (v == 0.0) {  // does it break loose?
                const double net = w - truth.restoring(y);
                const double load = truth.friction_share * (std::fabs(w) + std::fabs(truth.restoring(y)));
                if (net <= truth.friction_up + load && net >= -truth.friction_down - load &&
                    (truth.friction_up > 0.0 || truth.friction_down > 0.0 || load > 0.0)) {
                    continue;
                }
                v = (net > 0.0 ? 1.0 : -1.0) * 1e-12;
            }
            const double half_v = v + 0.5 * dt * acceleration(y, v);
            const double half_y = y + 0.5 * dt * v;
            const double next = v + dt * acceleration(half_y, half_v);
            y += dt * half_v;
            const bool rubs = truth.friction_up > 0.0 || truth.friction_down > 0.0 || truth.friction_share > 0.0;
            v = v * next < 0.0 && rubs ? 0.0 : next;
            if (y > truth.limit) {
                y = truth.limit;
                v = -truth.restitution * std::max(0.0, v);
            }
        }
    }
    return outputs;
}

// What is off with the effect at its values, and with its first value 1 % larger: a formula that is off by as much is
// seen.
void expect_truth(const std::string& name, Values values, const Truth& truth, double within) {
    const gap::Record record = staircase();
    gap::Scenario plant;
    plant.model.denominator = {{mass, 2.0}, {damping, 1.0}, {1.0, 0.0}};
    const gap::Course course(record, 8);
    const Values wanted = integrated(truth, record);
    EXPECT_GT(largest_difference(gap::simulate(plant, course), wanted), 20.0 * within) << name;
    EXPECT_LT(largest_difference(gap::simulate(with(name, values, plant), course), wanted), within) << name;
    values[0] *= 1.01;
    EXPECT_GT(largest_difference(gap::simulate(with(name, values, plant), course), wanted), within) << name;
}

TEST(EffectForces, AreThoseOfTheEquationOfMotion) {
    Truth drag;
    drag.drag = 1.5;
    expect_truth("quadratic_drag", {1.5, 0.0}, drag, 4e-4);
    Truth of_speed;  // the output is one
    of_speed.restoring = [](double y) { return y + 0.8 * y * std::fabs(y); };
    expect_truth("quadratic_drag", {0.8, 1.0}, of_speed, 4e-4);
    Truth gravity;
    gravity.restoring = [](double y) { return std::sin(1.1 * y) / 1.1; };
    expect_truth("gravity_nonlinearity", {1.1}, gravity, 4e-4);
    Truth outflow;
    for (const double curvature : {0.4, -0.5}) {
        outflow.restoring = [=](double y) {
            const double p = 1.0 + curvature;
            const double flow =
                (std::pow(std::fabs(y) / 0.9 + 0.01, p) - std::pow(0.01, p)) / (std::pow(1.01, p) - std::pow(0.01, p));
            return std::copysign(0.9 * flow, y);
        };
        expect_truth("output_curve", {curvature, 0.9, 1.0}, outflow, 4e-4);
    }
    Truth friction;
    friction.friction_up = friction.friction_down = 0.12;
    expect_truth("coulomb_friction", {0.12, 0.0}, friction, 6e-4);
    friction.friction_up = 0.15;
    friction.friction_down = 0.05;
    expect_truth("direction_dependent_friction", {0.15, 0.05, 0.0}, friction, 6e-4);
    friction.friction_up = 0.05;
    friction.friction_down = 0.15;
    expect_truth("direction_dependent_friction", {0.05, 0.15, 0.0}, friction, 4e-4);
    Truth pushed;
    pushed.push = [](double t) { return t >= 3.0 && t < 3.9 ? -0.35 : 0.0; };
    expect_truth("load_disturbance", {3.0, 3.9, -0.35}, pushed, 4e-4);
    Truth stopped;
    stopped.limit = 0.7;
    expect_truth("end_stop", {0.7, 0.0, 0.0, 0.0}, stopped, 1e-3);
    Truth stiffening;
    stiffening.restoring = [](double y) { return y + 1.4 * y * y * y; };
    expect_truth("cubic_stiffness", {1.4}, stiffening, 4e-4);
    Truth cogged;
    cogged.restoring = [](double y) { return y - 0.06 * std::sin(2.0 * std::numbers::pi * 2.0 * y + 0.5); };
    expect_truth("cogging", {0.06, 2.0, 0.5, 0.0}, cogged, 4e-4);
    Truth loaded;
    loaded.friction_share = 0.08;
    expect_truth("load_dependent_friction", {0.08}, loaded, 6e-4);
}

gap::Record without_input() {
    gap::Record record = staircase();
    std::fill(record.input.begin(), record.input.end(), 0.0);
    return record;
}

TEST(EffectForces, SwingThroughMoreThanAQuarterTurn) {
    const gap::Record record = without_input();
    gap::Scenario plant;
    plant.model.denominator = {{mass, 2.0}, {0.05, 1.0}, {1.0, 0.0}};
    plant.initial_output = 2.36;  // 135 degrees
    Truth swing;
    swing.from = 2.36;
    swing.damping = 0.05;
    swing.restoring = [](double y) { return std::sin(y); };
    const gap::Scenario swinging = with("gravity_nonlinearity", {1.0}, plant);
    const Values wanted = integrated(swing, record);
    EXPECT_LT(largest_difference(gap::simulate(swinging, gap::Course(record, 8)), wanted), 5e-5);
    // On a grid on which a weight upside down would give way faster than its inertia holds it, it still swings.
    gap::Record coarse = record;
    coarse.usual_interval_s = 1.2;
    const Values found = gap::simulate(swinging, gap::Course(coarse, 1));
    for (const double y : found) {
        ASSERT_LE(std::fabs(y), 2.4);
    }
}

// --- Where the output is a speed: m y' + y + friction = w.

struct SpeedTruth {
    double friction_up = 0.0;
    double friction_down = 0.0;
    double cogging = 0.0;
    double per_unit = 0.0;
};

Values integrated(const SpeedTruth& truth, const gap::Record& record) {
    constexpr int steps = 200;
    const double dt = h / steps;
    Values outputs;
    double y = 0.0;
    double place = 0.0;
    for (std::size_t k = 0; k < record.size(); ++k) {
        outputs.push_back(y);
        for (int i = 0; i < steps; ++i) {
            const double w =
                record.input[k] + truth.cogging * std::sin(2.0 * std::numbers::pi * truth.per_unit * place + 0.3);
            const bool rubs = truth.friction_up > 0.0;
            const double sign = y > 0.0 || (y == 0.0 && w > 0.0) ? 1.0 : -1.0;
            const double friction = sign > 0.0 ? truth.friction_up : truth.friction_down;
            if (rubs && y == 0.0 && std::fabs(w) <= friction) {
                continue;
            }
            const double next = y + dt * (w - y - sign * friction) / 0.5;
            place += 0.5 * dt * (y + next);
            y = rubs && y * next < 0.0 ? 0.0 : next;
        }
    }
    return outputs;
}

TEST(EffectForces, OfASpeedActAgainstItAndGoWithItsIntegral) {
    gap::Record record = staircase();
    for (std::size_t k = 0; k < record.size(); ++k) {
        record.input[k] = k < 200 ? 0.4 : k < 350 ? 1.0 : k < 550 ? -0.06 : -0.7;
    }
    gap::Scenario plant;
    plant.model.denominator = {{0.5, 1.0}, {1.0, 0.0}};
    const gap::Course course(record, 8);
    SpeedTruth rubbing;
    rubbing.friction_up = rubbing.friction_down = 0.15;
    const Values sticks = gap::simulate(with("coulomb_friction", {0.15, 1.0}, plant), course);
    EXPECT_LT(largest_difference(sticks, integrated(rubbing, record)), 1e-3);
    EXPECT_EQ(sticks[540], 0.0);  // it stands, and the input does not overcome it
    rubbing.friction_down = 0.05;
    const Values uneven = gap::simulate(with("direction_dependent_friction", {0.15, 0.05, 1.0}, plant), course);
    EXPECT_LT(largest_difference(uneven, integrated(rubbing, record)), 1e-3);
    EXPECT_GT(largest_difference(uneven, sticks), 0.05);
    SpeedTruth cogged;
    cogged.cogging = 0.1;
    cogged.per_unit = 1.5;
    const Values ripple = gap::simulate(with("cogging", {0.1, 1.5, 0.3, 1.0}, plant), course);
    // Of a first order, the node at which an input jumps is off by a third of a step.
    EXPECT_LT(largest_difference(ripple, integrated(cogged, record)), 1e-3);
    EXPECT_GT(largest_difference(ripple, gap::simulate(plant, course)), 0.02);
}

}  // namespace
