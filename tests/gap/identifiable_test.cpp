// Effects whose numbers a fit finds again in a record that a finer simulation made of them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "gap/drive/audit.hpp"
#include "gap/drive/clued_start.hpp"
#include "gap/drive/experiment.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/ranking.hpp"
#include "gap/drive/start.hpp"

namespace {

struct Rig {
    drive::Model model;
    gap::Record record;
    double noise = 0.002;
};

drive::Model arm() {
    drive::Model model;
    model.denominator = {{0.25, 2.0}, {0.6, 1.0}, {1.0, 0.0}};
    model.delay_s = 0.1;
    return model;
}

drive::Model rotor() {
    drive::Model model;
    model.gain = 4.0;
    model.denominator = {{0.5, 1.0}, {1.0, 0.0}};
    return model;
}

// 24 s of steps and slopes between `low` and 1, some levels held.
gap::Record moved(double low, unsigned seed = 3) {
    gap::Record record;
    record.name = "moved";
    record.usual_interval_s = 0.02;
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> level(low, 1.0);
    double from = 0.0;
    double to = level(engine);
    for (int k = 0; k < 1200; ++k) {
        if (k % 60 == 0 && k > 0) {
            from = to;
            to = level(engine);
        }
        // Every other change is a slope of 0.8 s.
        const double share = (k / 60) % 2 == 0 ? 1.0 : std::min(1.0, (k % 60) / 40.0);
        record.time_s.push_back(0.02 * k);
        record.input.push_back(from + share * (to - from));
        record.output.push_back(0.0);
    }
    return record;
}

void measure(Rig& rig, const gap::Scenario& truth) {
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal(0.0, rig.noise);
    gap::Record blank = rig.record;
    blank.output.clear();
    const std::vector<double> nodes = gap::simulate(truth, gap::Course(blank, 8));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        rig.record.output[i] = nodes[i] + normal(engine);
    }
}

gap::Study study_of(const Rig& rig) {
    const gap::Audit found = gap::audit({rig.record});
    gap::Study study{{gap::form_of(rig.model), false},
                     gap::scales_of(rig.model, {rig.record}, found),
                     {},
                     gap::all_count({rig.record}),
                     rig.noise,
                     2e-4,
                     0};
    study.courses.emplace_back(rig.record, 2);
    return study;
}

// From its starts, and from what the residuals tell where it has a look at them.
gap::Candidate fitted(const gap::Study& study, const gap::Effect& effect) {
    gap::Candidate best = gap::fit(study, {&effect}, {}, nullptr, {12, 2, 60});
    const gap::Candidate none = gap::fit(study, {}, {}, nullptr);
    if (const auto clued = gap::clued_start(study, none, effect); !clued.empty()) {
        gap::Candidate start = best;
        start.lasting[0] = clued;
        gap::Candidate other = gap::fit(study, {&effect}, start, nullptr, {12, 2, 60});
        best = other.cost < best.cost ? other : best;
    }
    return best;
}

// The numbers as the contract has them.
gap::Contracted found_in(const gap::Candidate& candidate, const gap::Effect& effect) {
    std::vector<gap::Fitted> numbers;
    for (const gap::FreeParameter& parameter : candidate.lasting[0]) {
        numbers.push_back({parameter.value, parameter.lower, parameter.upper});
    }
    gap::Contracted contracted;
    for (const gap::Written& written : effect.to_contract(effect, numbers)) {
        contracted[written.name] = written.value;
    }
    return contracted;
}

using Values = std::vector<double>;
using Wanted = std::vector<std::pair<std::string, double>>;

// \param within  of the wanted value, relative
void expect_found(Rig rig, const std::string& name, const Values& values, const Wanted& wanted, double within = 0.05,
                  double noise_left = 1.3) {
    const gap::Effect& effect = gap::effect_named(name);
    gap::Scenario truth;
    truth.model = rig.model;
    effect.add_to(truth, values);
    measure(rig, truth);
    const gap::Study study = study_of(rig);
    ASSERT_TRUE(gap::applies(effect, study.scales)) << name;
    const gap::Candidate none = gap::fit(study, {}, {}, nullptr);
    const gap::Candidate found = fitted(study, effect);
    const double noise = 0.5 * rig.noise * rig.noise * static_cast<double>(rig.record.size());
    EXPECT_GT(none.cost, 2.0 * noise) << name;
    EXPECT_LT(found.cost, noise_left * noise) << name;
    const gap::Contracted contracted = found_in(found, effect);
    for (const auto& [number, value] : wanted) {
        EXPECT_NEAR(std::get<double>(contracted.at(number)), value, within * std::fabs(value)) << name << "." << number;
    }
}

TEST(GapIdentifiable, WhatTheActuatorDoes) {
    expect_found({arm(), moved(-1.0)}, "input_dead_zone", {0.2, 0.35}, {{"width", 0.2}, {"width_down", 0.35}});
    expect_found({arm(), moved(0.0)}, "input_dead_zone", {0.2, -1.0}, {{"width", 0.2}});
    expect_found({arm(), moved(-1.0)}, "input_hysteresis", {0.3, 0.7}, {{"width", 0.3}, {"share", 0.7}});
    expect_found({arm(), moved(0.0)}, "valve_stiction", {0.15, 0.06, 0.004}, {{"band", 0.15}, {"jump", 0.06}}, 0.15,
                 3.0);
    expect_found({arm(), moved(0.0)}, "variable_delay", {0.12, 3.1, 0.8}, {{"depth_s", 0.12}, {"period_s", 3.1}});
}

