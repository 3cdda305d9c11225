// Generated controllers: what their tables make of sines, and the certificate of a loop with a plant.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/generate/header.hpp"
#include "bench/steppers/controller/certificate.hpp"
#include "bench/steppers/controller/controller_header.hpp"
#include "bench/steppers/controller/report.hpp"
#include "bench/steppers/controller/stepped.hpp"
#include "bench/steppers/controller/written.hpp"
#include "bench/steppers/stepper/verify.hpp"
#include "bench/target/target_rows.hpp"
#include "bench/verify/target_program.hpp"
#include "drive/tune/margins.hpp"
#include "tests/drive/plants.hpp"
#include "tests/generate/board_here.hpp"
#include "tests/generate/controllers.hpp"
#include "tests/generate/pretend_compiler.hpp"
#include "tests/qemu/made_emulator.hpp"
#include "tests/qemu/made_program.hpp"

namespace {

using generate::ControllerSpec;
using tune::Complex;

// The increments of the answer to an impulse fall; their transform is (1 - z^-1) C.
TEST(ControllerResponse, IsTheTransformOfItsSteps) {
    for (const double kd : {0.0, 0.02}) {
        ControllerSpec spec = controllers::fractional();
        spec.controller.gains.kd = kd;
        generate::SteppedController stepped(spec);
        const std::size_t count = 400'000;
        std::vector<double> increments;
        double before = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const double now = stepped.step(k == 0 ? 1.0F : 0.0F, 0.0F);
            increments.push_back(now - before);
            before = now;
        }
        for (const double angle : {0.003, 0.1, 1.0, 3.0}) {
            Complex sum;
            for (std::size_t k = 0; k < count; ++k) {
                sum += increments[k] * std::polar(1.0, -angle * static_cast<double>(k));
            }
            const Complex expected = (1.0 - std::polar(1.0, -angle)) * stepped.response(angle);
            EXPECT_LT(std::abs(sum - expected), 1e-3 * std::abs(expected)) << kd << ' ' << angle;
        }
    }
}

// The integral's weights are off by 5e-4 in all, the derivative's by twice that.
TEST(ControllerResponse, IsNearThatOfTheOrders) {
    const ControllerSpec spec = controllers::fractional();
    const drive::Gains& gains = spec.controller.gains;
    const generate::SteppedController stepped(spec);
    for (const double angle : {1e-4, 1e-3, 0.01, 0.1, 1.0, 3.0}) {
        const tune::Parts parts = tune::controller_parts(gains, 0.001, angle / 0.001);
        const Complex exact = gains.kp + gains.ki * parts.value[1] + gains.kd * parts.value[2];
        const double loss = gains.ki * std::pow(0.001, 0.9) * 5e-4 / std::abs(1.0 - std::polar(1.0, -angle)) +
                            gains.kd * std::pow(0.001, -0.7) * 1e-3 / 11.0;
        EXPECT_LT(std::abs(stepped.response(angle) - exact), 1.1 * loss + 1e-6) << angle;
    }
}

TEST(Certificate, HasTheMarginsOfTheOrders) {
    const ControllerSpec spec = controllers::fractional();
    const tune::Margins margins = generate::certify(spec, plants::niopdt(), "pid", "plant");
    const tune::SampledPlant plant(plants::niopdt(), 0.001, "plant");
    const tune::Margins exact = tune::margins_of({&plant, spec.controller.gains});
    EXPECT_TRUE(margins.stable());
    EXPECT_NEAR(margins.gain, exact.gain, 1e-3 * exact.gain);
    EXPECT_NEAR(margins.phase_deg, exact.phase_deg, 0.1);
    EXPECT_NEAR(margins.sensitivity, exact.sensitivity, 2e-3);
}

