// Each effect against what it is said to do: stages against their formulae on signals where these have a closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "drive/response.hpp"
#include "tests/gap/effect_case.hpp"

namespace {

using effect_test::h;
using effect_test::largest_difference;
using effect_test::staircase;
using effect_test::Values;
using effect_test::with;

// --- Levels: what has no memory.

Values levels_after(const std::string& name, const Values& values, Values levels) {
    const gap::Scenario scenario = with(name, values);
    EXPECT_EQ(scenario.levels.size(), 1U) << name;
    scenario.levels.at(0)(levels);
    return levels;
}

void expect_near(const Values& found, const Values& wanted, double within = 1e-12) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], wanted[i], within) << i;
    }
}

TEST(EffectLevels, AreTheirFormulae) {
    const Values u{0.0, 0.3, -0.3, 0.8, -1.0, 2.0};
    expect_near(levels_after("gain_error", {1.5}, u), {0.0, 0.45, -0.45, 1.2, -1.5, 3.0});
    expect_near(levels_after("input_saturation", {0.7}, u), {0.0, 0.3, -0.3, 0.7, -0.7, 0.7});
    expect_near(levels_after("input_dead_zone", {0.5, -1.0}, u), {0.0, 0.0, 0.0, 0.3, -0.5, 1.5});
    expect_near(levels_after("input_dead_zone", {0.5, 0.2}, u), {0.0, 0.0, -0.1, 0.3, -0.8, 1.5});
    // u ((1 - c) + c |u| / r), c = 0.4, r = 2: 2 stays where it is.
    expect_near(levels_after("input_curve", {0.4, 2.0}, u), {0.0, 0.198, -0.198, 0.608, -0.8, 2.0});
}

TEST(EffectLevels, AnActuatorStartsBeyondItsThreshold) {
    const Values u{0.0, 0.3, 0.6, 0.3, 0.0, 0.3, -0.6};
    // Once it runs it runs on, till it is switched off; or it stops below the threshold.
    expect_near(levels_after("start_up_threshold", {0.5, 0.0, 0.0}, u), {0.0, 0.0, 0.6, 0.3, 0.0, 0.0, -0.6});
    expect_near(levels_after("start_up_threshold", {0.5, 1.0, 0.0}, u), {0.0, 0.0, 0.6, 0.0, 0.0, 0.0, -0.6});
    // Over a width of 0.4 about the threshold it runs in part: at 0.6 three quarters.
    expect_near(levels_after("start_up_threshold", {0.5, 1.0, 0.4}, {0.6, 0.5, 0.31, 0.7}),
                {0.45, 0.25, 0.31 * 0.025, 0.7});
}

TEST(EffectLevels, AHysteresisDragsAPlayAlong) {
    // The play is 0.2 wide on either side: 0, 0.1, 0.8, 0.8, 0.8, 0.2; half of w is that.
    expect_near(levels_after("input_hysteresis", {0.4, 0.5}, {0.0, 0.3, 1.0, 0.9, 0.7, 0.0}),
                {0.0, 0.2, 0.9, 0.85, 0.75, 0.1});
}

TEST(EffectLevels, AValveSticksForABandAndThenJumps) {
    // Band 0.4, jump 0.1: it slides 0.15 behind, goes on after a rest of u when that has moved by 0.1, and turns when
    // u has by 0.4.
    expect_near(levels_after("valve_stiction", {0.4, 0.1, 0.0}, {0.0, 0.2, 0.3, 0.5, 0.5, 0.55, 0.65, 0.4, 0.24, 0.0}),
                {0.0, 0.0, 0.15, 0.35, 0.35, 0.35, 0.5, 0.5, 0.39, 0.15});
    // Without a jump it is a play of the band, half of it on either side.
    expect_near(levels_after("valve_stiction", {0.4, 0.0, 0.0}, {0.1, 0.3, 1.0, 0.9, 0.5, 0.6}),
                {0.0, 0.1, 0.8, 0.8, 0.7, 0.7});
}

// --- Inputs: with memory, of a held level; each value is the mean over its interval.

Values held_after(const std::string& name, const Values& values, Values held) {
    const gap::Scenario scenario = with(name, values);
    EXPECT_EQ(scenario.input.size(), 1U) << name;
    const gap::Grid grid{0.0, h, held.size()};
    scenario.input.at(0)(held, grid);
    return held;
}

