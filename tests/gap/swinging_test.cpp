// Plants that swing within a few readings, as a structure or a circuit that is logged at some ten times its frequency.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "gap/drive/audit.hpp"
#include "gap/drive/base/find.hpp"
#include "gap/drive/base/part.hpp"
#include "gap/drive/base/refined.hpp"
#include "gap/drive/candidate.hpp"
#include "gap/drive/simulate.hpp"
#include "gap/drive/start.hpp"

namespace {

constexpr double step_s = 0.002;
constexpr double noise = 0.01;

struct Mode {
    double gain;
    double hz;
    double damping;
};

// Modes side by side under a random telegraph input, each exact from reading to reading: about its end x turns and dies
// away.
gap::Record logged(const std::vector<Mode>& modes, std::size_t count, unsigned seed, double of_noise = noise) {
    gap::Record record;
    record.name = "swinging";
    record.usual_interval_s = step_s;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    double input = 1.0;
    std::vector<std::array<double, 2>> states(modes.size(), {0.0, 0.0});
    for (std::size_t i = 0; i < count; ++i) {
        double output = of_noise * normal(random);
        for (std::size_t m = 0; m < modes.size(); ++m) {
            output += states[m][0];
        }
        input = random() % 5 == 0 ? -input : input;
        record.time_s.push_back(step_s * static_cast<double>(i));
        record.input.push_back(input);
        record.output.push_back(output);
        for (std::size_t m = 0; m < modes.size(); ++m) {
            const double omega = 2.0 * std::numbers::pi * modes[m].hz;
            const double decay = modes[m].damping * omega;
            const double turning = omega * std::sqrt(1.0 - modes[m].damping * modes[m].damping);
            const double x = states[m][0] - modes[m].gain * input;
            const double y = (states[m][1] + decay * x) / turning;
            const double left = std::exp(-decay * step_s);
            const double c = std::cos(turning * step_s);
            const double s = std::sin(turning * step_s);
            states[m][0] = modes[m].gain * input + left * (c * x + s * y);
            states[m][1] = left * (-decay * (c * x + s * y) + turning * (c * y - s * x));
        }
    }
    return record;
}

constexpr Mode oscillator{2.0, 55.0, 0.03};  // nine readings to a swing
constexpr double omega = 2.0 * std::numbers::pi * oscillator.hz;
constexpr double a_1 = 2.0 * oscillator.damping / omega;
constexpr double a_2 = 1.0 / (omega * omega);

double number(const drive::Form& form, const std::string& name) {
    for (const drive::Parameter& parameter : form.parameters()) {
        if (parameter.name == name) {
            return parameter.value;
        }
    }
    return std::nan("");
}

// Second differences of a sine at nine readings a period are 0.47 of it, and would tell a noise of 0.19 of it. Where
// they tell of noise, they are what is told.
TEST(Swinging, IsNoNoise) {
    gap::Record record = logged({}, 3000, 1, noise);
    const std::vector<double> of_noise = record.output;
    const double told = gap::audit({record}).noise;
    EXPECT_NEAR(told, noise, 0.05 * noise);
    for (const double size : {0.01, 1.0}) {
        for (std::size_t i = 0; i < record.size(); ++i) {
            record.output[i] = of_noise[i] + size * std::sin(omega * record.time_s[i]);
        }
        EXPECT_NEAR(gap::audit({record}).noise, noise, 0.1 * noise);
    }
}

// A sine of 0.3 from reading to reading takes two nodes, 0.15 apart.
TEST(Swinging, NodesLieSoFarApart) {
    gap::Record record = logged({}, 1257, 1, 0.0);
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.output[i] = std::sin(0.3 * static_cast<double>(i));
    }
    const gap::Part part = gap::part_of(record);
    EXPECT_EQ(part.record.size(), 1257U);
    EXPECT_NEAR(part.per_interval, 2.0, 0.005);
}

