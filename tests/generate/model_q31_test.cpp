// Generated models in q31: that nothing overflows, rounding, and the bits of a header.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "base/rounded_up.hpp"
#include "bench/steppers/model/model_choice.hpp"
#include "bench/steppers/model/model_header.hpp"
#include "bench/steppers/model/report.hpp"
#include "bench/steppers/model/stepped_q31.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/target/target_rows.hpp"
#include "glsum/bound.hpp"
#include "tests/generate/board_here.hpp"
#include "tests/generate/exact_sum.hpp"

namespace {

using generate::FixedModel;
using generate::ModelSpec;

// Model (12) without its dead time but for three samples.
drive::Model niopdt() {
    drive::Model model;
    model.denominator = {{0.18234, 1.9909}, {0.65536, 0.98319}, {0.9992, 0.0}};
    model.delay_s = 0.003;
    return model;
}

ModelSpec two_and_eight(double scale = 2.0) {
    ModelSpec spec{niopdt(), 0.001, 10'000};
    spec.memory = {18, 8};
    spec.input_full_scale = scale;
    return spec;
}

ModelSpec of_second_order() {
    ModelSpec spec = two_and_eight(3.0);
    spec.writing = drive::Writing::bdf2;
    spec.memory = {27, 11};
    return spec;
}

ModelSpec of_first_order_lag(double lag_s) {
    ModelSpec spec{drive::make_fopdt(-2.0, lag_s, 0.0), 0.001, 5000};
    spec.input_full_scale = 1.0;
    return spec;
}

// The input that swings y, or its increment, the most: each sample with the sign of what it makes at the end.
std::vector<std::int32_t> worst_input(const ModelSpec& spec, bool of_increment) {
    std::vector<double> impulse(spec.samples, 0.0);
    impulse[0] = 1.0;
    const std::vector<double> answer = generate::full_memory(spec, impulse);
    std::vector<std::int32_t> input;
    for (std::size_t k = 0; k < spec.samples; ++k) {
        const std::size_t ago = spec.samples - 1 - k;
        const double made = answer[ago] - (of_increment && ago > 0 ? answer[ago - 1] : 0.0);
        input.push_back(made < 0.0 ? INT32_MIN : INT32_MAX);
    }
    return input;
}

TEST(FixedModel, NoInputWithinScaleOverflows) {
    for (const ModelSpec& spec :
         {two_and_eight(), of_second_order(), of_first_order_lag(0.25), of_first_order_lag(1e-5)}) {
        const generate::Swing swing = generate::swing_of(spec);
        for (const bool of_increment : {false, true}) {
            FixedModel stepped(spec, swing);
            double most = 0.0;
            for (const std::int32_t input : worst_input(spec, of_increment)) {
                most = std::max(most, std::fabs(static_cast<double>(stepped.step(input))));
            }
            EXPECT_EQ(stepped.saturations(), 0U);
            EXPECT_LT(most, INT32_MAX);
            // Not more room than two powers of two.
            EXPECT_GT(of_increment ? 0x1p31 : most, 0x1p31 / 4.1) << spec.step_s;
        }
    }
}

TEST(FixedModel, SaturatesWhereItLeavesItsScale) {
    drive::Model integrator;
    integrator.denominator = {{1.0, 1.0}};
    ModelSpec spec{integrator, 0.001, 1000};
    spec.input_full_scale = 1.0;
    FixedModel stepped(spec, generate::swing_of(spec));
    std::int32_t output = 0;
    for (int k = 0; k < 10'000; ++k) {
        const std::int32_t before = output;
        output = stepped.step(INT32_MAX);
        ASSERT_GE(output, before) << k;
        ASSERT_TRUE(k > 1000 || output < INT32_MAX) << k;
    }
    EXPECT_EQ(output, INT32_MAX);
}

TEST(FixedModel, StaysWithinItsBound) {
    for (const ModelSpec& spec : {two_and_eight(), of_second_order(), of_first_order_lag(0.25)}) {
        FixedModel stepped(spec, generate::swing_of(spec));
        const glsum::ModelDesign& numbers = stepped.design().design();
        const glsum::PastTable none{0.0, {}};
        const glsum::PastTable& table = numbers.tables.empty() ? none : numbers.tables[0];
        ExactSum past(table.design());
        std::vector<long double> waiting(numbers.delay + 1, 0.0L);
        long double newest = 0.0L;
        long double output = 0.0L;
        std::mt19937 chance(3);
        std::int32_t input = 0;
        double most = 0.0;
        for (std::size_t k = 0; k < spec.samples; ++k) {
            input = k % 40 == 0 ? static_cast<std::int32_t>(chance()) : input;
            waiting.push_back(static_cast<long double>(*spec.input_full_scale) * 0x1p-31L * input);
            const long double acting = numbers.half_input ? 0.5L * (waiting[k] + waiting[k + 1]) : waiting[k];
            newest = numbers.input * acting - numbers.constant * output - table.factor * past.step(newest);
            output += newest;
            const double own = std::ldexp(stepped.output_full_scale(), -31) * stepped.step(input);
            const double off = std::fabs(static_cast<double>(own - output));
            ASSERT_LE(off, stepped.error()) << k;
            most = std::max(most, off / stepped.error());
        }
        EXPECT_GT(most, 0.005);
        EXPECT_NE(generate::make_model_header(spec, "own", "none", {})
                      .find("y is within " + base::rounded_up(stepped.error()) + " of exact arithmetic"),
                  std::string::npos);
    }
}

// The sum of what each step rounds, by the formats alone: an increment's products to half of its unit and their factors
// to 2^-31 of themselves, y to half of its unit where it is multiplied, the mean of two inputs down to a half.
TEST(FixedModel, ItsBoundIsThatOfEachRounding) {
    using Kernel = glsum::modes_plain_q31;
    for (const ModelSpec& spec : {two_and_eight(), of_second_order(), of_first_order_lag(0.25)}) {
        const generate::Swing swing = generate::swing_of(spec);
        const FixedModel stepped(spec, swing);
        const glsum::ModelDesign& numbers = stepped.design().design();
        const double fed_back = 1.0 / (1.0 - stepped.design().loop_gain());
        const double input = std::fabs(numbers.input);
        const double output_scale = stepped.output_full_scale() / *spec.input_full_scale;
        const double scale = std::exp2(std::ceil(std::log2(1.01 * fed_back * input * swing.increments)));
        const double product = 0.5 * scale * 0x1p-31;
        double each = product + input * (numbers.half_input ? 1.5 : 1.0) * 0x1p-31;
        if (numbers.constant != 0.0) {
            each += product + 1.5 * std::fabs(numbers.constant) * output_scale * 0x1p-31;
        }
        for (const glsum::PastTable& table : numbers.tables) {
            const bench::HostLine<Kernel> sum(table.design());
            const double unit = std::exp2(sum.state().scale.output_exponent - 31);
            each += product + std::fabs(table.factor) * scale *
                                  (unit + glsum::error_bound<Kernel>(table.design(), sum.state(), 1.0));
        }
        const double wanted = *spec.input_full_scale * (each * swing.output * fed_back + 0.5 * output_scale * 0x1p-31);
        EXPECT_NEAR(stepped.error(), wanted, 1e-9 * wanted);
        EXPECT_EQ(numbers.tables.empty(), spec.samples == 5000);  // with and without
    }
}

TEST(ModelChoice, InQ31KeepsItsError) {
    for (const double scale : {1e-3, 100.0}) {
        const generate::ModelChoice choice = generate::choose_model(niopdt(), 0.001, 1e-3, 10'000, scale);
        EXPECT_EQ(std::string(choice.spec.kernel()), "modes_plain_q31");
        EXPECT_FALSE(choice.spec.compensated);
        EXPECT_LE(choice.errors.step, 1e-3);
        EXPECT_LE(choice.errors.random, 1e-3);
        EXPECT_GT(choice.errors.step, 0.0);
    }
}

TEST(ModelHeader, InQ31HasTheLibrarysBitsAndNoOthers) {
    for (const ModelSpec& spec : {two_and_eight(), of_second_order(), of_first_order_lag(0.25)}) {
        const std::string text = generate::make_model_header(spec, "own", "none", {});
        EXPECT_TRUE(generate::check_bits_here(generate::written(spec, "own", text)).good());
    }
    const ModelSpec spec = two_and_eight();
    const std::string text = generate::make_model_header(spec, "own", "none", {});
    const auto first_wrong = [&](const std::string& what, const std::string& with) {
        std::string other = text;
        const std::size_t at = other.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        other.replace(at, what.size(), with);
        return generate::check_bits_here(generate::written(spec, "own", other)).first_wrong;
    };
    EXPECT_EQ(first_wrong("#define OWN_Q31_WAITING 4U", "#define OWN_Q31_WAITING 3U"), 4U);
    EXPECT_GT(first_wrong("#define OWN_Q31_FACTOR_NEGATIVE 1", "#define OWN_Q31_FACTOR_NEGATIVE 0"), 4U);
    EXPECT_EQ(first_wrong("? 0U : 1U;\n}\n\n#endif /* OWN_Q31_H */", "? 1U : 0U;\n}\n\n#endif /* OWN_Q31_H */"),
              generate::self_check_failed);
}

// Three words a mode; the sum has one tap.
TEST(ModelOnTarget, InQ31HasTheLibrarysBits) {
    const auto board = board_here();
    if (!board) {
        GTEST_SKIP() << "no board is here";
    }
    std::vector<generate::WrittenStepper> all;
    for (const auto& [prefix, spec] : {std::pair("own", two_and_eight()), std::pair("second", of_second_order()),
                                       std::pair("lag", of_first_order_lag(0.25))}) {
        all.push_back(generate::written(spec, prefix, generate::make_model_header(spec, prefix, "none", {})));
    }
    const auto found = generate::check_on_target(all, *board, bench::timing_request(TEST_CORES, {"stm32f746-itcm"}));
    ASSERT_EQ(found.size(), 3U);
    for (const generate::OnTarget& one : found) {
        EXPECT_TRUE(one.bits.good());
    }
    EXPECT_EQ(found[0].cost.table_bytes, 4U * 3 * 8);
    EXPECT_GT(found[0].cost.cycles, 2.0 * found[2].cost.cycles);
}

TEST(ModelReport, OfQ31SaysItsScales) {
    const ModelSpec spec = two_and_eight();
    const generate::ModelChoice choice{spec, {5.671e-4, 7.05e-4}, 5.29e-4, 0.0132};
    EXPECT_EQ(generate::to_lines(choice).front(),
              "modesdelta_plain_q31 with 2+8: as parts of the largest output, for inputs of 0.5 of full scale,");
    const auto json = nlohmann::json::parse(generate::to_json({"m.json", "m.h", choice, 1e-3}));
    EXPECT_EQ(json["format"], "q31");
    EXPECT_EQ(json["input_full_scale"], 2.0);
    EXPECT_EQ(json["output_full_scale"], FixedModel(spec, generate::swing_of(spec)).output_full_scale());
    EXPECT_GT(json["rounding_error"], 0.0);
}

}  // namespace