TEST(EffectInputs, OfAConstantAreTheirClosedForms) {
    constexpr std::size_t count = 400;
    const Values u(count, 0.8);
    Values lag;
    Values sag;
    Values drift;
    Values limited;
    for (std::size_t k = 0; k < count; ++k) {
        const double from = static_cast<double>(k) * h;
        const double to = from + h;
        const double middle = 0.5 * (from + to);
        // 0.8 (1 - e^(-t/tau)), tau = 0.3
        lag.push_back(0.8 * (1.0 - 0.3 * (std::exp(-from / 0.3) - std::exp(-to / 0.3)) / h));
        sag.push_back(0.8 * (1.0 - 0.25 * 0.8 * middle - 0.1 * 0.8));
        drift.push_back(0.8 * (1.0 + 0.07 * middle));
        // Rises by 0.53 a second, and is there within an interval.
        const double there = 0.8 / 0.53;
        const double rising = std::clamp(there - from, 0.0, h);
        limited.push_back((rising * 0.53 * (from + 0.5 * rising) + (h - rising) * 0.8) / h);
    }
    expect_near(held_after("actuator_lag", {0.3}, u), lag);
    expect_near(held_after("supply_sag", {0.25, 0.1}, u), sag);
    expect_near(held_after("gain_drift", {0.07}, u), drift);
    expect_near(held_after("rate_limit", {0.53}, u), limited, 1e-9);
    // A charge that is used up gives no more, and none of it comes back.
    EXPECT_EQ(held_after("supply_sag", {0.5, 0.0}, u).back(), 0.0);
    // Either sign draws charge.
    Values turned = u;
    std::fill(turned.begin() + 200, turned.end(), -0.8);
    EXPECT_NEAR(held_after("supply_sag", {0.25, 0.1}, turned).back(), -sag.back(), 1e-12);
}

// A mean between its neighbours is a change within the interval: it starts on its way there and then.
TEST(EffectInputs, OfALimitedRateGoOnFromWithinAnInterval) {
    // 0.2 an interval; the level changes after seven tenths of the second one, and back of the fifth.
    const Values exact = held_after("rate_limit", {0.2 / h}, {0.0, 0.3, 1.0, 1.0, 0.7, 0.0, 0.0});
    expect_near(exact, {0.0, 0.3 * 0.03, 0.16, 0.36, 0.7 * (0.46 + 0.07) + 0.3 * (0.6 - 0.03), 0.44, 0.24});
    // There within what is left of the interval: two thirds of it on the way.
    expect_near(held_after("rate_limit", {0.2 / h}, {0.0, 0.012, 0.04, 0.04}),
                {0.0, 0.3 * 0.04 * 2.0 / 3.0, 0.04, 0.04});
}

// A log that begins in motion begins with an actuator that is already somewhere.
TEST(EffectInputs, WithAMemoryBeginWhereTheInputWasBefore) {
    gap::Scenario moving;
    moving.input_before = 0.7;
    const gap::Scenario limited = with("rate_limit", {0.2 / h}, moving);
    Values held(4, 1.0);
    limited.input.at(0)(held, {0.0, h, held.size()});
    expect_near(held, {0.8, 0.5 * (0.5 * (0.9 + 1.0) + 1.0), 1.0, 1.0});
    const auto levels = [&](const char* name, const Values& values, Values u) {
        with(name, values, moving).levels.at(0)(u);
        return u;
    };
    // A play of 0.2 on either side holds 0.7 until 0.9 is passed, and 0.5 from below.
    expect_near(levels("input_hysteresis", {0.4, 1.0}, {0.8, 1.0, 0.6}), {0.7, 0.8, 0.8});
    expect_near(levels("valve_stiction", {0.4, 0.0, 0.0}, {0.8, 1.0, 0.7}), {0.7, 0.8, 0.8});
}

TEST(EffectInputs, OfARampWithAVaryingDelayAreLateByIt) {
    gap::Scenario plant;
    plant.model.delay_s = 0.3;
    const double depth_s = 0.2;
    const double rate = 2.0 * std::numbers::pi / 1.7;
    plant = with("variable_delay", {depth_s, 1.7, 0.6}, plant);
    const gap::Grid grid{0.0, 0.001, 5000};
    Values held;
    Values wanted;
    for (std::size_t k = 0; k < grid.count; ++k) {
        const double from = grid.at(k);
        const double to = grid.at(k + 1);
        held.push_back(0.25 * (from + to));
        // The mean of 0.5 (t - depth sin(rate (t + delay) + phase)) over the interval.
        const auto integral = [&](double t) {
            return 0.5 * (0.5 * t * t + depth_s / rate * std::cos(rate * (t + 0.3) + 0.6));
        };
        wanted.push_back((integral(to) - integral(from)) / grid.step_s);
    }
    plant.input.at(0)(held, grid);
    for (std::size_t k = 300; k < 4700; ++k) {
        ASSERT_NEAR(held[k], wanted[k], 2.5e-4) << k;  // half a step of the ramp; the delay makes 0.1 of it
    }
}