// Coarse tables have margins of their own, and lose a loop that the orders hold.
TEST(Certificate, IsOfTheTablesAndNotOfTheOrders) {
    ControllerSpec spec = controllers::fractional();
    const double fine = generate::certify(spec, plants::niopdt(), "pid", "plant").gain;
    spec.max_error = 0.1;
    EXPECT_LT(generate::certify(spec, plants::niopdt(), "pid", "plant").gain, 0.8 * fine);
    spec.max_error = 0.5;
    try {
        (void)generate::certify(spec, plants::niopdt(), "pid", "plant");
        FAIL() << "an unstable loop has a certificate";
    } catch (const glsum::Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("a smaller --max-error may do"), std::string::npos);
    }
}

// Largest |y| of the last eighth of 40 000 samples over that of the eighth before it, after a kick of the set point:
// y_(k+1) = stays y_k + comes u_(k-120), an integrator or a first order behind a hold.
double growth(const ControllerSpec& spec, double stays, double comes) {
    generate::SteppedController stepped(spec);
    const std::size_t count = 40'000;
    const std::size_t delay = 120;
    std::vector<double> u;
    double y = 0.0;
    double largest[2] = {0.0, 0.0};
    for (std::size_t k = 0; k < count; ++k) {
        if (k >= count / 4 * 3) {
            double& here = largest[k >= count / 8 * 7 ? 1 : 0];
            here = std::max(here, std::fabs(y));
        }
        u.push_back(stepped.step(k < 100 ? 1.0F : 0.0F, static_cast<float>(y)));
        y = stays * y + comes * (k >= delay ? u[k - delay] : 0.0);
    }
    return largest[1] / largest[0];
}

TEST(Certificate, EndsWhereTheStepsBeginToGrow) {
    const double a = std::exp(-0.01 / 0.5);
    drive::Model integrator;
    integrator.denominator = {{1.0, 1.0}};
    integrator.delay_s = 1.2;
    struct Case {
        drive::Model plant;
        double stays;
        double comes;
        double order;
        double max_error;
    };
    const drive::Model resting = drive::make_fopdt(1.0, 0.5, 1.2);
    for (const Case& one : {Case{resting, a, 1.0 - a, 0.9, 5e-4}, Case{resting, a, 1.0 - a, 0.9, 0.1},
                            Case{integrator, 1.0, 0.01, 0.9, 5e-4}, Case{integrator, 1.0, 0.01, 0.4, 5e-4}}) {
        ControllerSpec spec = controllers::fractional();
        spec.controller.sample_time_s = 0.01;
        spec.controller.gains.ki = 0.1;
        spec.controller.gains.integral_order = one.order;
        spec.max_error = one.max_error;
        const double gain = generate::certify(spec, one.plant, "pid", "plant").gain;
        const auto with = [&](double factor) {
            ControllerSpec other = spec;
            other.controller.gains.kp *= factor * gain;
            other.controller.gains.ki *= factor * gain;
            other.controller.gains.kd *= factor * gain;
            return other;
        };
        EXPECT_TRUE(generate::certify(with(0.98), one.plant, "pid", "plant").stable());
        EXPECT_LT(growth(with(0.98), one.stays, one.comes), 0.9) << one.order << ' ' << one.max_error;
        EXPECT_GT(growth(with(1.02), one.stays, one.comes), 1.1) << one.order << ' ' << one.max_error;
        try {
            (void)generate::certify(with(1.02), one.plant, "pid.json", "plant.json");
            FAIL() << "an unstable loop has a certificate";
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            EXPECT_EQ(std::string(failure.what())
                          .find("pid.json: expected a stable loop with plant.json, sampled every 0.01 s, found 2 poles "
                                "outside the unit circle (by the argument principle)"),
                      0U);
        }
    }
}

TEST(Certificate, RefusesGainsAgainstThePlant) {
    EXPECT_THROW((void)generate::certify(controllers::fractional(-0.1), plants::niopdt(), "pid", "plant"),
                 glsum::Failure);
    drive::Model other = plants::niopdt();
    other.gain = -1.0;
    EXPECT_TRUE(generate::certify(controllers::fractional(-1.0), other, "pid", "plant").stable());
}

