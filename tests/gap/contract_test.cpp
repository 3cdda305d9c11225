// How files write the effects' numbers, and what each effect says of itself.
#include "gap/drive/contract.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/failure.hpp"
#include "gap/drive/audit.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/improved.hpp"
#include "gap/drive/study.hpp"
#include "stand_case.hpp"

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> those(const std::function<bool(const gap::Effect&)>& wanted) {
    std::vector<std::string> names;
    for (const gap::Effect* effect : gap::effects()) {
        if (wanted(*effect)) {
            names.push_back(effect->name);
        }
    }
    return names;
}

// Scales of a record in which each effect can occur.
gap::Scales eventful() {
    const gap::Record record = gap_test::log_of({}, {});
    gap::Scales scales = gap::scales_of(gap::model_of(gap_test::linear_form()), {record}, gap::audit({record}));
    scales.quantum = 0.001;
    scales.held_share = 0.1;
    scales.may_clip = true;
    scales.deployed_step_s = 0.02;
    scales.turn = 2.0;
    scales.further_max = 1.0;
    return scales;
}

TEST(GapContract, FilesCallTheNumbersAsTheFitsDo) {
    const gap::Scales scales = eventful();
    for (const gap::Effect* effect : gap::effects()) {
        const auto parameters = effect->parameters(scales);
        ASSERT_EQ(parameters.size(), effect->numbers.size()) << effect->name;
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            EXPECT_EQ(parameters[i].name, effect->numbers[i].name) << effect->name;
        }
        EXPECT_FALSE(parameters.empty()) << effect->name;
        EXPECT_FALSE(effect->domains.empty()) << effect->name;
    }
}

TEST(GapContract, WhatIsWrittenIsReadBack) {
    const gap::Scales scales = eventful();
    for (const gap::Effect* effect : gap::effects()) {
        std::vector<gap::Fitted> fitted;
        std::vector<double> values;
        for (const gap::EffectParameter& parameter : effect->parameters(scales)) {
            const double value =
                effect->guess != nullptr ? 0.25 + static_cast<double>(values.size()) : parameter.starts.front();
            fitted.push_back({value, value - 0.1, value + 0.1});
            values.push_back(value);
        }
        gap::Contracted contracted;
        for (const gap::Written& written : effect->to_contract(*effect, fitted)) {
            contracted[written.name] = written.value;
        }
        EXPECT_EQ(effect->from_contract(*effect, contracted), values) << effect->name;
    }
}