// --- Outputs: of a motion that is known.

Values read_after(const std::string& name, const Values& values, Values z, const Values& input = {},
                  gap::Scenario scenario = {}) {
    scenario = with(name, values, std::move(scenario));
    EXPECT_EQ(scenario.output.size(), 1U) << name;
    const gap::Grid grid{0.0, h, z.size()};
    const Values output = z;
    scenario.output.at(0)(z, {grid, input, output});
    return z;
}

TEST(EffectOutputs, AreTheirFormulae) {
    const Values y{0.0, 0.5, -0.5, 1.0, 2.0, -3.0};
    expect_near(read_after("sensor_offset", {0.2}, y), {0.2, 0.7, -0.3, 1.2, 2.2, -2.8});
    expect_near(read_after("sensor_drift", {0.5}, y), {0.0, 0.505, -0.49, 1.015, 2.02, -2.975});
    expect_near(read_after("sensor_saturation", {0.75}, y), {0.0, 0.5, -0.5, 0.75, 0.75, -0.75});
    expect_near(read_after("sensor_saturation", {-0.75}, y), {-0.75, -0.75, -0.75, -0.75, -0.75, -3.0});
    expect_near(read_after("sensor_magnitude", {1.0}, y), {0.0, 0.5, 0.5, 1.0, 2.0, 3.0});
    // y ((1 - c) + c |y| / r), c = -0.3, r = 2
    expect_near(read_after("output_curve", {-0.3, 2.0, 0.0}, y), {0.0, 0.6125, -0.6125, 1.15, 2.0, -2.55});
    // A gap of 1: half of it on either side.
    expect_near(read_after("backlash", {1.0}, {0.0, 0.4, 0.6, 2.0, 1.2, 0.5, -1.0}),
                {0.0, 0.0, 0.1, 1.5, 1.5, 1.0, -0.5});
}

TEST(EffectOutputs, LagsOfARampAreTheirClosedForms) {
    constexpr std::size_t count = 600;
    Values ramp;
    Values lagged;
    Values down;
    Values lagged_down;
    Values mean;
    for (std::size_t k = 0; k < count; ++k) {
        const double t = static_cast<double>(k) * h;
        ramp.push_back(0.7 * t);
        lagged.push_back(0.7 * (t - 0.4 + 0.4 * std::exp(-t / 0.4)));               // of a lag of 0.4 s
        mean.push_back(t < 0.25 ? 0.7 * t * t / (2.0 * 0.25) : 0.7 * (t - 0.125));  // over 0.25 s
        down.push_back(-0.7 * t);
        lagged_down.push_back(-0.7 * (t - 0.15 + 0.15 * std::exp(-t / 0.15)));
    }
    expect_near(read_after("sensor_lag", {0.4}, ramp), lagged, 1e-10);
    expect_near(read_after("direction_asymmetry", {0.4, 0.15}, ramp), lagged, 1e-10);
    expect_near(read_after("logger_filter", {0.25}, ramp), mean, 1e-10);
    expect_near(read_after("logger_filter", {0.0}, ramp), ramp);
    expect_near(read_after("direction_asymmetry", {0.4, 0.15}, down), lagged_down, 1e-10);
    expect_near(read_after("direction_asymmetry", {0.0, 0.15}, ramp), ramp);
}

// The mean over a window of a reading that goes from node to node by straight lines, and rested before.
TEST(EffectOutputs, AFilterIsTheMeanOverItsWindow) {
    const Values y{1.0, 3.0, 2.0, 6.0};
    // Half an interval: a quarter of each step is missing.
    expect_near(read_after("logger_filter", {0.5 * h}, y), {1.0, 2.5, 2.25, 5.0});
    // One and a half: the half before them, then trapezia.
    expect_near(read_after("logger_filter", {1.5 * h}, y),
                {1.0, (0.5 + 2.0) / 1.5, (1.25 + 2.5) / 1.5, (1.125 + 4.0) / 1.5});
    // Longer than the record: what rested counts.
    expect_near(read_after("logger_filter", {10.0 * h}, y), {1.0, 1.1, (8.0 + 4.5) / 10.0, (7.0 + 8.5) / 10.0});
}

