// Generated controllers in q31: full scales, rounding, limits, and the bits of a header.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "base/rounded_up.hpp"
#include "bench/steppers/controller/certificate.hpp"
#include "bench/steppers/controller/controller_header.hpp"
#include "bench/steppers/controller/loop.hpp"
#include "bench/steppers/controller/report.hpp"
#include "bench/steppers/controller/stepped.hpp"
#include "bench/steppers/controller/stepped_q31.hpp"
#include "bench/steppers/controller/sum_line.hpp"
#include "bench/steppers/controller/written.hpp"
#include "bench/steppers/stepper/verify.hpp"
#include "bench/target/target_rows.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/held.hpp"
#include "glsum/format/fixed.hpp"
#include "glsum/registry.hpp"
#include "tests/drive/plants.hpp"
#include "tests/generate/board_here.hpp"
#include "tests/generate/exact_sum.hpp"

namespace {

using generate::ControllerSpec;
using generate::FixedController;
using Sum = glsum::modes_plain_q31;
__extension__ using Wide = __int128;

// The library's statements with 128 bits where they have 64: other outputs mean that something overflowed there.
namespace wide {
generate::FixedPid numbers;
std::int32_t rounded(Wide value, int shift) {
    return glsum::round_shift(static_cast<std::int64_t>(value), shift).value;
}
#define int64_t Wide
#define number_SHIFT_KP numbers.kp.shift
#define number_SHIFT_KI numbers.ki.shift
#define number_SHIFT_KD numbers.kd.shift
#define number_EXTRA numbers.extra
#define number_WEIGHT numbers.weight
#define number_PASSES numbers.passes.mantissa
#define number_PASSES_SHIFT numbers.passes.shift
#define GLSUM_PID_DESIGN
#define GLSUM_PID_NUMBER(name) (number_##name)
#define GLSUM_PID_ROUND(number, shift) rounded(number, shift)
#include "glsum/model/pid_q31.h"
#undef GLSUM_PID_ROUND
#undef GLSUM_PID_NUMBER
#undef GLSUM_PID_DESIGN
#undef int64_t
}  // namespace wide

ControllerSpec spec_of(double input_full_scale = 2.0) {
    ControllerSpec spec;
    spec.controller.gains = {
        .kp = 0.3, .ki = 0.5, .kd = 0.02, .filter_s = 0.01, .integral_order = 0.9, .derivative_order = 0.7};
    spec.controller.sample_time_s = 0.001;
    spec.controller.low = -2.0;
    spec.controller.high = 2.0;
    spec.controller.setpoint_weight = 0.8;
    spec.input_full_scale = input_full_scale;
    return spec;
}

TEST(FixedPid, GainsAreThoseOfTheFileToTwentyEightBits) {
    for (const double scale : {1e-3, 2.0, 300.0}) {
        const ControllerSpec spec = spec_of(scale);
        const FixedController stepped(spec);
        const generate::FixedPid& fixed = stepped.numbers();
        EXPECT_EQ(fixed.input_full_scale, scale);
        EXPECT_EQ(fixed.output_full_scale, 2.0);
        EXPECT_EQ(fixed.low, INT32_MIN);
        EXPECT_EQ(fixed.high, INT32_MAX);
        for (const auto& [gain, exact] :
             {std::pair(fixed.kp, 0.3), std::pair(fixed.ki, 0.5), std::pair(fixed.kd, 0.02)}) {
            EXPECT_NEAR(gain.mantissa * gain.unit, exact, exact * 0x1p-29) << scale;
            EXPECT_LE(gain.mantissa, 1 << 29);
            EXPECT_GE(gain.shift, 0);
        }
    }
    // Limits of two sizes.
    ControllerSpec spec = spec_of();
    spec.controller.low = -0.5;
    EXPECT_EQ(FixedController(spec).numbers().low, -(1 << 29));
}

TEST(FixedPid, RefusesWhatHasNoScale) {
    const auto says = [](const ControllerSpec& spec) -> std::string {
        try {
            const FixedController stepped(spec);
            return "";
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            return failure.what();
        }
    };
    EXPECT_EQ(says(spec_of()), "");
    for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        EXPECT_NE(says(spec_of(scale)).find("--input-scale: expected a number above 0"), std::string::npos) << scale;
    }
    ControllerSpec spec = spec_of();
    spec.controller.high = std::numeric_limits<double>::infinity();
    EXPECT_NE(says(spec).find("expected low and high"), std::string::npos);
    spec = spec_of(1e7);
    EXPECT_NE(says(spec).find("wider limits or a smaller --input-scale may do"), std::string::npos);
}

