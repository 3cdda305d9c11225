// The numbers of generated controllers where they are exact in binary, and what their headers are checked over.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/failure.hpp"
#include "bench/steppers/controller/certificate.hpp"
#include "bench/steppers/controller/fixed_pid.hpp"
#include "bench/steppers/controller/held_controller.hpp"
#include "bench/steppers/controller/stepped.hpp"
#include "bench/steppers/controller/stepped_q31.hpp"
#include "bench/steppers/controller/sum_line.hpp"
#include "bench/steppers/controller/written.hpp"
#include "glsum/registry.hpp"
#include "tests/drive/plants.hpp"
#include "tests/generate/controllers.hpp"
#include "tests/refusal.hpp"

namespace {

using generate::ControllerSpec;
using generate::FixedPid;

TEST(ControllerSpec, HasItsPowersOfTheStep) {
    drive::Fopid controller;
    controller.sample_time_s = 0.25;
    controller.gains = {.kp = 1.0, .filter_s = 0.75, .integral_order = 0.5, .derivative_order = 0.5};
    const generate::Factors factors = generate::factors_of(controller);
    EXPECT_DOUBLE_EQ(factors.passes, 0.25);
    EXPECT_DOUBLE_EQ(factors.integral, 0.5);
    EXPECT_DOUBLE_EQ(factors.derivative, 2.0);
    // The sum of a whole order ends: of order 0 behind its first weight, of order 1 behind its second.
    EXPECT_EQ(generate::integral_sum(controllers::whole()).taps, 1U);
    EXPECT_EQ(generate::integral_sum(controllers::whole()).order, 0.0);
    EXPECT_EQ(generate::derivative_sum(controllers::whole()).taps, 2U);
    EXPECT_EQ(generate::derivative_sum(controllers::whole()).order, 1.0);
}

// An error's unit and an output's are 2^-30. So an error of full scale moves the output by 1/4 of full scale and by 2,
// with h of 1/2 and three bits of the sum, and by nothing. Mantissas of 29 bits reach 2, 16 and 8 full scales. With the
// integral's own one these are 27, of 5 bits. Of 61 bits 31 are the output's, and 25 are left.
TEST(FixedPid, FillsTheIntegralsBits) {
    drive::Fopid controller;
    controller.gains = {.kp = 0.25, .ki = 0.5};
    controller.sample_time_s = 0.5;
    controller.low = -2.0;
    controller.high = 1.0;
    controller.setpoint_weight = 0.5;
    const FixedPid fixed = generate::fixed_pid(controller, 1.0, 3, 1);
    EXPECT_EQ(fixed.input_full_scale, 1.0);
    EXPECT_EQ(fixed.output_full_scale, 2.0);
    EXPECT_EQ(fixed.error_unit(), 0x1p-30);
    EXPECT_EQ(fixed.error_unit(3), 0x1p-27);
    EXPECT_EQ(fixed.output_unit(), 0x1p-30);
    EXPECT_EQ(fixed.extra, 25);
    EXPECT_EQ(fixed.kp.mantissa, 1 << 28);
    EXPECT_EQ(fixed.kp.unit, 0x1p-30);
    EXPECT_EQ(fixed.kp.shift, 30 - 25);
    EXPECT_EQ(fixed.ki.mantissa, 1 << 28);
    EXPECT_EQ(fixed.ki.unit, 0x1p-29);  // without h: what h times it makes of the sum is 2^-27
    EXPECT_EQ(fixed.ki.shift, 27 - 25);
    EXPECT_EQ(fixed.kd.mantissa, 0);
    EXPECT_EQ(fixed.kd.unit, 0x1p-30);  // it may become 1 of them, by 1 / h and a bit of the sum
    EXPECT_EQ(fixed.kd.shift, 28 - 25);
    EXPECT_EQ(fixed.weight, 1 << 29);
    EXPECT_EQ(fixed.passes.mantissa, 1 << 30);  // no filter
    EXPECT_EQ(fixed.passes.shift, 30);
    EXPECT_EQ(fixed.low, INT32_MIN);
    EXPECT_EQ(fixed.high, 1 << 30);
}

// A gain may be any; its mantissa has 29 bits down to 2^-40 full scales an error's, and fewer below.
TEST(FixedPid, KeepsTheBitsOfSmallGains) {
    const auto mantissa_of = [](double gain) {
        drive::Fopid controller;
        controller.gains = {.kp = gain, .ki = 0.5};
        controller.sample_time_s = 0.5;
        controller.low = -2.0;
        controller.high = 2.0;
        return generate::fixed_pid(controller, 1.0, 0, 0).kp.mantissa;
    };
    EXPECT_EQ(mantissa_of(0x1.8p-40), 3 << 27);
    EXPECT_EQ(mantissa_of(0x1p-40), 1 << 28);
    EXPECT_EQ(mantissa_of(-0x1p-40), -(1 << 28));
    EXPECT_EQ(mantissa_of(0x1p-41), 1 << 27);
    EXPECT_EQ(mantissa_of(0x1p-50), 1 << 18);
}

// Eight bits behind the output's are enough and seven are not: one gain of 2^19 reaches 2^22 full scales.
TEST(FixedPid, RefusesGainsThatLeaveTooFewBits) {
    drive::Fopid controller;
    controller.gains = {.kp = 0x1.fp18};
    controller.sample_time_s = 1.0;
    controller.low = -2.0;
    controller.high = 2.0;
    EXPECT_EQ(generate::fixed_pid(controller, 1.0, 0, 0).extra, 8);
    controller.gains = {.kp = -0x1p19, .ki = 0x1p17};
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)generate::fixed_pid(controller, 1.0, 0, 0); }),
              "--format q31: expected gains by which an error of full scale moves the output by less than 2.62e+05 of "
              "its full scales, found 6.55e+05: wider limits or a smaller --input-scale may do");
    controller.gains = {.kp = 1e300};
    EXPECT_NE(test::refusal(glsum::Exit::bad_input, [&] { (void)generate::fixed_pid(controller, 1e300, 0, 0); })
                  .find("found inf: "),
              std::string::npos);
}