TEST(ControllerReport, HasMarginsAsAFileAndInWords) {
    const ControllerSpec spec = controllers::fractional();
    const tune::Margins margins = generate::certify(spec, plants::niopdt(), "pid", "plant");
    const generate::LoopReport loop{"plant.json", "a plant", {1e-4, 2e-4}, margins};
    const std::string json = generate::to_json({"pid.json", "pid.h", loop}, spec);
    for (const char* field : {"\"schema\": \"glsum-controller-1\"", "\"gain_margin\": ", "\"phase_margin_deg\": ",
                              "\"sensitivity\": ", "\"unstable_poles\": 0", "\"deviation\": 0.0001"}) {
        EXPECT_NE(json.find(field), std::string::npos) << field;
    }
    EXPECT_EQ(generate::to_lines(loop, spec).back(), generate::margins_text(margins) + ".");
    EXPECT_EQ(generate::to_json({"pid.json", "pid.h"}, spec).find("loop"), std::string::npos);
}

// The record meets both limits, or they are not compared.
TEST(CheckedBits, RecordMeetsTheLimits) {
    ControllerSpec spec = controllers::fractional();
    spec.controller.low = -2.0;
    spec.controller.high = 2.0;
    generate::SteppedController stepped(spec);
    const generate::CheckRecord record = generate::check_record();
    ASSERT_EQ(record.setpoint.size(), 4000U);
    ASSERT_EQ(record.measured.size(), 4000U);
    for (std::size_t k = 0; k < 4000; ++k) {
        // Levels of 0.1 to 1, and in the last quarter a hundred times those.
        const float size = k < 3000 ? 1.0F : 100.0F;
        EXPECT_GE(std::fabs(record.setpoint[k]), 0.1F * size) << k;
        EXPECT_LE(std::fabs(record.setpoint[k]), size) << k;
    }
    int low = 0;
    int high = 0;
    for (std::size_t k = 0; k < record.setpoint.size(); ++k) {
        const float output = stepped.step(record.setpoint[k], record.measured[k]);
        low += output == -2.0F ? 1 : 0;
        high += output == 2.0F ? 1 : 0;
    }
    EXPECT_GT(low, 10);
    EXPECT_GT(high, 10);
    EXPECT_LT(low + high, 2000);
}

TEST(CheckedBits, AreTheLibrarysAndNoOthers) {
    ControllerSpec spec = controllers::fractional();
    spec.controller.low = -2.0;
    spec.controller.high = 2.0;
    const std::string text = generate::make_controller_header(spec, "own", "none", {});
    const auto checked = [&](const std::string& what, const std::string& with) {
        std::string other = text;
        const std::size_t at = other.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        other.replace(at, what.size(), with);
        return generate::check_bits_here(generate::written(spec, "own", other));
    };
    EXPECT_NE(text.find("Runs 592 samples and compares the bits"), std::string::npos);
    EXPECT_NE(text.find("k < 592U"), std::string::npos);
    EXPECT_EQ(16 * generate::check_signal().size(), 592U);
    EXPECT_TRUE(checked("kp = 0.3F", "kp = 0.3F").good());
    EXPECT_EQ(checked("kp = 0.3F", "kp = 0.30000004F").first_wrong, 1U);
    // What only a limit shows, behind the first quarter of a thousand samples.
    const generate::CheckedBits limit = checked("high = 2.0F", "high = 2.0000002F");
    EXPECT_GT(limit.first_wrong, 3000U);
    EXPECT_LT(limit.first_wrong, 4000U);
    EXPECT_EQ(checked("? 0U : 1U;\n}\n\n#endif /* OWN_F32_H */", "? 1U : 0U;\n}\n\n#endif /* OWN_F32_H */").first_wrong,
              generate::self_check_failed);
    EXPECT_THROW((void)checked("static inline float own_step_f32", "static inline int own_step_f32"), glsum::Failure);
    EXPECT_EQ(generate::to_text({"there", 4000, 17}),
              "bits of 4000 steps and of the self-check, there: others from step 17 on");
}