TEST(GapContract, HasWordsAndListsWhereItSaysSo) {
    const gap::Effect& fixed = gap::effect_named("fixed_point");
    const std::vector<gap::Fitted> bits = {{15.0, 15.0, 15.0}, {1.0, 1.0, 1.0}, {0.02, 0.02, 0.02}};
    const gap::Written format = fixed.to_contract(fixed, bits).front();
    EXPECT_EQ(std::get<std::string>(format.value), "q15");
    EXPECT_TRUE(format.intervals.empty());
    const gap::Effect& mode = gap::effect_named("structural_resonance");
    const std::vector<gap::Fitted> speed = {{3.0, 2.9, 3.1}, {0.05, 0.04, 0.06}, {0.2, 0.1, 0.3}, {1.0, 1.0, 1.0}};
    const gap::Written speed_share = mode.to_contract(mode, speed).back();
    EXPECT_EQ(speed_share.name, "speed_share");
    EXPECT_EQ(std::get<double>(speed_share.value), 0.2);
    EXPECT_THAT(speed_share.intervals, ElementsAre(std::pair(0.1, 0.3)));
    // Of the place its cosine, of the speed its sine: in between both.
    std::vector<gap::Fitted> between = speed;
    between[3] = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    const std::vector<gap::Written> parts = mode.to_contract(mode, between);
    ASSERT_EQ(parts.size(), 4U);
    EXPECT_EQ(parts[0].name, "hz");
    EXPECT_EQ(std::get<double>(parts[0].value), 3.0);
    EXPECT_THAT(parts[0].intervals, ElementsAre(std::pair(2.9, 3.1)));
    EXPECT_EQ(std::get<double>(parts[1].value), 0.05);
    EXPECT_THAT(parts[1].intervals, ElementsAre(std::pair(0.04, 0.06)));
    EXPECT_EQ(parts[2].name, "share");
    EXPECT_NEAR(std::get<double>(parts[2].value), 0.2 * std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(parts[2].intervals.at(0).first, 0.1 * std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(parts[2].intervals.at(0).second, 0.3 * std::sqrt(0.75), 1e-12);
    EXPECT_NEAR(std::get<double>(parts[3].value), 0.1, 1e-12);
    // The place alone has no other part, either way.
    between[3] = {0.0, 0.0, 0.0};
    EXPECT_EQ(mode.to_contract(mode, between).size(), 3U);
    EXPECT_EQ(mode.from_contract(mode, {{"hz", 3.0}, {"damping", 0.05}, {"speed_share", 0.4}}),
              (std::vector<double>{3.0, 0.05, 0.4, 1.0}));
    EXPECT_EQ(mode.from_contract(mode, {{"hz", 3.0}, {"damping", 0.05}, {"share", 0.4}}),
              (std::vector<double>{3.0, 0.05, 0.4, 0.0}));
    const std::vector<double> both =
        mode.from_contract(mode, {{"hz", 3.0}, {"damping", 0.05}, {"share", -0.3}, {"speed_share", 0.4}});
    EXPECT_NEAR(both[2], -0.5, 1e-12);
    EXPECT_NEAR(both[2] * std::cos(0.5 * 3.14159265358979 * both[3]), -0.3, 1e-12);
    EXPECT_NEAR(both[2] * std::sin(0.5 * 3.14159265358979 * both[3]), 0.4, 1e-12);
    const gap::Effect& missed = gap::effect_named("missed_counts");
    const std::vector<gap::Fitted> jumps = {{2.0, 1.9, 2.1}, {0.5, 0.4, 0.6}, {0.0, 0.0, 0.0},
                                            {0.0, 0.0, 0.0}, {7.0, 6.9, 7.1}, {-0.5, -0.7, -0.3}};
    const std::vector<gap::Written> lists = missed.to_contract(missed, jumps);
    ASSERT_EQ(lists.size(), 2U);
    EXPECT_EQ(lists[0].name, "at_s");
    EXPECT_THAT(std::get<std::vector<double>>(lists[0].value), ElementsAre(2.0, 7.0));
    EXPECT_THAT(lists[0].intervals, ElementsAre(std::pair(1.9, 2.1), std::pair(6.9, 7.1)));
    EXPECT_EQ(lists[0].unit, "s");
    EXPECT_EQ(lists[1].unit, "y");
    EXPECT_EQ(lists[1].name, "sizes");
    EXPECT_THAT(std::get<std::vector<double>>(lists[1].value), ElementsAre(0.5, -0.5));
    EXPECT_THAT(lists[1].intervals, ElementsAre(std::pair(0.4, 0.6), std::pair(-0.7, -0.3)));
}

void expect_refusal(const std::string& effects, const std::string& what) {
    drive::Model model;
    model.denominator = {{1.0, 1.0}, {1.0, 0.0}};
    model.notes = R"({"effects": [)" + effects + "]}";
    gap::Record record{"log", {0.0, 0.1, 0.2}, {1.0, 1.0, 1.0}, {}, 0.1};
    try {
        (void)gap::simulate_improved(model, record, "m.json");
        ADD_FAILURE() << "taken: " << effects;
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_THAT(failure.what(), HasSubstr("m.json: effects: " + what));
    }
}

// Each by the names that the contract has, and by no other.
TEST(GapContract, AnImprovedModelHasEachEffect) {
    const std::vector<std::pair<std::string, std::string>> all = {
        {"gain_error", R"("gain": 1.2)"},
        {"time_scale_error", R"("scale": 1.3)"},
        {"dead_time_error", R"("extra_s": 0.2)"},
        {"order_error", R"("shift": 0.1)"},
        {"input_saturation", R"("limit": 0.5)"},
        {"input_dead_zone", R"("width": 0.1, "width_down": 0.2)"},
        {"start_up_threshold", R"("threshold": 0.5)"},
        {"input_curve", R"("curvature": 0.3, "reference": 1)"},
        {"input_hysteresis", R"("width": 0.2, "share": 0.6)"},
        {"valve_stiction", R"("band": 0.2, "jump": 0.1)"},
        {"rate_limit", R"("per_s": 0.8)"},
        {"actuator_lag", R"("tau_s": 0.3)"},
        {"supply_sag", R"("per_unit_s": 0.02, "resistance": 0.1)"},
        {"gain_drift", R"("per_s": 0.05)"},
        {"second_input", R"("gain": 0.5, "tau_s": 0.2)"},
        {"variable_delay", R"("depth_s": 0.2, "period_s": 5)"},
        {"coulomb_friction", R"("force": 0.1)"},
        {"direction_dependent_friction", R"("force_up": 0.1, "force_down": 0.05)"},
        {"load_dependent_friction", R"("share": 0.1)"},
        {"quadratic_drag", R"("coefficient": 0.8)"},
        {"gravity_nonlinearity", R"("angle_per_unit": 1.2)"},
        {"cubic_stiffness", R"("coefficient": 0.8)"},
        {"cogging", R"("size": 0.05, "per_unit": 3)"},
        {"end_stop", R"("limit": 0.6, "restitution": 0.3, "before_s": 0.5, "spill": 0.5)"},
        {"backlash", R"("gap": 0.1)"},
        {"structural_resonance", R"("hz": 3, "damping": 0.05, "share": 0.1, "speed_share": 0.1)"},
        {"direction_asymmetry", R"("tau_up_s": 0.1, "tau_down_s": 0.4)"},
        {"output_curve", R"("curvature": 0.2)"},
        {"load_disturbance", R"("from_s": 2, "to_s": 3, "size": 0.3)"},
        {"sensor_offset", R"("offset": 0.1)"},
        {"sensor_drift", R"("per_s": 0.05)"},
        {"sensor_lag", R"("tau_s": 0.3)"},
        {"sensor_saturation", R"("limit": 0.5)"},
        {"sensor_magnitude", ""},
        {"sensor_wrap", R"("turn": 0.4)"},
        {"encoder_quantisation", R"("step": 0.1)"},
        {"missed_counts", R"("at_s": [2, 4], "sizes": [0.2, -0.1])"},
        {"logger_filter", R"("window_s": 0.4)"},
        {"finite_memory", R"("taps": 20)"},
        {"fixed_point", R"("format": "q15")"},
    };
    drive::Model model;
    model.denominator = {{0.25, 1.9}, {0.6, 1.0}, {1.0, 0.0}};
    gap::Record record{"log", {}, {}, {}, 0.02};
    record.more_inputs.emplace_back();
    for (int k = 0; k < 400; ++k) {
        record.time_s.push_back(0.02 * k);
        record.input.push_back(k < 150 ? 0.4 : k < 300 ? 1.0 : -0.5);
        record.more_inputs[0].push_back(k < 200 ? 0.0 : 1.0);
    }
    gap::Scenario plain;
    plain.model = model;
    const std::vector<double> usual = gap::simulate(plain, gap::Course(record, 1));
    for (const auto& [name, parameters] : all) {
        model.notes = fmt::format(R"({{"effects": [{{"effect": "{}", "parameters": {{{}}}}}]}})", name, parameters);
        const gap::Improved improved = gap::simulate_improved(model, record, "m.json");
        EXPECT_THAT(improved.effects, ElementsAre(name));
        double most = 0.0;
        for (std::size_t i = 0; i < usual.size(); ++i) {
            EXPECT_TRUE(std::isfinite(improved.output[i])) << name;
            most = std::max(most, std::fabs(improved.output[i] - usual[i]));
        }
        EXPECT_GT(most, 0.01) << name;
    }
    // Those whose effect is too small to see here, or that move no reading.
    EXPECT_EQ(all.size() + 3, gap::effects().size());
    for (const auto& [name, parameters] :
         {std::pair("single_precision", ""), std::pair("sampling_jitter", R"("half_width_s": 0.01)"),
          std::pair("dropped_samples", R"("rate": 0.1)")}) {
        model.notes = fmt::format(R"({{"effects": [{{"effect": "{}", "parameters": {{{}}}}}]}})", name, parameters);
        EXPECT_THAT(gap::simulate_improved(model, record, "m.json").effects, ElementsAre(name));
    }
}

TEST(GapContract, RefusesWhatItCannotRead) {
    expect_refusal(R"({"effect": "backlash", "parameters": {}})", "backlash: expected a number gap");
    expect_refusal(R"({"effect": "backlash", "parameters": {"gap": "wide"}})", "backlash: expected a number gap");
    expect_refusal(R"({"effect": "backlash", "parameters": {"gap": 1, "play": 2}})", "backlash: has no parameter play");
    expect_refusal(R"({"effect": "backlash", "parameters": {"gap": {}}})",
                   "gap: expected a number, a word or a list of numbers, found {}");
    expect_refusal(R"({"effect": "fixed_point", "parameters": {"format": "q7"}})",
                   "fixed_point: expected format q31 or q15");
    expect_refusal(R"({"effect": "missed_counts", "parameters": {"at_s": [1]}})", "expected a list of numbers sizes");
    expect_refusal(R"({"effect": "missed_counts", "parameters": {"at_s": [1], "sizes": [1, 2]}})",
                   "missed_counts: expected at_s and sizes");
}

TEST(GapContract, AnEffectSaysWhatItIs) {
    EXPECT_THAT(those([](const gap::Effect& effect) { return effect.of_fitted_base; }),
                ElementsAre("gain_error", "time_scale_error", "dead_time_error", "order_error", "sensor_offset",
                            "finite_memory", "single_precision", "fixed_point"));
    EXPECT_THAT(those([](const gap::Effect& effect) { return effect.uneven_noise; }),
                ElementsAre("sensor_saturation", "encoder_quantisation", "dropped_samples", "sampling_jitter"));
    EXPECT_THAT(those([](const gap::Effect& effect) { return effect.linear; }),
                ElementsAre("gain_error", "time_scale_error", "dead_time_error", "order_error", "actuator_lag",
                            "structural_resonance", "sensor_offset", "sensor_lag", "logger_filter"));
    EXPECT_THAT(those([](const gap::Effect& effect) { return effect.only_spreads; }), ElementsAre("sampling_jitter"));
    EXPECT_THAT(those([](const gap::Effect& effect) { return effect.rounds; }), ElementsAre("encoder_quantisation"));
    EXPECT_THAT(those([](const gap::Effect& effect) { return effect.place == gap::Place::deployed; }),
                ElementsAre("finite_memory", "single_precision", "fixed_point"));
    EXPECT_FALSE(gap::effect_named("backlash").domains.contains(gap::Domain::thermal));
    EXPECT_FALSE(gap::effect_named("missed_counts").domains.contains(gap::Domain::hydraulic));
    EXPECT_TRUE(gap::effect_named("end_stop").domains.contains(gap::Domain::hydraulic));
    EXPECT_EQ(gap::effect_named("sensor_lag").domains, gap::all_domains());
    EXPECT_FALSE(gap::effect_named("cogging").domains.contains(gap::Domain::electric));
    EXPECT_EQ(gap::domain_named("thermal"), gap::Domain::thermal);
    EXPECT_THROW((void)gap::domain_named("chemical"), glsum::Failure);
}

// A fitted base without causes is about its operating point, too; a model that has neither is simulated as any other.
TEST(GapContract, AnImprovedModelIsAboutItsPoint) {
    drive::Model model;
    model.denominator = {{1.0, 1.0}, {1.0, 0.0}};
    model.gain = 2.0;
    gap::Record record{"log", {}, {}, {}, 0.1};
    for (int k = 0; k < 400; ++k) {
        record.time_s.push_back(0.1 * k);
        record.input.push_back(1003.0);
    }
    model.notes = R"({"effects": []})";
    EXPECT_THAT(gap::simulate_improved(model, record, "m.json").output, testing::IsEmpty());
    model.notes = R"({"effects": [], "operating_output": 5, "idle_input": 1000})";
    EXPECT_NEAR(gap::simulate_improved(model, record, "m.json").output.back(), 5.0 + 2.0 * 3.0, 1e-6);
    model.notes = R"({"effects": [], "idle_input": 1001})";
    EXPECT_NEAR(gap::simulate_improved(model, record, "m.json").output.back(), 2.0 * 2.0, 1e-6);
    model.notes = R"({"effects": [{"effect": "input_saturation", "parameters": {"limit": 1}}], "idle_input": 1000})";
    EXPECT_NEAR(gap::simulate_improved(model, record, "m.json").output.back(), 2.0, 1e-6);
    for (const char* field : {"idle_input", "operating_output"}) {
        model.notes = fmt::format(R"({{"effects": [], "{}": "x"}})", field);
        try {
            (void)gap::simulate_improved(model, record, "m.json");
            ADD_FAILURE() << field;
        } catch (const glsum::Failure& failure) {
            EXPECT_THAT(failure.what(), HasSubstr(fmt::format("m.json: {}: expected a number", field)));
        }
    }
}

}  // namespace