TEST(HeldController, OfWholeOrdersHasTheResponseOfItsFormula) {
    using Complex = std::complex<double>;
    for (const bool in_q31 : {false, true}) {
        for (const double kd : {0.0, 0.25}) {
            ControllerSpec spec = controllers::whole();
            spec.controller.gains.kd = kd;
            if (in_q31) {
                spec.input_full_scale = 1.0;
            }
            const auto held = generate::stepped_of(spec);
            for (const double angle : {0.01, 0.7, 3.0, std::numbers::pi}) {
                const Complex delay = std::polar(1.0, -angle);
                const Complex derivative = kd / 0.5 * (1.0 - delay) * 0.5 / (1.0 - 0.5 * delay);
                const Complex expected = 0.5 + 0.5 / (1.0 - delay) + derivative;
                EXPECT_LT(std::abs(held->response(angle) - expected), 1e-8 * std::abs(expected)) << angle;
            }
            EXPECT_EQ(held->slowest(), kd == 0.0 ? 1.0 : 0.5);
        }
    }
}

// Of the two sums' modes and of the filter, each as single precision holds it.
TEST(HeldController, ItsSlowestStateIsAModeOrTheFilter) {
    const auto slowest_mode = [](const glsum::Design& design, double so_far) {
        for (const glsum::Mode& mode : design.modes) {
            so_far = std::min(so_far, mode.decay);
        }
        return so_far;
    };
    ControllerSpec spec = controllers::fractional();
    const double integral =
        slowest_mode(generate::design_of<glsum::modes_compensated_f32>(generate::integral_sum(spec), spec), 1.0);
    const double both =
        slowest_mode(generate::design_of<glsum::modes_plain_f32>(generate::derivative_sum(spec), spec), integral);
    EXPECT_LT(both, 0.001 / 0.011);
    EXPECT_NEAR(generate::SteppedController(spec).slowest(), both, 1e-6 * both);
    spec.controller.gains.filter_s = 1e9;
    EXPECT_NEAR(generate::SteppedController(spec).slowest(), 1e-12, 1e-18);
    spec.controller.gains.kd = 0.0;
    EXPECT_NEAR(generate::SteppedController(spec).slowest(), integral, 1e-6 * integral);
}

// The reading goes a hundredth of the way to the set point with each sample, in noise of a hundredth; from three
// quarters on all is a hundred times as large.
TEST(CheckRecord, ItsReadingFollowsLateAndNoisily) {
    const generate::CheckRecord record = generate::check_record();
    double reading = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    int above = 0;
    int below = 0;
    for (std::size_t k = 0; k < record.measured.size(); ++k) {
        const double size = k < 3000 ? 1.0 : 100.0;
        const double noise = (record.measured[k] / size - reading) / 0.01;
        ASSERT_LE(std::fabs(noise), 1.002) << k;  // single precision
        sum += noise;
        squares += noise * noise;
        const double setpoint = record.setpoint[k] / size;
        reading += 0.01 * (setpoint - reading);
        above += setpoint > 0.0 ? 1 : 0;
        below += setpoint < 0.0 ? 1 : 0;
    }
    // Even in [-1, 1): of 4000 the mean to 0.009, and the mean square, 1/3, to 0.005.
    EXPECT_NEAR(sum / 4000.0, 0.0, 0.04);
    EXPECT_NEAR(squares / 4000.0, 1.0 / 3.0, 0.025);
    EXPECT_GT(above, 500);
    EXPECT_GT(below, 500);
}

