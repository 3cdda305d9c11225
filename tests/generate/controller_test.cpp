// Generated controllers: what their tables make of sines, and the certificate of a loop with a plant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "bench/generate/header.hpp"
#include "bench/steppers/controller/certificate.hpp"
#include "bench/steppers/controller/controller_header.hpp"
#include "bench/steppers/controller/report.hpp"
#include "bench/steppers/controller/stepped.hpp"
#include "bench/steppers/controller/written.hpp"
#include "bench/steppers/stepper/verify.hpp"
#include "bench/target/target_rows.hpp"
#include "drive/tune/margins.hpp"
#include "tests/drive/plants.hpp"
#include "tests/generate/board_here.hpp"

namespace {

using generate::ControllerSpec;
using tune::Complex;

ControllerSpec spec_of(double scale = 1.0) {
    ControllerSpec spec;
    spec.controller.gains = {.kp = 0.3 * scale,
                             .ki = 0.5 * scale,
                             .kd = 0.02 * scale,
                             .filter_s = 0.01,
                             .integral_order = 0.9,
                             .derivative_order = 0.7};
    spec.controller.sample_time_s = 0.001;
    return spec;
}

// The increments of the answer to an impulse fall; their transform is (1 - z^-1) C.
TEST(ControllerResponse, IsTheTransformOfItsSteps) {
    for (const double kd : {0.0, 0.02}) {
        ControllerSpec spec = spec_of();
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
    const ControllerSpec spec = spec_of();
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
    const ControllerSpec spec = spec_of();
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
    ControllerSpec spec = spec_of();
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
        ControllerSpec spec = spec_of();
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
    EXPECT_THROW((void)generate::certify(spec_of(-0.1), plants::niopdt(), "pid", "plant"), glsum::Failure);
    drive::Model other = plants::niopdt();
    other.gain = -1.0;
    EXPECT_TRUE(generate::certify(spec_of(-1.0), other, "pid", "plant").stable());
}

TEST(ControllerReport, HasMarginsAsAFileAndInWords) {
    const ControllerSpec spec = spec_of();
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
    ControllerSpec spec = spec_of();
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
    ControllerSpec spec = spec_of();
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
    const ControllerSpec spec = spec_of();
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
    const std::string json = generate::to_json(report, spec_of());
    for (const char* field : {"\"core\": \"some-core\"", "\"model_cycles_low\": 271.0", "\"code_bytes\": 1636",
                              "\"cost_of_integer_pid\": ", "\"state_bytes\": 48"}) {
        EXPECT_NE(json.find(field), std::string::npos) << field;
    }
}

}  // namespace