// Samples and gains of full scale, limits met and left.
TEST(FixedController, NothingOverflows) {
    for (const double scale : {1e-3, 2.0, 1e4}) {
        const ControllerSpec spec = spec_of(scale);
        FixedController stepped(spec);
        const generate::FixedPid& fixed = stepped.numbers();
        wide::numbers = fixed;
        wide::glsum_pid pid = {0, fixed.kp.mantissa, fixed.ki.mantissa, fixed.kd.mantissa, fixed.low, fixed.high, 0, 0};
        bench::HostLine<Sum> integral(generate::design_of<Sum>(generate::integral_sum(spec), spec));
        bench::HostLine<Sum> derivative(generate::design_of<Sum>(generate::derivative_sum(spec), spec));
        wide::glsum_pid_start(&pid, 0, 0);
        std::mt19937 chance(7);
        const auto extreme = [&] {
            const auto drawn = static_cast<std::uint32_t>(chance());
            return drawn % 3 == 0 ? INT32_MIN : drawn % 3 == 1 ? INT32_MAX : static_cast<std::int32_t>(chance());
        };
        for (int k = 0; k < 20'000; ++k) {
            const std::int32_t setpoint = extreme();
            const std::int32_t measured = extreme();
            const std::int32_t weighted = wide::glsum_pid_weighted(&pid, setpoint, measured);
            const std::int32_t expected = wide::glsum_pid_step(
                &pid, weighted, integral.step(wide::glsum_pid_error(setpoint, measured)), derivative.step(weighted));
            ASSERT_EQ(stepped.step(setpoint, measured), expected) << scale << ' ' << k;
            if (k % 3 == 0) {
                const std::int32_t kp = extreme();
                const std::int32_t ki = extreme();
                const std::int32_t kd = extreme();
                stepped.change(kp, ki, kd);
                wide::glsum_pid_change(&pid, kp, ki, kd);
            }
        }
    }
}

// Of orders and scales the error stays within the bound that the header tells, and the bound is not told in vain.
TEST(FixedController, StaysWithinItsBound) {
    struct Case {
        double lambda;
        double scale;
        double filter_s;
    };
    for (const Case& one : {Case{0.9, 2.0, 0.01}, Case{0.5, 8.0, 0.01}, Case{1.0, 2.0, 0.0}}) {
        ControllerSpec spec = spec_of(one.scale);
        spec.controller.low = -1000.0;  // never met
        spec.controller.high = 1000.0;
        spec.controller.gains.integral_order = one.lambda;
        spec.controller.gains.filter_s = one.filter_s;
        FixedController stepped(spec);
        const generate::FixedError& error = stepped.error();
        const generate::Factors factors = generate::factors_of(spec.controller);
        ExactSum integral(generate::design_of<Sum>(generate::integral_sum(spec), spec));
        ExactSum derivative(generate::design_of<Sum>(generate::derivative_sum(spec), spec));
        long double added = 0.0L;
        long double filtered = 0.0L;
        double most = 0.0;  // of the bound
        std::mt19937 chance(1);
        std::int32_t setpoint = 0;
        for (std::size_t k = 0; k < 20'000; ++k) {
            setpoint = k % 500 == 0 ? static_cast<std::int32_t>(chance()) : setpoint;
            const auto measured = static_cast<std::int32_t>(chance());
            const double unit = one.scale * 0x1p-31;
            const long double e = static_cast<long double>(unit) * (std::int64_t{setpoint} - measured);
            const long double w = static_cast<long double>(unit) * (0.8L * setpoint - measured);
            added += 0.5L * factors.integral * integral.step(e);
            filtered += factors.passes * (derivative.step(w) - filtered);
            const long double u = 0.3L * w + added + 0.02L * factors.derivative * filtered;
            const double own = stepped.step(setpoint, measured) * stepped.numbers().output_unit();
            const double off = std::fabs(static_cast<double>(own - u));
            ASSERT_LE(off, error.after(k + 1)) << one.lambda << ' ' << k;
            most = std::max(most, off / error.after(k + 1));
        }
        EXPECT_GT(most, 0.01) << one.lambda << ' ' << one.scale;
        const std::string text = generate::make_controller_header(spec, "own", "none", {});
        EXPECT_NE(text.find("u is within " + base::rounded_up(error.direct) + " + " +
                            base::rounded_up(error.per_sample) + " n of exact arithmetic"),
                  std::string::npos);
    }
}

