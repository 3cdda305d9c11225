// What is said of generated controllers: margins, reports, costs, and the numbers and words of their headers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "bench/steppers/controller/certificate.hpp"
#include "bench/steppers/controller/controller_header.hpp"
#include "bench/steppers/controller/fixed_pid.hpp"
#include "bench/steppers/controller/report.hpp"
#include "bench/steppers/controller/stepped_q31.hpp"
#include "bench/steppers/controller/written.hpp"
#include "bench/steppers/stepper/json.hpp"
#include "bench/steppers/stepper/verify.hpp"
#include "tests/generate/controllers.hpp"
#include "tests/generate/text_of_header.hpp"
#include "tests/refusal.hpp"

namespace {

using generate::ControllerSpec;
using generate::FixedPid;
using test::number_behind;
using test::says;
using Json = nlohmann::json;

TEST(Certificate, ItsTextNamesWhatThereIs) {
    tune::Margins margins;
    margins.sensitivity = 1.25;
    margins.sensitivity_at = 4.0;
    EXPECT_EQ(generate::margins_text(margins), "gain margin none, phase margin none, largest |S| 1.250 at 4 rad/s");
    margins.gain = 2.5;
    margins.phase_crossover = 3.25;
    margins.crossings = 1;
    margins.phase_deg = 61.24;
    margins.crossover = 0.75;
    EXPECT_EQ(generate::margins_text(margins),
              "gain margin 2.5 at 3.25 rad/s, phase margin 61.2 degrees (crossover 0.75 rad/s), largest |S| 1.250 at 4 "
              "rad/s");
}

TEST(ControllerReport, OfALoopSaysItsLevelsAndDeviations) {
    const generate::LoopReport loop{"plant.json", "a plant", {1.2e-4, 2.5e-3}, {}};
    ControllerSpec spec = controllers::whole();
    spec.horizon = 5000;
    const auto lines = generate::to_lines(loop, spec);
    EXPECT_EQ(lines.at(0), "In a loop with a plant, 5000 samples, the set point 1, then 0.4:");
    EXPECT_EQ(lines.at(1).find("within 0.00012 of the same loop in double with full memory"), 0U);
    EXPECT_EQ(lines.at(2), "the sampling's own error, by halving the step: 0.0025.");
    spec.input_full_scale = 0.5;
    EXPECT_EQ(generate::to_lines(loop, spec).at(0),
              "In a loop with a plant, 5000 samples, the set point 0.25, then 0.1:");
}

TEST(ControllerReport, AsAFileHasEachNumberUnderItsName) {
    tune::Margins margins;
    margins.sensitivity = 1.25;
    margins.sensitivity_at = 4.0;
    margins.complementary = 1.5;
    ControllerSpec spec = controllers::whole();
    spec.horizon = 5000;
    spec.max_error = 1e-3;
    const auto loop_of = [&] {
        const generate::LoopReport loop{"plant.json", "a plant", {1.25e-4, 2.5e-3}, margins};
        return Json::parse(generate::to_json({"pid.json", "pid.h", loop}, spec));
    };
    Json json = loop_of();
    EXPECT_EQ(json["controller"], "pid.json");
    EXPECT_EQ(json["header"], "pid.h");
    EXPECT_EQ(json["sample_time_s"], 0.5);
    EXPECT_EQ(json["format"], "f32");
    EXPECT_EQ(json["max_error"], 1e-3);
    EXPECT_EQ(json["samples"], 5000);
    EXPECT_EQ(json["integral"], (Json{{"kernel", "modes_compensated_f32"}, {"order", 0.0}, {"taps", 1}}));
    EXPECT_EQ(json["derivative"], (Json{{"kernel", "modes_plain_f32"}, {"order", 1.0}, {"taps", 2}}));
    // Without crossings and with an infinite gain margin there are no numbers of these.
    EXPECT_EQ(json["loop"], (Json{{"plant", "plant.json"},
                                  {"deviation", 1.25e-4},
                                  {"sampling_error", 2.5e-3},
                                  {"unstable_poles", 0},
                                  {"sensitivity", 1.25},
                                  {"sensitivity_rad_s", 4.0},
                                  {"complementary_sensitivity", 1.5}}));
    for (const char* field : {"input_full_scale", "rounding_error", "core", "cost", "cost_of_integer_pid", "checked"}) {
        EXPECT_FALSE(json.contains(field)) << field;
    }
    margins.gain = 2.5;
    margins.phase_crossover = 3.25;
    margins.crossings = 1;
    margins.phase_deg = 61.5;
    margins.crossover = 0.75;
    json = loop_of()["loop"];
    EXPECT_EQ(json["gain_margin"], 2.5);
    EXPECT_EQ(json["phase_crossover_rad_s"], 3.25);
    EXPECT_EQ(json["phase_margin_deg"], 61.5);
    EXPECT_EQ(json["crossover_rad_s"], 0.75);
    spec.controller.gains.kd = 0.0;
    spec.input_full_scale = 4.0;
    json = Json::parse(generate::to_json({"pid.json", "pid.h"}, spec));
    EXPECT_FALSE(json.contains("derivative"));
    EXPECT_FALSE(json.contains("loop"));
    const generate::FixedController stepped(spec);
    EXPECT_EQ(json["input_full_scale"], 4.0);
    EXPECT_EQ(json["output_full_scale"], 2.0);
    EXPECT_EQ(json["rounding_error"], stepped.error().direct);
    EXPECT_EQ(json["rounding_error_per_sample"], stepped.error().per_sample);
    EXPECT_EQ(json["integral"]["kernel"], "modes_plain_q31");
}

TEST(CheckedBits, AreToldInWordsAndAsAFile) {
    EXPECT_EQ(generate::to_text({"there", 4000, 0}), "bits of 4000 steps and of the self-check, there: the library's");
    EXPECT_EQ(generate::to_text({"there", 40, 1}),
              "bits of 40 steps and of the self-check, there: others from step 1 on");
    EXPECT_EQ(generate::to_text({"there", 40, generate::self_check_failed}),
              "bits of 40 steps and of the self-check, there: those of the self-check are others");
    nlohmann::ordered_json json;
    generate::add_checks(json, {});
    EXPECT_FALSE(json.contains("checked"));
    generate::add_checks(json, {{"here", 40, 0}, {"there", 50, 7}});
    ASSERT_EQ(json["checked"].size(), 2U);
    EXPECT_EQ(json["checked"][0].dump(), R"({"where":"here","steps":40,"first_wrong":0,"good":true})");
    EXPECT_EQ(json["checked"][1].dump(), R"({"where":"there","steps":50,"first_wrong":7,"good":false})");
}

TEST(StepCost, IsToldInATableAndAsAFile) {
    const generate::StepCost cost{12.5, 11.3, 13.0, 20.0, 300, 40, 56, "board of ours"};
    EXPECT_EQ(Json(generate::cost_json(cost)), (Json{{"model_cycles", 12.5},
                                                     {"model_cycles_low", 11.3},
                                                     {"model_cycles_high", 13.0},
                                                     {"instructions", 20.0},
                                                     {"state_bytes", 56},
                                                     {"table_bytes", 40},
                                                     {"code_bytes", 300}}));
    const std::string text = generate::cost_table({{"one", cost}}, "a-core");
    std::istringstream lines(text);
    std::string heading;
    std::string row;
    std::getline(lines, heading);  // an empty line
    std::getline(lines, heading);
    std::getline(lines, row);
    EXPECT_EQ(heading.size(), row.size());
    const auto words_of = [](const std::string& line) {
        std::istringstream words(line);
        return std::vector<std::string>{std::istream_iterator<std::string>(words), {}};
    };
    using Words = std::vector<std::string>;
    EXPECT_EQ(words_of(heading), (Words{"cycles", "band", "instructions", "state", "tables", "code"}));
    EXPECT_EQ(words_of(row), (Words{"one", "12.5", "11.3", "to", "13.0", "20.0", "56", "40", "300"}));
    EXPECT_NE(text.find("a step on the board of ours; cycles of the timing model for a-core; "), std::string::npos);
}

TEST(ControllerHeader, OfSinglePrecisionHasTheNumbersOfItsFormula) {
    ControllerSpec spec = controllers::whole();
    spec.controller.setpoint_weight = 0.75;
    const std::string text = generate::make_controller_header(spec, "own", "MIT", {"one", "", "two */"});
    EXPECT_NO_THROW(test::compile_example(text, "own", "float r, float y"));
    EXPECT_EQ(number_behind(text, "A fractional PID controller in single precision, sampled every "), 0.5);
    EXPECT_TRUE(says(text,
                     " u = 0.5 w + 1 D^-1 e + 0.25 D^1 w / (0.5 s + 1),   e = r - y,   w = 0.75 r - y,   "
                     "-2 <= u <= 2\n"));
    EXPECT_EQ(number_behind(text, "are off by at most "), spec.max_error);
    EXPECT_EQ(number_behind(text, "the sum of the magnitudes over "), 1e6);
    EXPECT_TRUE(says(text, " * one\n *\n * two * /\n * Licence: MIT.\n */\n"));
    EXPECT_TRUE(says(text, "#define OWN_F32_DESIGN \"kp = 0.5, ki = 1, kd = 0.25, orders 1 and 1, h = 0.5 s\"\n"));
    EXPECT_EQ(number_behind(text, "#define OWN_F32_SAMPLE_TIME "), 0.5);
    EXPECT_EQ(number_behind(text, "#define OWN_F32_WEIGHT "), 0.75);
    EXPECT_EQ(number_behind(text, "#define OWN_F32_INTEGRAL "), 0.5);
    EXPECT_EQ(number_behind(text, "#define OWN_F32_DERIVATIVE "), 2.0);
    EXPECT_EQ(number_behind(text, "S->pid.kp = "), 0.5);
    EXPECT_EQ(number_behind(text, "S->pid.ki = "), 1.0 * 0.5);
    EXPECT_EQ(number_behind(text, "S->pid.kd = "), 0.25 / 0.5);
    EXPECT_EQ(number_behind(text, "S->pid.passes = "), 0.5);
    EXPECT_EQ(number_behind(text, "S->pid.low = "), -2.0);
    EXPECT_EQ(number_behind(text, "S->pid.high = "), 2.0);
    // Its two sums are headers of their own, of orders 0 and 1 at this step.
    EXPECT_TRUE(says(text, "v = 0, h = 0.5 s\"\n"));
    EXPECT_TRUE(says(text, "v = 1, h = 0.5 s\"\n"));
    EXPECT_TRUE(says(text, "#define OWN_INTEGRAL_F32_TAPS 1U "));
    EXPECT_TRUE(says(text, "#define OWN_DERIVATIVE_F32_TAPS 2U "));
    EXPECT_FALSE(says(text, "There is no derivative part"));
}

TEST(ControllerHeader, WithoutLimitsOrADerivativeSaysSo) {
    ControllerSpec spec = controllers::whole();
    spec.controller.gains.kd = 0.0;
    spec.controller.low = -std::numeric_limits<double>::infinity();
    spec.controller.high = std::numeric_limits<double>::infinity();
    const std::string text = generate::make_controller_header(spec, "own", "", {});
    EXPECT_TRUE(says(text, ",   none <= u <= none\n"));
    EXPECT_TRUE(says(text, "There is no derivative part: kd is not used."));
    EXPECT_FALSE(says(text, "own_derivative"));
    EXPECT_FALSE(says(text, "Licence"));
}

// Reals become integers by what one of them stands for.
TEST(ControllerHeader, InQ31HasItsUnits) {
    ControllerSpec spec = controllers::whole();
    spec.input_full_scale = 4.0;
    const generate::FixedController stepped(spec);
    const FixedPid& fixed = stepped.numbers();
    const std::string text = generate::make_controller_header(spec, "own", "", {});
    EXPECT_NO_THROW(test::compile_example(text, "own", "int32_t r, int32_t y"));
    EXPECT_EQ(number_behind(text, "A fractional PID controller in q31, sampled every "), 0.5);
    EXPECT_TRUE(says(text, " * Full scales: 4 for r and y (--input-scale), 2 for u, the larger of its limits; "));
    const auto per = [&](const std::string& what) {
        return number_behind(text, "#define OWN_Q31_" + what + "(real) OWN_Q31_CLIPPED((real) * ");
    };
    EXPECT_EQ(per("INPUT"), 0x1p29);
    EXPECT_EQ(per("OUTPUT"), 0x1p30);
    EXPECT_EQ(per("KP") * fixed.kp.unit, 1.0);
    EXPECT_EQ(per("KI") * fixed.ki.unit, 1.0);
    EXPECT_EQ(per("KD") * fixed.kd.unit, 1.0);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_INPUT_FULL_SCALE "), 4.0);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_OUTPUT_FULL_SCALE "), 2.0);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_SHIFT_KP "), fixed.kp.shift);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_SHIFT_KI "), fixed.ki.shift);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_SHIFT_KD "), fixed.kd.shift);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_EXTRA "), fixed.extra);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_WEIGHT "), 0x1p30);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_PASSES ") *
                  std::exp2(-number_behind(text, "#define OWN_Q31_PASSES_SHIFT ")),
              0.5);
    EXPECT_EQ(number_behind(text, "S->pid.kp = "), fixed.kp.mantissa);
    EXPECT_EQ(number_behind(text, "S->pid.ki = "), fixed.ki.mantissa);
    EXPECT_EQ(number_behind(text, "S->pid.kd = "), fixed.kd.mantissa);
    EXPECT_FALSE(says(text, "S->pid.passes = "));
}

TEST(ControllerHeader, APrefixIsAnIdentifierOfSixtyLettersAtMost) {
    const auto made = [](const std::string& prefix) {
        return generate::make_controller_header(controllers::whole(), prefix, "", {});
    };
    for (const std::string& prefix : {std::string("9x"), std::string("a@b"), std::string(61, 'a')}) {
        EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)made(prefix); }),
                  "--prefix: expected letters, digits and underscores, found " + prefix);
    }
    const std::string longest(60, 'a');
    EXPECT_TRUE(generate::check_bits_here(generate::written(controllers::whole(), longest, made(longest))).good());
}

}  // namespace