TEST(Swinging, IsLookedAtInItsBeginning) {
    const gap::Record record = logged({oscillator}, 4000, 2);
    const gap::Part part = gap::part_of(record);
    // 2 pi / 9.09 from reading to reading, at most 0.15 from node to node; 3000 nodes.
    EXPECT_NEAR(part.per_interval, 2.0 * std::numbers::pi * oscillator.hz * step_s / 0.15, 0.3);
    EXPECT_NEAR(static_cast<double>(part.record.size()) * part.per_interval, 3000.0, 2.0 * part.per_interval);
    EXPECT_EQ(part.record.time_s.front(), 0.0);
    // What is slow is looked at as a whole, in 1500 nodes, and what is short, too.
    const gap::Record slow = logged({{2.0, 0.5, 0.7}}, 4000, 2);
    EXPECT_EQ(gap::part_of(slow).record.size(), 4000U);
    EXPECT_EQ(gap::part_of(slow).per_interval, 1500.0 / 4000.0);
    const gap::Record little = logged({oscillator}, 300, 2);
    EXPECT_EQ(gap::part_of(little).record.size(), 300U);
    EXPECT_GT(gap::part_of(little).per_interval, 2.0);
    // However quick, no more than eight.
    EXPECT_EQ(gap::part_of(logged({{2.0, 120.0, 0.01}}, 4000, 2)).per_interval, 8.0);
    // Noise is no swing.
    EXPECT_EQ(gap::part_of(logged({{2.0, 0.5, 0.7}}, 4000, 2, 0.3)).per_interval, 1500.0 / 4000.0);
}

// From a tenth off in frequency and a half in damping, in noise.
TEST(Swinging, StartsAreRefinedUntilNoiseDoesNotBendThem) {
    gap::Coefficients start;
    start.denominator = {0.5 * a_1, 1.2 * a_2};
    const auto found = gap::refined(*gap::structure_named("second_order"), {logged({oscillator}, 1500, 3, 0.1)}, start);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->denominator[0], a_1, 0.05 * a_1);
    EXPECT_NEAR(found->denominator[1], a_2, 0.003 * a_2);
    EXPECT_NEAR(found->gain, oscillator.gain, 0.03 * oscillator.gain);
    EXPECT_EQ(found->delay_s, 0.0);
    // A later input is another plant's.
    start.delay_s = 2.0 * step_s;
    gap::Record late = logged({oscillator}, 1500, 3, 0.0);
    for (std::size_t i = late.size(); i-- > 2;) {
        late.output[i] = late.output[i - 2];
    }
    const auto found_late = gap::refined(*gap::structure_named("second_order"), {late}, start);
    ASSERT_TRUE(found_late.has_value());
    EXPECT_NEAR(found_late->denominator[1], a_2, 0.003 * a_2);
    EXPECT_EQ(found_late->delay_s, 2.0 * step_s);
    // Two records have a past each: the second one begins in motion, about another level.
    gap::Record moving = logged({oscillator}, 1200, 4, 0.0);
    for (auto* values : {&moving.time_s, &moving.input, &moving.output}) {
        values->erase(values->begin(), values->begin() + 100);
    }
    for (double& z : moving.output) {
        z += 5.0;
    }
    start.delay_s = 0.0;
    const auto of_both =
        gap::refined(*gap::structure_named("second_order"), {logged({oscillator}, 800, 3, 0.0), moving}, start);
    ASSERT_TRUE(of_both.has_value());
    EXPECT_NEAR(of_both->denominator[0], a_1, 0.02 * a_1);
    EXPECT_NEAR(of_both->denominator[1], a_2, 0.001 * a_2);
}

// G = 1 / (1 + ..) - 0.4 / (1 + ..): two modes that a zero lies between.
TEST(Swinging, ModesSideBySideAreRefinedTogether) {
    const Mode first{1.0, 18.0, 0.01};
    const Mode second{-0.4, 60.0, 0.015};
    const auto lags = [](const Mode& mode) {
        const double rate = 2.0 * std::numbers::pi * mode.hz;
        return std::array<double, 2>{2.0 * mode.damping / rate, 1.0 / (rate * rate)};
    };
    const auto [p, q] = lags(first);
    const auto [r, s] = lags(second);
    const gap::Coefficients truth{
        0.6, {p + r, q + s + p * r, p * s + q * r, q * s}, {(r - 0.4 * p) / 0.6, (s - 0.4 * q) / 0.6}, 0.0};
    gap::Coefficients start = truth;
    start.denominator[1] *= 0.97;
    start.denominator[3] *= 0.9;
    start.numerator = {};
    const auto found = gap::refined(*gap::structure_named("two_modes"), {logged({first, second}, 2000, 5)}, start);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->gain, truth.gain, 0.05 * truth.gain);
    EXPECT_NEAR(found->denominator[1], truth.denominator[1], 0.002 * truth.denominator[1]);
    EXPECT_NEAR(found->denominator[3], truth.denominator[3], 0.005 * truth.denominator[3]);
    EXPECT_NEAR(found->numerator[1], truth.numerator[1], 0.1 * std::fabs(truth.numerator[1]));
}