// A proportional gain that 28 bits hold exactly errs by roundings alone: of the weighted error, by half a unit of it
// and of its weight's 30 bits times half of full scale; of each product in the unit it is added up in; and of u.
TEST(FixedController, AGainThatIsHeldExactlyErrsByItsRoundings) {
    for (const double scale : {0.5, 2.0}) {
        ControllerSpec spec = spec_of(scale);
        spec.controller.gains = {.kp = 0.25};
        const FixedController stepped(spec);
        const generate::FixedPid& fixed = stepped.numbers();
        const double product = 0.5 * fixed.output_unit() / std::pow(2.0, fixed.extra);
        const double weighted = 0.5 * fixed.error_unit() + 0.5 * scale * 0x1p-30;
        EXPECT_DOUBLE_EQ(stepped.error().per_sample, product);
        EXPECT_DOUBLE_EQ(stepped.error().direct, 0.25 * weighted + product + 0.5 * fixed.output_unit());
        EXPECT_DOUBLE_EQ(stepped.error().after(100), stepped.error().direct + 100.0 * product);
    }
}

// And beside it what the sums are off: of gains that are held nearly, each by its own share, of an error of twice full
// scale; of the filter its decay to 2^-30 and half a unit a step, as many steps as it remembers.
TEST(FixedController, ItsBoundIsThatOfEachRounding) {
    for (const double scale : {0.5, 2.0}) {
        const ControllerSpec spec = spec_of(scale);
        const FixedController stepped(spec);
        const generate::FixedPid& fixed = stepped.numbers();
        const generate::Factors factors = generate::factors_of(spec.controller);
        const double full = 2.0 * scale;
        const double product = 0.5 * fixed.output_unit() / std::pow(2.0, fixed.extra);
        const double weighted = 0.5 * fixed.error_unit() + 0.5 * scale * 0x1p-30;
        struct Line {
            double off;   // of an error of 1
            double most;  // of the sum
            int bits;
        };
        const auto line = [&](const generate::SumOfController& sum) {
            const glsum::Design design = generate::design_of<Sum>(sum, spec);
            const bench::HostLine<Sum> run(design);
            const auto held = glsum::design::held<glsum::Plain, glsum::Q31>(run.state());
            double most = 0.0;
            std::ranges::for_each(held.taps, [&](double tap) { most += std::fabs(tap); });
            std::ranges::for_each(held.modes, [&](const auto& mode) { most += std::fabs(mode.weight) / mode.decay; });
            return Line{glsum::error_bound<Sum>(design, run.state(), 1.0), most, run.state().scale.output_exponent};
        };
        const Line integral = line(generate::integral_sum(spec));
        const Line derivative = line(generate::derivative_sum(spec));
        const auto held = [](const auto& gain) { return gain.mantissa * gain.unit; };
        const double ki = held(fixed.ki) * factors.integral;
        const double per_sample =
            ki * full * integral.off + std::fabs(ki - 0.5 * factors.integral) * full * integral.most + product;
        EXPECT_NEAR(stepped.error().per_sample, per_sample, 1e-9 * per_sample);
        const double kd = held(fixed.kd) * factors.derivative;
        const double passes = std::ldexp(fixed.passes.mantissa, -fixed.passes.shift);
        const double filtered = full * derivative.off + weighted * derivative.most +
                                2.0 * full * derivative.most * 0x1p-30 +
                                0.5 * fixed.error_unit(derivative.bits) / passes;
        const double direct = held(fixed.kp) * weighted + std::fabs(held(fixed.kp) - 0.3) * full + product +
                              0.5 * fixed.output_unit() + kd * filtered +
                              std::fabs(kd - 0.02 * factors.derivative) * full * derivative.most + product;
        EXPECT_NEAR(stepped.error().direct, direct, 1e-9 * direct);
    }
}