TEST(CheckRecord, InQ31FullScaleIsSixteen) {
    EXPECT_EQ(generate::to_fraction(1.0F), 1 << 27);
    EXPECT_EQ(generate::to_fraction(-0.5F), -(1 << 26));
    EXPECT_EQ(generate::to_fraction(16.0F), INT32_MAX);
    EXPECT_EQ(generate::to_fraction(-16.5F), INT32_MIN);
}

TEST(WrittenController, HoldsTheRecordAndTheLibrarysOutputs) {
    const generate::CheckRecord record = generate::check_record();
    const ControllerSpec spec = controllers::fractional();
    const generate::WrittenStepper single = generate::written(spec, "own", "its text");
    generate::SteppedController stepped(spec);
    EXPECT_EQ(single.prefix, "own");
    EXPECT_EQ(single.text, "its text");
    EXPECT_EQ(single.format, "f32");
    ASSERT_EQ(single.inputs.size(), 2U);
    ASSERT_EQ(single.inputs[0].size(), record.setpoint.size());
    ASSERT_EQ(single.inputs[1].size(), record.setpoint.size());
    ASSERT_EQ(single.expected.size(), record.setpoint.size());
    for (std::size_t k = 0; k < record.setpoint.size(); ++k) {
        ASSERT_EQ(std::bit_cast<float>(single.inputs[0][k]), record.setpoint[k]) << k;
        ASSERT_EQ(std::bit_cast<float>(single.inputs[1][k]), record.measured[k]) << k;
        ASSERT_EQ(std::bit_cast<float>(single.expected[k]), stepped.step(record.setpoint[k], record.measured[k])) << k;
    }
    ControllerSpec in_q31 = spec;
    in_q31.controller.low = -2.0;
    in_q31.controller.high = 2.0;
    in_q31.input_full_scale = 8.0;
    const generate::WrittenStepper fixed = generate::written(in_q31, "own", "");
    generate::FixedController own(in_q31);
    EXPECT_EQ(fixed.format, "q31");
    ASSERT_EQ(fixed.expected.size(), record.setpoint.size());
    for (std::size_t k = 0; k < record.setpoint.size(); ++k) {
        const std::int32_t setpoint = generate::to_fraction(record.setpoint[k]);
        const std::int32_t measured = generate::to_fraction(record.measured[k]);
        ASSERT_EQ(std::bit_cast<std::int32_t>(fixed.inputs[0][k]), setpoint) << k;
        ASSERT_EQ(std::bit_cast<std::int32_t>(fixed.inputs[1][k]), measured) << k;
        ASSERT_EQ(std::bit_cast<std::int32_t>(fixed.expected[k]), own.step(setpoint, measured)) << k;
    }
}

// A sum of one coefficient has none: that of an integral of order 1. Without a derivative there is no sum of it.
TEST(WrittenController, NamesTheTablesThatItHas) {
    using Names = std::vector<std::string>;
    const auto tables_of = [](const ControllerSpec& spec) { return generate::written(spec, "own", "").tables; };
    ControllerSpec spec = controllers::fractional();
    EXPECT_EQ(tables_of(spec), (Names{"integral", "derivative"}));
    EXPECT_EQ(tables_of(generate::whole_orders(spec)), Names{"derivative"});
    spec.controller.gains.kd = 0.0;
    EXPECT_EQ(tables_of(spec), Names{"integral"});
    EXPECT_EQ(tables_of(generate::whole_orders(spec)), Names{});
}

// A gain alone has no table that could be off, and integrates nothing.
TEST(Certificate, OfAGainAloneIsTheExactLoops) {
    ControllerSpec spec = controllers::fractional();
    spec.controller.gains = {.kp = 0.5};
    const tune::SampledPlant plant(plants::niopdt(), 0.001, "plant");
    const tune::Margins exact = tune::margins_of({&plant, spec.controller.gains});
    const tune::Margins found = generate::certify(spec, plants::niopdt(), "pid", "plant");
    EXPECT_TRUE(found.stable());
    EXPECT_NEAR(found.gain, exact.gain, 1e-6 * exact.gain);
    EXPECT_NEAR(found.sensitivity, exact.sensitivity, 1e-6);
}

// Against the plant's sign a slow integral runs away along the real axis, with exact orders too.
TEST(Certificate, OneUnstablePoleIsOne) {
    ControllerSpec spec = controllers::fractional();
    spec.controller.gains.kp *= -0.1;
    spec.controller.gains.ki *= -0.1;
    spec.controller.gains.kd *= -0.1;
    EXPECT_EQ(
        test::refusal(glsum::Exit::bad_input, [&] { (void)generate::certify(spec, plants::niopdt(), "pid", "plant"); }),
        "pid: expected a stable loop with plant, sampled every 0.001 s, found 1 pole outside the unit circle (by "
        "the argument principle)");
}

}  // namespace