TEST(Swinging, WhatHasNoSuchFilterIsNotRefined) {
    const gap::Record record = logged({oscillator}, 600, 6);
    gap::Coefficients start;
    start.denominator = {a_1, a_2};
    EXPECT_TRUE(gap::refined(*gap::structure_named("second_order"), {record}, start).has_value());
    EXPECT_FALSE(gap::refined(*gap::structure_named("integrator_second_order"), {record}, start).has_value());
    EXPECT_FALSE(gap::refined(*gap::structure_named("fractional_second_order"), {record}, start).has_value());
    start.denominator = {-a_1, a_2};  // grows
    EXPECT_FALSE(gap::refined(*gap::structure_named("second_order"), {record}, start).has_value());
    start.denominator = {a_1, 0.0};
    EXPECT_FALSE(gap::refined(*gap::structure_named("second_order"), {record}, start).has_value());
}

// At a node for each of nine readings the second-order steps swing 15 % too slowly, for 3 % of damping a wholly other
// response: the sketch that a fit begins on has more of them.
TEST(Swinging, IsSketchedOnAsManyNodesAsItTakes) {
    const gap::Record record = logged({oscillator}, 600, 7);
    gap::Scenario scenario;
    scenario.model.gain = oscillator.gain;
    scenario.model.denominator = {{a_2, 2.0}, {a_1, 1.0}, {1.0, 0.0}};
    const gap::Course fine = gap::make_course(record, scenario, 0.3 * noise);
    const double per_interval = record.usual_interval_s / fine.grid().step_s;
    EXPECT_EQ(per_interval, 8.0);
    const gap::Course sketch = gap::make_sketch(fine, record, 1, scenario, noise);
    EXPECT_GE(record.usual_interval_s / sketch.grid().step_s, 4.0);
}

// Some 6000 nodes of a record are enough to choose by: what is judged is fitted on all of it.
TEST(Swinging, IsSketchedInItsBeginning) {
    const auto prepared = [](const gap::Record& record) {
        drive::Model model;
        model.kind = drive::Kind::fotf;
        model.gain = oscillator.gain;
        model.denominator = {{a_2, 2.0}, {a_1, 1.0}, {1.0, 0.0}};
        return gap::prepare({gap::form_of(model), true, {record}, {record}, {}, gap::Metric::simulation, {}, 1});
    };
    const gap::Record record = logged({oscillator}, 2400, 10);
    const gap::Ground ground = prepared(record);
    const gap::Course& sketch = ground.sketch.courses.front();
    EXPECT_EQ(ground.study.courses.front().record().size(), 2400U);
    const double per_interval = record.usual_interval_s / sketch.grid().step_s;
    EXPECT_NEAR(static_cast<double>(sketch.record().size()), 6000.0 / per_interval, 2.0);
    EXPECT_EQ(ground.sketch.counts.front().size(), sketch.record().size());
    EXPECT_EQ(sketch.record().time_s.front(), 0.0);
    // Of fewer nodes it is all of it.
    EXPECT_EQ(prepared(logged({oscillator}, 500, 10)).sketch.courses.front().record().size(), 500U);
}

// Its base is an oscillator of its frequency, and nothing is missing.
TEST(Swinging, IsFoundAsWhatItIs) {
    const gap::Question question{gap::form_to_find(),
                                 true,
                                 {logged({oscillator}, 400, 8)},
                                 {logged({oscillator}, 300, 9)},
                                 {},
                                 gap::Metric::simulation,
                                 {},
                                 1};
    const std::vector<gap::Described> found = gap::find_base(question, [](const std::string&) {});
    EXPECT_EQ(found.front().name, "second_order");
    EXPECT_NEAR(number(found.front().form, "a2"), a_2, 0.003 * a_2);
    EXPECT_NEAR(number(found.front().form, "a1"), a_1, 0.05 * a_1);
    EXPECT_NEAR(number(found.front().form, "gain"), oscillator.gain, 0.02 * oscillator.gain);
}

}  // namespace