TEST(EffectOutputs, AResonanceIsThatOfItsSecondOrderMode) {
    // Beside a plant of gain 2.5 (1/0.4) and a dead time of three nodes: share K (1 - the step response's decay).
    gap::Scenario plant;
    plant.model.denominator = {{0.5, 1.0}, {0.4, 0.0}};
    plant.model.delay_s = 3 * h;
    const double hz = 3.0;
    const double damping = 0.08;
    const double wn = 2.0 * std::numbers::pi * hz;
    const double wd = wn * std::sqrt(1.0 - damping * damping);
    Values wanted;
    Values of_speed;
    for (std::size_t k = 0; k < 500; ++k) {
        const double t = std::max(0.0, static_cast<double>(k) - 3.0) * h;
        const double q = 1.0 - std::exp(-damping * wn * t) * (std::cos(wd * t) + damping * wn / wd * std::sin(wd * t));
        wanted.push_back(0.2 * 2.5 * 0.8 * q);
        of_speed.push_back(-0.3 * 2.5 * 0.8 * wn / wd * std::exp(-damping * wn * t) * std::sin(wd * t));
    }
    const Values input(500, 0.8);
    expect_near(read_after("structural_resonance", {hz, damping, 0.2, 0.0}, Values(500, 0.0), input, plant), wanted,
                1e-10);
    expect_near(read_after("structural_resonance", {hz, damping, -0.3, 1.0}, Values(500, 0.0), input, plant), of_speed,
                1e-10);
    // Of a dead time between nodes: the straight line between both.
    plant.model.delay_s = 3.5 * h;
    const Values half = read_after("structural_resonance", {hz, damping, 0.2, 0.0}, Values(500, 0.0), input, plant);
    // The input of an interval is the mean of both sides: 1.5 intervals behind a jump it is whole.
    EXPECT_NEAR(half[250], 0.5 * (wanted[250] + wanted[249]), 1e-9);
}

// --- The logger.

TEST(EffectReadings, JumpAndStayAndAreRounded) {
    gap::Record record;
    record.time_s = {10.0, 10.1, 10.2, 10.3, 10.4};
    Values reading{0.12, 0.23, 0.34, 0.46, 0.58};
    with("missed_counts", {0.15, 0.5, 0.35, -0.2, 0.0, 9.0}).logger.at(0)(reading, record);
    expect_near(reading, {0.12, 0.23, 0.84, 0.96, 0.88});
    reading = {0.12, 0.23, 0.34, 0.46, -0.58};
    with("encoder_quantisation", {0.1}).logger.at(0)(reading, record);
    expect_near(reading, {0.1, 0.2, 0.3, 0.5, -0.6});
    // Beside a measured reading what lies within half a step of it is not missed, and what is more only by the rest.
    record.output = {0.1, 0.2, 0.3, 0.4, -0.6};
    reading = {0.12, 0.26, 0.24, 0.46, -0.5};
    with("encoder_quantisation", {0.1}).logger.at(0)(reading, record);
    expect_near(reading, {0.1, 0.21, 0.29, 0.41, -0.55});
}

// What lies behind the readings is none of them.
TEST(EffectReadings, AreAllThatIsChanged) {
    gap::Record record;
    record.time_s = {0.0, 0.1, 0.2, 0.3};
    record.output = {0.1, 0.1, 0.1, 0.1};
    for (const auto& [name, values] : {std::pair<std::string, Values>("missed_counts", {0.05, 5.0, 0.0, 0.0, 0.0, 0.0}),
                                       std::pair<std::string, Values>("encoder_quantisation", {0.5}),
                                       std::pair<std::string, Values>("sensor_wrap", {1.0, 0.0})}) {
        Values reading{7.13, 7.23, 7.33, 7.43};
        with(name, values).logger.at(0)(std::span(reading).first(3), record);
        EXPECT_EQ(reading[3], 7.43) << name;
    }
}

TEST(EffectReadings, AreHeldWhereTheLogRepeatsItself) {
    gap::Record record;
    record.time_s = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5};
    record.output = {1.5, 1.5, 2.0, 2.0, 2.0, 3.0};
    Values reading{10.0, 20.0, 30.0, 40.0, 50.0, 60.0};
    const auto held = [&] {
        Values logged = reading;
        with("dropped_samples", {0.07}).logger.at(0)(logged, record);
        return logged;
    };
    expect_near(held(), {10.0, 20.0, 30.0, 30.0, 30.0, 60.0});  // the lowest: an end may hold it
    record.output[5] = 1.0;
    expect_near(held(), {10.0, 10.0, 30.0, 40.0, 50.0, 60.0});  // now 2 is the highest
}