// 1 + 15 and 1 + 9 taps and modes: two words a compensated mode and one a plain one, behind ten of the statements'.
TEST(ControllerOnTarget, BitsCyclesAndBytes) {
    const auto board = board_here();
    if (!board) {
        GTEST_SKIP() << "no board is here";
    }
    const ControllerSpec spec = controllers::fractional();
    const ControllerSpec whole = generate::whole_orders(spec);
    const std::string text = generate::make_controller_header(spec, "own", "none", {});
    std::string other = generate::make_controller_header(spec, "other", "none", {});
    other.replace(other.find("kp = 0.3F"), 9, "kp = 0.4F");
    const auto all = generate::check_on_target(
        {generate::written(spec, "own", text),
         generate::written(whole, "whole", generate::make_controller_header(whole, "whole", "none", {})),
         generate::written(spec, "other", other)},
        *board, bench::timing_request(TEST_CORES, {"stm32f746-itcm"}));
    ASSERT_EQ(all.size(), 3U);
    EXPECT_TRUE(all[0].bits.good());
    EXPECT_TRUE(all[1].bits.good());
    EXPECT_EQ(all[2].bits.first_wrong, 1U);
    EXPECT_EQ(generate::integral_sum(spec).taps, 31U);
    EXPECT_EQ(generate::derivative_sum(spec).taps, 19U);
    EXPECT_EQ(all[0].cost.state_bytes, 4U * (10 + 2 * 15 + 9));
    EXPECT_EQ(all[0].cost.table_bytes, 4U * (2 * 15 + 2 * 9));
    EXPECT_EQ(all[1].cost.table_bytes, 4U);
    for (const generate::OnTarget& one : all) {
        EXPECT_LE(one.cost.low, one.cost.cycles);
        EXPECT_GE(one.cost.high, one.cost.cycles);
        // Two bytes an instruction or four; no core issues more than two a cycle.
        EXPECT_GE(static_cast<double>(one.cost.code_bytes), 2.0 * one.cost.instructions);
        EXPECT_GE(2.0 * one.cost.cycles, one.cost.instructions);
    }
    EXPECT_GT(all[0].cost.cycles, 3.0 * all[1].cost.cycles);
    EXPECT_EQ(all[0].cost.instructions, all[2].cost.instructions);
    // Two instructions a cycle, any pair, and nothing else costs.
    const auto ideal = generate::check_on_target({generate::written(spec, "own", text)}, *board,
                                                 bench::timing_request(TEST_CORES, {"m7-ideal"}));
    EXPECT_EQ(ideal.at(0).cost.instructions, all[0].cost.instructions);
    EXPECT_NEAR(ideal.at(0).cost.cycles, 0.5 * all[0].cost.instructions, 0.5);
}

TEST(ControllerSpec, OfWholeOrdersHasTheSameGains) {
    ControllerSpec spec = controllers::fractional();
    spec.controller.high = 3.0;
    const ControllerSpec whole = generate::whole_orders(spec);
    EXPECT_EQ(whole.controller.gains.integral_order, 1.0);
    EXPECT_EQ(whole.controller.gains.derivative_order, 1.0);
    EXPECT_EQ(whole.controller.gains.ki, 0.5);
    EXPECT_EQ(whole.controller.gains.kd, 0.02);
    EXPECT_EQ(whole.controller.high, 3.0);
}