TEST(FixedController, ChangesWithoutABumpToTheBit) {
    FixedController stepped(spec_of());
    const generate::FixedPid& fixed = stepped.numbers();
    std::int32_t before = 0;
    for (int k = 0; k < 500; ++k) {
        before = stepped.step(400'000'000, 300'000'000);
    }
    stepped.change(4 * fixed.kp.mantissa, 0, 0);
    EXPECT_EQ(stepped.step(400'000'000, 300'000'000), before);
}

// The integral waits at a limit: a second of the other error brings u back, however long the first one stood.
TEST(FixedController, NothingWindsUp) {
    FixedController stepped(spec_of());
    for (int k = 0; k < 100'000; ++k) {
        (void)stepped.step(1 << 30, 0);
    }
    EXPECT_EQ(stepped.step(1 << 30, 0), INT32_MAX);
    std::int32_t after = 0;
    for (int k = 0; k < 3000; ++k) {
        after = stepped.step(0, 1 << 30);
    }
    EXPECT_LT(after, 1 << 30);
}

TEST(FixedController, AnswersAsSinglePrecisionDoes) {
    const ControllerSpec spec = spec_of();
    FixedController own(spec);
    generate::SteppedController other(spec);
    const generate::CheckRecord record = generate::check_record();
    for (std::size_t k = 0; k < record.setpoint.size() / 4 * 3; ++k) {
        const double setpoint = record.setpoint[k];
        const double measured = record.measured[k];
        ASSERT_NEAR(own.step_real(setpoint, measured), other.step_real(setpoint, measured), 1e-5) << k;
    }
}

TEST(Certificate, InQ31HasTheMarginsOfItsTables) {
    ControllerSpec spec = spec_of();
    const tune::Margins fixed = generate::certify(spec, plants::niopdt(), "pid", "plant");
    spec.input_full_scale = {};
    const tune::Margins single = generate::certify(spec, plants::niopdt(), "pid", "plant");
    EXPECT_TRUE(fixed.stable());
    EXPECT_NEAR(fixed.gain, single.gain, 1e-5 * single.gain);
    EXPECT_NEAR(fixed.phase_deg, single.phase_deg, 1e-3);
}

TEST(Loop, InQ31IsNearFullMemoryAndWithinItsScale) {
    ControllerSpec spec = spec_of();
    spec.horizon = 20'000;
    const generate::LoopDeviation found = generate::measure_loop(spec, plants::niopdt(), spec.horizon);
    ControllerSpec single = spec;
    single.input_full_scale = {};
    // What the tables leave, 2.3e-4 over so few samples, and what the format adds.
    const double tables = generate::measure_loop(single, plants::niopdt(), spec.horizon).header;
    EXPECT_LT(tables, 3e-4);
    EXPECT_NEAR(found.header, tables, 5e-6);
    EXPECT_NE(found.header, tables);
    EXPECT_EQ(generate::first_level(spec), 1.0);
    spec.input_full_scale = 0.5;
    EXPECT_EQ(generate::first_level(spec), 0.25);
    spec.controller.gains.kp = 1.0;  // the output overshoots to more than twice its set point
    spec.controller.gains.ki = 1.0;
    try {
        (void)generate::measure_loop(spec, plants::niopdt(), spec.horizon);
        FAIL() << "an output beyond the input's full scale is not told of";
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_NE(std::string(failure.what()).find("--input-scale: expected at least "), std::string::npos);
    }
}