TEST(EffectReadings, AreWithinATurn) {
    gap::Record record;
    record.time_s = {0.0, 0.1, 0.2};
    Values reading{0.2, 1.3, -0.2};
    with("sensor_wrap", {1.0, 0.0}).logger.at(0)(reading, record);
    expect_near(reading, {0.2, 0.3, 0.8});
    reading = {0.2, 1.3, -0.7};
    with("sensor_wrap", {1.0, -0.5}).logger.at(0)(reading, record);
    expect_near(reading, {0.2, 0.3, 0.3});
    // Beside a measured reading: in the turn that is nearest to it.
    record.output = {0.1, 0.95, 0.9};
    reading = {1.15, 2.03, -0.2};
    with("sensor_wrap", {1.0, 0.0}).logger.at(0)(reading, record);
    expect_near(reading, {0.15, 1.03, 0.8});
}

// --- The model itself, beside the exact response of the changed one.

TEST(EffectModels, AreTheExactResponsesOfTheOtherModel) {
    const gap::Record record = staircase();
    const auto changes = drive::changes_of(record.time_s, record.input);
    drive::Model plain;
    plain.denominator = {{0.3, 1.6}, {0.8, 0.8}, {1.0, 0.0}};
    plain.delay_s = 0.1;
    gap::Scenario scenario;
    scenario.model = plain;
    const auto wanted = [&](const drive::Model& model) { return drive::respond(model, changes, record.time_s); };
    const auto found = [&](const std::string& name, const Values& values) {
        return gap::simulate(with(name, values, scenario), gap::Course(record, 8));
    };
    const double own = largest_difference(gap::simulate(scenario, gap::Course(record, 8)), wanted(plain));
    EXPECT_LT(own, 2.5e-4);
    drive::Model other = plain;
    other.delay_s = 0.25;
    EXPECT_LT(largest_difference(found("dead_time_error", {0.15}), wanted(other)), 2.5e-4);
    other.delay_s = 0.0;
    EXPECT_LT(largest_difference(found("dead_time_error", {-0.3}), wanted(other)), 2.5e-4);
    other = plain;
    other.denominator = {{0.3 * std::pow(1.4, 1.6), 1.6}, {0.8 * std::pow(1.4, 0.8), 0.8}, {1.0, 0.0}};
    EXPECT_LT(largest_difference(found("time_scale_error", {1.4}), wanted(other)), 2.5e-4);
    // The highest by 0.1; all alike, or as the orders themselves.
    other.denominator = {{0.3, 1.7}, {0.8, 0.9}, {1.0, 0.0}};
    EXPECT_LT(largest_difference(found("order_error", {0.1, 0.0}), wanted(other)), 2.5e-4);
    other.denominator = {{0.3, 1.7}, {0.8, 0.85}, {1.0, 0.0}};
    EXPECT_LT(largest_difference(found("order_error", {0.1, 1.0}), wanted(other)), 2.5e-4);
}

// --- A second input.

TEST(EffectInputs, ASecondOneActsBehindItsOwnLag) {
    constexpr double mass = 0.25;
    constexpr double damping = 0.6;
    gap::Record record = staircase();
    Values other;
    for (std::size_t k = 0; k < record.size(); ++k) {
        other.push_back(k < 100 ? 0.0 : k < 300 ? 2.0 : -1.0);
    }
    record.more_inputs = {other};
    gap::Scenario plant;
    plant.model.denominator = {{mass, 2.0}, {damping, 1.0}, {1.0, 0.0}};
    plant.model.delay_s = 0.1;
    // gain / ((1 + 0.3 s) (0.25 s^2 + 0.6 s + 1))
    drive::Model behind;
    behind.gain = 0.35;
    behind.denominator = {{0.3 * mass, 3.0}, {mass + 0.3 * damping, 2.0}, {damping + 0.3, 1.0}, {1.0, 0.0}};
    behind.delay_s = 0.1;
    Values wanted = drive::respond(plant.model, drive::changes_of(record.time_s, record.input), record.time_s);
    const Values more = drive::respond(behind, drive::changes_of(record.time_s, other), record.time_s);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i] += more[i];
    }
    const gap::Course course(record, 8);
    EXPECT_LT(largest_difference(gap::simulate(with("second_input", {0.35, 0.3}, plant), course), wanted), 2.5e-4);
    // What was there before the record has passed its lag.
    std::fill(record.more_inputs[0].begin(), record.more_inputs[0].end(), 2.0);
    const gap::Course constant(record, 1);
    EXPECT_LT(largest_difference(gap::simulate(with("second_input", {0.35, 0.3}, plant), constant),
                                 gap::simulate(with("second_input", {0.35, 0.0}, plant), constant)),
              1e-12);
    record.more_inputs.clear();
    EXPECT_THROW((void)gap::simulate(with("second_input", {0.35, 0.3}, plant), gap::Course(record, 1)), glsum::Failure);
}

}  // namespace