// What the target is to run, compiled and run here: of each stepper what was wrong, its bytes of state and of tables,
// and the calls that are counted.
TEST(TargetSource, AnswersThreeNumbersAStepperAndMakesItsCalls) {
    ASSERT_EQ(generate::answers_a_stepper, 3U);
    const base::Scratch folder;
    const ControllerSpec spec = controllers::fractional();
    const ControllerSpec whole = generate::whole_orders(spec);
    std::string other = generate::make_controller_header(spec, "other", "none", {});
    other.replace(other.find("kp = 0.3F"), 9, "kp = 0.4F");
    const std::vector<generate::WrittenStepper> steppers = {
        generate::written(spec, "other", other),
        generate::written(whole, "whole", generate::make_controller_header(whole, "whole", "none", {}))};
    for (const generate::WrittenStepper& stepper : steppers) {
        generate::write_file(folder.file((stepper.prefix + ".h").c_str()), stepper.text);
    }
    generate::write_file(folder.file("run.c"), generate::target_source(steppers) + R"(#include <stdio.h>
static unsigned same = 1U;
void glsum_make_calls(unsigned taps, unsigned software_double, void (*make)(unsigned call))
{
    unsigned call;
    other_f32_instance copy;
    memcpy(&copy, &line_other, sizeof copy);
    printf("calls %u %u\n", taps, software_double);
    for (call = 0U; call < 5000U; ++call) {
        make(call);
        (void)other_step_f32(&copy, input0_other[call % 4000U], input1_other[call % 4000U]);
    }
    same = same && (make != calls[0] || memcmp(&copy, &line_other, sizeof copy) == 0);
}
int main(void)
{
    unsigned number;
    for (number = 0U; number < glsum_verified_count; ++number) {
        printf("%u %u\n", number, glsum_verify(number));
    }
    printf("same %u\n", same);
    printf("%u %u\n", (unsigned)sizeof(other_f32_instance), (unsigned)sizeof(whole_f32_instance));
    return 0;
}
)");
    const std::string program = folder.file("run").string();
    generate::compile("cc -std=c99 -O1 -w '" + folder.file("run.c").string() + "' -lm -o '" + program + "' && '" +
                          program + "' >'" + folder.file("said").string() + "'",
                      "cc");
    std::ifstream said(folder.file("said"));
    std::string text((std::istreambuf_iterator<char>(said)), {});
    const std::size_t sizes = text.rfind('\n', text.size() - 2) + 1;
    const std::size_t space = text.find(' ', sizes);
    const std::string of_other = text.substr(sizes, space - sizes);
    const std::string of_whole = text.substr(space + 1, text.size() - space - 2);
    // Those calls are the header's own steps over the record, again and again. The tables' words are of the orders: the
    // integral's 15 modes of 31 taps and the derivative's 9, of whole orders one sum's.
    EXPECT_EQ(text.substr(0, sizes), "calls 32 0\n0 1\n1 " + of_other + "\n2 " + std::to_string(4 * (2 * 15 + 2 * 9)) +
                                         "\ncalls 32 0\n3 0\n4 " + of_whole + "\n5 4\nsame 1\n");
}