// The record meets both limits, or they are not compared.
TEST(CheckedBits, OfQ31AreTheLibrarysAndNoOthers) {
    const ControllerSpec spec = spec_of(8.0);
    FixedController stepped(spec);
    const generate::CheckRecord record = generate::check_record();
    int met[2] = {0, 0};
    for (std::size_t k = 0; k < record.setpoint.size(); ++k) {
        const std::int32_t output =
            stepped.step(generate::to_fraction(record.setpoint[k]), generate::to_fraction(record.measured[k]));
        met[0] += output == INT32_MIN ? 1 : 0;
        met[1] += output == INT32_MAX ? 1 : 0;
    }
    EXPECT_GT(met[0], 10);
    EXPECT_GT(met[1], 10);
    EXPECT_LT(met[0] + met[1], 2000);
    const std::string text = generate::make_controller_header(spec, "own", "none", {});
    const auto first_wrong = [&](const std::string& what, const std::string& with) {
        std::string other = text;
        const std::size_t at = other.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        other.replace(at, what.size(), with);
        return generate::check_bits_here(generate::written(spec, "own", other)).first_wrong;
    };
    EXPECT_EQ(first_wrong("kp = 322122547", "kp = 322122547"), 0U);
    EXPECT_LT(first_wrong("kp = 322122547", "kp = 322122551"), 4000U);
    EXPECT_GT(first_wrong("kp = 322122547", "kp = 322122551"), 0U);
    EXPECT_GT(first_wrong("high = 2147483647", "high = 2147483646"), 3000U);
    EXPECT_EQ(first_wrong("? 0U : 1U;\n}\n\n#endif /* OWN_Q31_H */", "? 1U : 0U;\n}\n\n#endif /* OWN_Q31_H */"),
              generate::self_check_failed);
}

TEST(ControllerOnTarget, OfQ31HasTheLibrarysBits) {
    const auto board = board_here();
    if (!board) {
        GTEST_SKIP() << "no board is here";
    }
    const ControllerSpec spec = spec_of();
    const ControllerSpec whole = generate::whole_orders(spec);
    const auto all = generate::check_on_target(
        {generate::written(spec, "own", generate::make_controller_header(spec, "own", "none", {})),
         generate::written(whole, "whole", generate::make_controller_header(whole, "whole", "none", {}))},
        *board, bench::timing_request(TEST_CORES, {"stm32f746-itcm"}));
    ASSERT_EQ(all.size(), 2U);
    EXPECT_TRUE(all[0].bits.good());
    EXPECT_TRUE(all[1].bits.good());
    // Three words a mode: decay, its shift, gain.
    EXPECT_EQ(all[0].cost.table_bytes, 4U * (3 * 15 + 3 * 9));
    EXPECT_GT(all[0].cost.cycles, 3.0 * all[1].cost.cycles);
}

TEST(ControllerReport, OfQ31SaysItsScales) {
    const ControllerSpec spec = spec_of();
    const std::string json = generate::to_json({"pid.json", "pid.h"}, spec);
    for (const char* field : {"\"format\": \"q31\"", "\"input_full_scale\": 2.0", "\"output_full_scale\": 2.0",
                              "\"rounding_error\": ", "\"rounding_error_per_sample\": ", "modes_plain_q31"}) {
        EXPECT_NE(json.find(field), std::string::npos) << field;
    }
}

}  // namespace