TEST(GapIdentifiable, WhatThePlantDoes) {
    expect_found({arm(), moved(-1.0)}, "cubic_stiffness", {1.2}, {{"coefficient", 1.2}});
    expect_found({arm(), moved(-1.0)}, "load_dependent_friction", {0.06}, {{"share", 0.06}});
    expect_found({arm(), moved(-1.0)}, "cogging", {0.05, 3.0, 0.7, 0.0}, {{"per_unit", 3.0}});
    expect_found({arm(), moved(0.0)}, "structural_resonance", {2.4, 0.06, 0.1, 1.0},
                 {{"hz", 2.4}, {"damping", 0.06}, {"speed_share", 0.1}});
    expect_found({rotor(), moved(-0.5), 0.01}, "coulomb_friction", {0.6, 1.0}, {{"force", 0.6}, {"of_speed", 1.0}});
    expect_found({rotor(), moved(-0.5), 0.01}, "direction_dependent_friction", {0.5, 0.25, 1.0},
                 {{"force_up", 0.5}, {"force_down", 0.25}, {"of_speed", 1.0}});
    expect_found({rotor(), moved(0.2), 0.01}, "cogging", {0.15, 0.6, 0.4, 1.0}, {{"per_unit", 0.6}});
}

TEST(GapIdentifiable, WhatTheSensorAndTheLoggerDo) {
    expect_found({arm(), moved(-1.0)}, "sensor_magnitude", {1.0}, {});
    expect_found({arm(), moved(0.0)}, "logger_filter", {0.3}, {{"window_s", 0.3}});
    drive::Model turning;  // 1.5 turns a second and more
    turning.gain = 10.0;
    turning.denominator = {{0.3, 2.0}, {1.0, 1.0}};
    const double turn = 2.0 * std::numbers::pi;
    expect_found({turning, moved(0.0), 0.05}, "sensor_wrap", {turn, 0.0}, {{"turn", turn}}, 1e-3);
    turning.gain = 40.0;
    expect_found({turning, moved(0.0), 0.2}, "sensor_wrap", {25.0, 0.0}, {{"turn", 25.0}}, 1e-3);
}

TEST(GapIdentifiable, WhatASecondInputDoes) {
    Rig rig{arm(), moved(0.0)};
    rig.record.more_inputs = {moved(-3.0, 11).input};
    expect_found(rig, "second_input", {-0.15, 0.7}, {{"gain", -0.15}, {"tau_s", 0.7}});
}

// What is proposed moves the first input alone, and needs a record that has the second.
TEST(GapIdentifiable, AProposalLeavesTheSecondInputWhereItWas) {
    Rig rig{arm(), moved(0.0)};
    rig.record.more_inputs = {std::vector<double>(rig.record.size(), 0.5)};
    gap::Scenario truth;
    truth.model = rig.model;
    gap::effect_named("second_input").add_to(truth, Values{0.3, 0.5});
    measure(rig, truth);
    const gap::Study study = study_of(rig);
    const gap::Candidate second = gap::fit(study, {&gap::effect_named("second_input")}, {}, nullptr);
    const gap::Candidate offset = gap::fit(study, {&gap::effect_named("sensor_offset")}, {}, nullptr);
    const gap::Proposal parting = gap::part(study, {&second, &offset}, rig.noise);
    EXPECT_FALSE(parting.text.empty());
    // What it draws is as far apart as it says.
    ASSERT_TRUE(parting.record);
    ASSERT_EQ(parting.record->outputs.size(), 2U);
    const std::vector<double>& one = parting.record->outputs[0].second;
    const std::vector<double>& other = parting.record->outputs[1].second;
    double squares = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        squares += (one[i] - other[i]) * (one[i] - other[i]);
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(one.size())) / rig.noise, parting.apart, 0.02 * parting.apart);
    EXPECT_FALSE(gap::sharpen(study, second, gap::whitener_of(study, second)).text.empty());
}

// A released arm: nobody drives it, and its friction is told by what moves it instead.
TEST(GapIdentifiable, FrictionOfAFreeMotion) {
    Rig rig{arm(), moved(0.0)};
    std::fill(rig.record.input.begin(), rig.record.input.end(), 0.0);
    rig.model.denominator = {{0.5, 2.0}, {0.02, 1.0}, {20.0, 0.0}};
    rig.model.delay_s = 0.0;
    gap::Scenario truth;
    truth.model = rig.model;
    truth.initial_output = 1.2;
    gap::effect_named("coulomb_friction").add_to(truth, Values{0.5, 0.0});
    measure(rig, truth);
    const gap::Scales scales = gap::scales_of(rig.model, {rig.record}, gap::audit({rig.record}));
    EXPECT_NEAR(scales.force, 20.0 * 1.2, 0.5);
    EXPECT_EQ(scales.input_max, 1.0);
    gap::Study study = study_of(rig);
    study.base.refit = true;  // its initial state is not known
    gap::Candidate start;
    start.own = {gap::state_of(study, rig.record)};
    start.own[0][0].value = 0.0;  // it rests there, not where it is released
    const gap::Candidate found = gap::fit(study, {&gap::effect_named("coulomb_friction")}, start, nullptr, {12, 2, 60});
    // Nothing tells forces themselves where none is applied: all coefficients may be any times as large.
    const double stiffness = drive::constant_coefficient(gap::scenario_of(study, found, 0).model.denominator);
    EXPECT_NEAR(found.lasting[0][0].value / stiffness, 0.5 / 20.0, 0.002);
}

}  // namespace