// From a board and a compiler that are pretended: what each stepper answered, its counts and its cycles.
TEST(ControllerOnTarget, EachStepperHasItsAnswersCountsAndCycles) {
    const test::PretendCompiler compiler;
    compiler.flags("-mcpu=cortex-m7 -O3");
    test::MadeElf made = test::program();
    made.symbols.push_back({"count_own", 0x701, 0x60, true});
    made.symbols.push_back({"count_other", 0x781, 0x1C, true});
    made.write(compiler.linked());
    qemu::Board board = compiler.board;
    board.cores = TEST_CORES;
    std::string losses;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        losses += " 0";
    }
    // Steady are the 32 steps behind as many others.
    board.emulator = test::made_emulator(compiler.scratch, fmt::format(R"sh(
{{ echo "calls 1792 1 100 1 1 1"; echo "calls 1792 32 99 9 9 9"; echo "calls 1792 32 45 5 4 2"
   echo "calls 1920 1 200 1 1 1"; echo "calls 1920 32 99 9 9 9"; echo "calls 1920 32 380 5 6 2"; echo end; }} >"$(of out)"
{{ echo "calls 1 1792 100 core 3 2 2 2{0} 0"; echo "calls 34 1792 9 core 3 180 150 190{0} 0"; echo end
   echo "calls 1 1920 200 core 3 2 2 2{0} 0"; echo "calls 34 1920 9 core 3 1700 1600 1800{0} 0"; echo end; }} >"$(of times)"
echo row 0 0; echo row 1 196; echo row 2 192; echo row 3 17; echo row 4 48; echo row 5 4
)sh",
                                                                       losses));
    const auto stepper = [](const char* prefix, std::size_t steps) {
        return generate::WrittenStepper{.prefix = prefix,
                                        .text = "",
                                        .format = "f32",
                                        .inputs = {std::vector<std::uint32_t>(steps)},
                                        .expected = std::vector<std::uint32_t>(steps),
                                        .tables = {}};
    };
    const auto found = generate::check_on_target({stepper("own", 400), stepper("other", 300)}, board,
                                                 bench::timing_request(TEST_CORES, {"m7-ideal"}));
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(found[0].bits.good());
    EXPECT_EQ(found[1].bits.first_wrong, 17U);
    EXPECT_EQ(found[0].bits.steps, 400U);
    EXPECT_EQ(found[1].bits.steps, 300U);
    EXPECT_EQ(found[0].bits.where, "on the emulated Cortex-M7");
    EXPECT_EQ(found[0].cost.where, "emulated Cortex-M7");
    EXPECT_EQ(found[0].cost.state_bytes, 196U);
    EXPECT_EQ(found[0].cost.table_bytes, 192U);
    EXPECT_EQ(found[0].cost.code_bytes, 0x60U);
    EXPECT_EQ(found[1].cost.state_bytes, 48U);
    EXPECT_EQ(found[1].cost.table_bytes, 4U);
    EXPECT_EQ(found[1].cost.code_bytes, 0x1CU);
    EXPECT_DOUBLE_EQ(found[0].cost.instructions, 45.0);
    EXPECT_DOUBLE_EQ(found[1].cost.instructions, 380.0);
    EXPECT_DOUBLE_EQ(found[0].cost.cycles, 90.0);
    EXPECT_DOUBLE_EQ(found[0].cost.low, 75.0);
    EXPECT_DOUBLE_EQ(found[0].cost.high, 95.0);
    EXPECT_DOUBLE_EQ(found[1].cost.cycles, 850.0);
    // The folder that is compiled has each header; the program counts its own step.
    EXPECT_NE(compiler.calls().find("counted.c"), std::string::npos);
}

TEST(ControllerReport, HasTheCost) {
    generate::ControllerReport report{"pid.json", "pid.h"};
    EXPECT_EQ(generate::cost_table(report), "");
    report.core = "some-core";
    report.cost = {292.0, 271.0, 313.0, 339.0, 1636, 192, 196};
    report.whole = {46.0, 39.5, 50.5, 47.0, 244, 4, 48};
    const std::string text = generate::cost_table(report);
    EXPECT_NE(
        text.find("  pid.json                        292.0    271.0 to 313.0         339.0     196     192    1636"),
        std::string::npos)
        << text;
    EXPECT_NE(
        text.find("  integer PID, the same gains      46.0      39.5 to 50.5          47.0      48       4     244"),
        std::string::npos)
        << text;
    const std::string json = generate::to_json(report, controllers::fractional());
    for (const char* field : {"\"core\": \"some-core\"", "\"model_cycles_low\": 271.0", "\"code_bytes\": 1636",
                              "\"cost_of_integer_pid\": ", "\"state_bytes\": 48"}) {
        EXPECT_NE(json.find(field), std::string::npos) << field;
    }
}

}  // namespace
