// Generated models against recursions and closed forms by hand: their scheme with all of its past, how far it swings,
// what they are chosen by, and the numbers that a header has.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/failure.hpp"
#include "bench/steppers/model/full_memory.hpp"
#include "bench/steppers/model/model_choice.hpp"
#include "bench/steppers/model/model_header.hpp"
#include "bench/steppers/model/stepped.hpp"
#include "bench/steppers/model/stepped_q31.hpp"
#include "bench/steppers/stepper/verify.hpp"
#include "glsum/registry.hpp"
#include "tests/generate/text_of_header.hpp"
#include "tests/refusal.hpp"

namespace {

using drive::Writing;
using generate::FixedModel;
using generate::ModelSpec;
using test::number_behind;
using test::says;

constexpr double step_s = 0x1p-10;
constexpr double lag_s = 0.25;  // 256 steps

ModelSpec lag_spec(double gain, double delay_steps = 0.0) {
    return {drive::make_fopdt(gain, lag_s, delay_steps * step_s), step_s, 5000};
}

// (1 - z / root)^power as a series.
std::vector<double> series(double root, double power, std::size_t count) {
    std::vector<double> terms = {1.0};
    while (terms.size() < count) {
        terms.push_back(terms.back() * (1.0 - (power + 1.0) / static_cast<double>(terms.size())) / root);
    }
    return terms;
}

double past_of(const std::vector<double>& weights, const std::vector<double>& increments) {
    double sum = 0.0;
    for (std::size_t j = 1; j <= increments.size(); ++j) {
        sum += weights[j] * increments[increments.size() - j];
    }
    return sum;
}

// A model of two orders and a constant, a s^alpha + b s^beta + c. For s stands (1 - z) / h, or 3/2 (1 - z) (1 - z / 3)
// / h. On increments each has a factor 1 - z less.
struct ByHand {
    static constexpr double h = 0.01;
    static constexpr double constant = 0.9;
    static constexpr double gain = 1.5;
    static constexpr std::size_t delay = 3;
    static constexpr std::size_t count = 600;

    explicit ByHand(Writing writing) : spec{{}, h, count}, weights(count + 1, 0.0) {
        spec.model.gain = 2.0 * gain;
        spec.model.numerator = {{0.5, 0.0}};
        spec.model.denominator = {{0.2, 1.9}, {0.65, 0.8}, {constant, 0.0}};
        spec.model.delay_s = h * static_cast<double>(delay);
        spec.writing = writing;
        for (const auto& [coefficient, order] : {std::pair(0.2, 1.9), std::pair(0.65, 0.8)}) {
            const double scale = coefficient * std::pow((writing == Writing::bdf2 ? 1.5 : 1.0) / h, order);
            const std::vector<double> outer = series(1.0, order - 1.0, count + 1);
            const std::vector<double> inner = series(3.0, order, count + 1);
            for (std::size_t j = 0; j <= count; ++j) {
                for (std::size_t i = 0; i <= (writing == Writing::bdf2 ? j : 0); ++i) {
                    weights[j] += scale * outer[j - i] * inner[i];
                }
            }
        }
    }
    ModelSpec spec;
    std::vector<double> weights;
};

TEST(FullMemory, StepsAsItsRecursionDoes) {
    for (const Writing writing : {Writing::delta, Writing::bdf2}) {
        const ByHand model(writing);
        std::vector<double> input;
        for (std::size_t k = 0; k < ByHand::count; ++k) {
            input.push_back(k % 50 < 20 ? 1.0 : -0.4);
        }
        const std::vector<double> found = generate::full_memory(model.spec, input);
        ASSERT_EQ(found.size(), input.size());
        std::vector<double> increments;
        double output = 0.0;
        const auto acting = [&](std::size_t k) { return k > ByHand::delay ? input[k - ByHand::delay - 1] : 0.0; };
        for (std::size_t k = 0; k < ByHand::count; ++k) {
            const double acts = writing == Writing::bdf2 ? 0.5 * (acting(k) + acting(k + 1)) : acting(k);
            increments.push_back(
                (ByHand::gain * acts - ByHand::constant * output - past_of(model.weights, increments)) /
                (model.weights[0] + ByHand::constant));
            output += increments.back();
            ASSERT_NEAR(found[k], output, 1e-9) << k;
        }
    }
}

// A disturbance of 1 of one increment, and all that comes of it.
TEST(FullMemory, SwingsByTheSumsOfItsMagnitudes) {
    for (const Writing writing : {Writing::delta, Writing::bdf2}) {
        const ByHand model(writing);
        std::vector<double> increments = {1.0};
        double output = 1.0;
        double outputs = 1.0;
        double moves = 1.0;
        while (increments.size() < ByHand::count) {
            increments.push_back(-(ByHand::constant * output + past_of(model.weights, increments)) /
                                 (model.weights[0] + ByHand::constant));
            output += increments.back();
            outputs += std::fabs(output);
            moves += std::fabs(increments.back());
        }
        const generate::Swing swing = generate::swing_of(model.spec);
        EXPECT_NEAR(swing.output, outputs, 1e-9 * outputs);
        EXPECT_NEAR(swing.increments, moves, 1e-9 * moves);
    }
    // Of a first order, which falls by 1 / 257 of itself with each sample.
    ModelSpec lag = lag_spec(-2.0);
    lag.samples = 100;
    const double stays = 256.0 / 257.0;
    EXPECT_NEAR(generate::swing_of(lag).output, 257.0 * (1.0 - std::pow(stays, 100)), 1e-9);
    EXPECT_NEAR(generate::swing_of(lag).increments, 2.0 - std::pow(stays, 99), 1e-12);
}

TEST(FullMemory, OnlyBrokenOrdersHaveATail) {
    drive::Model model;
    model.denominator = {{1.0, 2.0}, {1.0, 1.0}, {1.0, 0.0}};
    EXPECT_FALSE(generate::has_tail(model));
    model.denominator[1].order = 0.5;
    EXPECT_TRUE(generate::has_tail(model));
}

// K (1 - e^(-t/T)) and what the scheme makes of it, K (1 - (1 + h/T)^-n), over 64 samples behind the dead time.
double lag_error(double delay_steps, int scheme_delay) {
    double largest = 0.0;
    double peak = 0.0;
    for (int k = 0; k <= 64 + scheme_delay; ++k) {
        const double exact = k < delay_steps ? 0.0 : 1.0 - std::exp(-(k - delay_steps) / 256.0);
        const double scheme = k < scheme_delay ? 0.0 : 1.0 - std::pow(1.0 + 1.0 / 256.0, scheme_delay - k);
        largest = std::max(largest, std::fabs(exact - scheme));
        peak = std::max(peak, exact);
    }
    return largest / peak;
}

TEST(ModelJudge, OfAFirstOrderKnowsTheErrorsClosedForm) {
    const ModelSpec spec = lag_spec(-2.0, 10.0 + 0.995e-9);
    const generate::ModelJudge judge(spec.model, step_s, 64);
    EXPECT_NEAR(judge.scheme_error(Writing::delta, spec), lag_error(10.0, 10), 1e-7);
    const generate::ModelErrors errors = judge.errors_of(spec);
    EXPECT_NEAR(errors.step, lag_error(10.0, 10), 1e-5);
    EXPECT_GT(errors.random, 0.0);
    EXPECT_LT(errors.random, 2e-5);
    // In q31 the records are run at a part of full scale and told in their own.
    ModelSpec fixed = spec;
    fixed.input_full_scale = 3.0;
    EXPECT_NEAR(judge.errors_of(fixed).step, lag_error(10.0, 10), 1e-6);
    EXPECT_LT(judge.errors_of(fixed).random, 1e-6);
}

TEST(ModelJudge, WaitsAWholeStepForADeadTimeBetweenTwo) {
    const ModelSpec spec = lag_spec(2.0, 10.0 + 1.005e-9);
    const generate::ModelJudge judge(spec.model, step_s, 64);
    EXPECT_NEAR(judge.scheme_error(Writing::delta, spec), lag_error(10.0, 11), 1e-7);
}

// (T s + 1)^2 by 3/2 (1 - z) (1 - z / 3) / h for s is 385 - 512 z + 128 z^2, twice. From rest, by half of the input
// at first.
TEST(ModelChoice, OfWholeOrdersTakesTheSecondOrderWhereTheFirstErrsMore) {
    const drive::Model model = drive::make_sopdt(1.0, lag_s, 0.0);
    double inner[2] = {0.0, 0.0};
    double outer[2] = {0.0, 0.0};
    double first[2] = {0.0, 0.0};  // by (1 - z) / h, which is 257 - 256 z
    double error = 0.0;
    double error_of_first = 0.0;
    std::vector<double> outputs;
    for (int k = 0; k <= 512; ++k) {
        const auto solve = [](double forcing, double(&before)[2]) {
            const double now = (forcing + 512.0 * before[0] - 128.0 * before[1]) / 385.0;
            before[1] = before[0];
            before[0] = now;
            return now;
        };
        const double now = solve(solve(k == 0 ? 0.5 : 1.0, inner), outer);
        outputs.push_back(now);
        first[0] = k == 0 ? 0.0 : (1.0 + 256.0 * first[0]) / 257.0;
        first[1] = (first[0] + 256.0 * first[1]) / 257.0;
        const double exact = 1.0 - (1.0 + k / 256.0) * std::exp(-k / 256.0);
        error = std::max(error, std::fabs(now - exact));
        error_of_first = std::max(error_of_first, std::fabs(first[1] - exact));
    }
    const double peak = 1.0 - 3.0 * std::exp(-2.0);
    const double max_error = 0.5 * error_of_first / peak;
    ASSERT_LT(error / peak, 0.1 * max_error);
    const generate::ModelChoice choice = generate::choose_model(model, step_s, max_error, 512);
    EXPECT_EQ(choice.spec.writing, Writing::bdf2);
    EXPECT_FALSE(choice.spec.compensated);
    EXPECT_EQ(choice.spec.memory.taps, 4U);  // of (1 - z) (1 - z / 3)^2
    EXPECT_EQ(choice.spec.memory.modes, 0U);
    EXPECT_EQ(choice.spec.samples, 512U);
    EXPECT_EQ(choice.spec.step_s, step_s);
    EXPECT_NEAR(choice.scheme, error / peak, 1e-8);
    generate::SteppedModel stepped(choice.spec);
    for (const double output : outputs) {
        ASSERT_NEAR(stepped.step(1.0F), output, 1e-4);
    }
}

// Where none keeps the error it names the one that errs least.
TEST(ModelChoice, NamesTheNearestWhereNoneWillDo) {
    const ModelSpec base{lag_spec(2.0).model, step_s, 64};
    const generate::ModelJudge judge(base.model, step_s, 64);
    double least = INFINITY;
    std::string nearest;
    for (const Writing writing : {Writing::delta, Writing::bdf2}) {
        for (const bool compensated : {false, true}) {
            ModelSpec spec = base;
            spec.writing = writing;
            spec.memory = {generate::whole_order_taps};
            spec.compensated = compensated;
            const generate::ModelErrors errors = judge.errors_of(spec);
            const double worst = std::max(errors.step, errors.random);
            if (worst < least) {
                least = worst;
                nearest = fmt::format("{} with {}", drive::realtime_name(spec.kernel(), writing),
                                      writing == Writing::delta ? "1" : "2");
            }
        }
    }
    EXPECT_EQ(
        test::refusal(glsum::Exit::check_failed, [&] { (void)generate::choose_model(base.model, step_s, 1e-9, 64); }),
        fmt::format("--max-error: expected 1e-09 to be kept; the nearest, {}, errs {:.2g}", nearest, least));
    // What it errs is within what it errs.
    const generate::ModelChoice choice = generate::choose_model(base.model, step_s, least, 64);
    EXPECT_EQ(drive::realtime_name(choice.spec.kernel(), choice.spec.writing) + " with " + choice.spec.memory.text(),
              nearest);
    EXPECT_EQ(std::max(choice.errors.step, choice.errors.random), least);
}

// Half a per cent on either side of where a hundredth of room needs the next power of two: the output swings by K and
// its increments by twice the input's share of it, K / 257.
TEST(FixedModel, ItsScalesAreThePowersOfTwoAHundredthAbove) {
    const auto scales_of = [](double gain) {
        ModelSpec spec = lag_spec(gain);
        spec.input_full_scale = 1.0;
        const FixedModel stepped(spec, generate::swing_of(spec));
        // From the unit of the increments to that of the output.
        return std::pair(stepped.output_full_scale(), std::ldexp(stepped.output_full_scale(), -stepped.output_shift()));
    };
    EXPECT_EQ(scales_of(1.97), std::pair(2.0, 0x1p-6));
    EXPECT_EQ(scales_of(-1.97), std::pair(2.0, 0x1p-6));
    EXPECT_EQ(scales_of(1.985), std::pair(4.0, 0x1p-6));
    EXPECT_EQ(scales_of(1.978), std::pair(2.0, 0x1p-6));
    EXPECT_EQ(scales_of(1.999), std::pair(4.0, 0x1p-5));
    // A lag of a third of a step goes 3/4 of its way at once, and as far back. An output has no finer unit than its
    // increments.
    ModelSpec fast{drive::make_fopdt(0.9, step_s / 3.0, 0.0), step_s, 5000};
    fast.input_full_scale = 4.0;
    const FixedModel stepped(fast, generate::swing_of(fast));
    EXPECT_EQ(stepped.output_full_scale(), 4.0 * 2.0);
    EXPECT_EQ(stepped.output_shift(), 0);
}

TEST(FixedModel, OfAFirstOrderIsTheClosedForm) {
    ModelSpec spec = lag_spec(-2.0, 3.0);
    spec.input_full_scale = 2.0;
    FixedModel stepped(spec, generate::swing_of(spec));
    EXPECT_EQ(stepped.output_full_scale(), 8.0);
    EXPECT_LT(stepped.error(), 1e-5);
    for (int k = 0; k < 2000; ++k) {
        const double expected = k < 3 ? 0.0 : -3.0 * (1.0 - std::pow(257.0 / 256.0, 3 - k));
        ASSERT_NEAR(stepped.step_real(1.5), expected, stepped.error()) << k;
    }
    EXPECT_EQ(stepped.saturations(), 0U);
    // Factors are products of integers: of the input in the increments' unit, and of the output.
    const double stored = std::ldexp(4.0, -stepped.output_shift());
    const auto real_of = [](const FixedModel::Factor& factor) {
        return (factor.negative ? -1.0 : 1.0) * std::ldexp(factor.mantissa, -factor.shift);
    };
    EXPECT_NEAR(real_of(stepped.input()), -2.0 / 257.0 / stored, 2e-9);
    EXPECT_NEAR(real_of(stepped.constant()), 1.0 / 257.0 * 4.0 / stored, 2e-9);
}

// Jumps at each 25th sample, as large as the input may be, and as many samples more as the model is dead.
TEST(WrittenModel, HoldsTheRecordAndTheLibrarysOutputs) {
    const ModelSpec spec = lag_spec(2.0, 3.0);
    const generate::WrittenStepper single = generate::written(spec, "own", "its text");
    EXPECT_EQ(single.prefix, "own");
    EXPECT_EQ(single.text, "its text");
    EXPECT_EQ(single.format, "f32");
    ASSERT_EQ(single.inputs.size(), 1U);
    ASSERT_EQ(single.inputs[0].size(), 4003U);
    ASSERT_EQ(single.expected.size(), 4003U);
    generate::SteppedModel stepped(spec);
    std::set<float> levels;
    double sum = 0.0;
    for (std::size_t k = 0; k < 4003; ++k) {
        const float input = std::bit_cast<float>(single.inputs[0][k]);
        ASSERT_GE(input, -1.0F);
        ASSERT_LT(input, 1.0F);
        ASSERT_TRUE(k % 25 == 0 || single.inputs[0][k] == single.inputs[0][k - 1]) << k;
        ASSERT_EQ(std::bit_cast<float>(single.expected[k]), stepped.step(input)) << k;
        levels.insert(input);
        sum += static_cast<double>(input);
    }
    // Even in [-1, 1): the mean of 161 levels is 0 to 0.046.
    EXPECT_EQ(levels.size(), 161U);
    EXPECT_NEAR(sum / 4003.0, 0.0, 0.2);
    EXPECT_LT(*levels.begin(), -0.9F);
    EXPECT_GT(*levels.rbegin(), 0.9F);
    ModelSpec in_q31 = spec;
    in_q31.input_full_scale = 3.0;
    const generate::WrittenStepper fixed = generate::written(in_q31, "own", "");
    FixedModel own(in_q31, generate::swing_of(in_q31));
    EXPECT_EQ(fixed.format, "q31");
    ASSERT_EQ(fixed.expected.size(), 4003U);
    for (std::size_t k = 0; k < 4003; ++k) {
        const auto input = std::bit_cast<std::int32_t>(fixed.inputs[0][k]);
        ASSERT_EQ(static_cast<double>(input),
                  std::ldexp(static_cast<double>(std::bit_cast<float>(single.inputs[0][k])), 31))
            << k;
        ASSERT_EQ(std::bit_cast<std::int32_t>(fixed.expected[k]), own.step(input)) << k;
    }
}

// The past of order n has n - 1 increments; the first of them needs no coefficient but the factor.
TEST(WrittenModel, NamesTheTableThatItHas) {
    const auto tables_of = [](const std::vector<drive::Term>& denominator) {
        ModelSpec spec{{}, 0.01, 1000};
        spec.model.denominator = denominator;
        spec.memory = {generate::whole_order_taps};
        return generate::written(spec, "own", "").tables;
    };
    EXPECT_TRUE(tables_of({{1.0, 1.0}, {1.0, 0.0}}).empty());
    EXPECT_TRUE(tables_of({{1.0, 2.0}, {2.0, 1.0}, {1.0, 0.0}}).empty());
    EXPECT_EQ(tables_of({{1.0, 3.0}, {3.0, 2.0}, {3.0, 1.0}, {1.0, 0.0}}), std::vector<std::string>{"past"});
}

TEST(ModelHeader, OfSinglePrecisionHasTheNumbersOfItsScheme) {
    const std::string text = generate::make_model_header(lag_spec(2.0, 3.0), "own", "MIT", {"one", "", "two */"});
    EXPECT_NO_THROW(test::compile_example(text, "own", "float u"));
    EXPECT_EQ(number_behind(text, "A model in single precision, stepped every "), step_s);
    EXPECT_TRUE(says(text, " y = 2 / (0.25 s + 1) exp(-0.0029296875 s) u\n"));
    EXPECT_TRUE(says(text, "of first order in the sample time. "));
    EXPECT_TRUE(says(text, " * one\n *\n * two * /\n * Licence: MIT.\n */\n"));
    EXPECT_TRUE(says(text, "#define OWN_F32_DESIGN \"2 / (0.25 s + 1) exp(-0.0029296875 s), h = 0.0009765625 s\"\n"));
    EXPECT_EQ(number_behind(text, "#define OWN_F32_SAMPLE_TIME "), step_s);
    EXPECT_TRUE(says(text, "#define OWN_F32_WAITING 4U "));
    EXPECT_NEAR(number_behind(text, "#define OWN_F32_INPUT "), 2.0 / 257.0, 1e-9);
    EXPECT_NEAR(number_behind(text, "#define OWN_F32_CONSTANT "), 1.0 / 257.0, 1e-9);
    EXPECT_FALSE(says(text, "OWN_F32_FACTOR"));
    EXPECT_FALSE(says(text, "float lost;"));
    EXPECT_FALSE(says(text, "own_past"));
    // Four times the period of 37 and 11 samples, behind the dead time.
    EXPECT_TRUE(says(text, "Runs 1631 samples"));
    EXPECT_TRUE(says(text, "k < 1631U"));
    EXPECT_FALSE(says(generate::make_model_header(lag_spec(2.0), "own", "", {}), "Licence"));
}

// By 3/2 (1 - z) (1 - z / 3) on values: the one increment that it looks back at counts -1/2 of 3/2.
TEST(ModelHeader, OfSecondOrderHasHalfOfTwoInputsAndAFactor) {
    ModelSpec spec = lag_spec(2.0);
    spec.writing = Writing::bdf2;
    spec.compensated = true;
    const std::string text = generate::make_model_header(spec, "own", "", {});
    EXPECT_TRUE(says(text, "of second order in the sample time. "));
    EXPECT_NEAR(number_behind(text, "#define OWN_F32_INPUT "), 0.5 * 2.0 / 385.0, 1e-9);
    EXPECT_NEAR(number_behind(text, "#define OWN_F32_CONSTANT "), 1.0 / 385.0, 1e-9);
    EXPECT_NEAR(number_behind(text, "#define OWN_F32_FACTOR "), -128.0 / 385.0, 1e-7);
    EXPECT_TRUE(generate::check_bits_here(generate::written(spec, "own", text)).good());
}

TEST(ModelHeader, InQ31HasItsScalesAndFactors) {
    ModelSpec spec = lag_spec(-2.0, 3.0);
    spec.input_full_scale = 2.0;
    const std::string text = generate::make_model_header(spec, "own", "MIT", {"one"});
    EXPECT_NO_THROW(test::compile_example(text, "own", "int32_t u"));
    EXPECT_EQ(number_behind(text, "A model in q31, stepped every "), step_s);
    EXPECT_TRUE(says(text, "of first order in the sample time.\n"));
    EXPECT_TRUE(says(text, "Full scales: 2 for u (--input-scale), 8 for y; "));
    EXPECT_EQ(number_behind(text, "leave theirs over "), 5000.0);
    EXPECT_TRUE(says(text, " * one\n * Licence: MIT.\n */\n"));
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_INPUT_FULL_SCALE "), 2.0);
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_OUTPUT_FULL_SCALE "), 8.0);
    EXPECT_TRUE(says(text, "#define OWN_Q31_WAITING 4U "));
    const double stored = 0x1p-5;  // 1.01 times twice 2 / 257 is above 2^-6
    EXPECT_EQ(number_behind(text, "#define OWN_Q31_OUTPUT_SHIFT "), 7.0);
    EXPECT_NEAR(std::ldexp(number_behind(text, "OWN_Q31_INPUT_MANTISSA "),
                           -static_cast<int>(number_behind(text, "OWN_Q31_INPUT_SHIFT "))),
                2.0 / 257.0 / stored, 2e-9);
    EXPECT_NEAR(std::ldexp(number_behind(text, "OWN_Q31_CONSTANT_MANTISSA "),
                           -static_cast<int>(number_behind(text, "OWN_Q31_CONSTANT_SHIFT "))),
                1.0 / 257.0 * 4.0 / stored, 2e-9);
    EXPECT_TRUE(says(text, "OWN_Q31_INPUT_NEGATIVE 1\n"));
    EXPECT_TRUE(says(text, "OWN_Q31_CONSTANT_NEGATIVE 0\n"));
    EXPECT_FALSE(says(text, "OWN_Q31_FACTOR"));
    // An integrator has no constant.
    spec.model.denominator = {{1.0, 1.0}};
    EXPECT_FALSE(says(generate::make_model_header(spec, "own", "", {}), "CONSTANT_MANTISSA"));
}

// Of a first order nothing is a header of its own, and of a second one the past is; neither takes from the prefix.
TEST(ModelHeader, APrefixIsAnIdentifierOfSixtyLettersAtMost) {
    for (const Writing writing : {Writing::delta, Writing::bdf2}) {
        for (const bool fixed : {false, true}) {
            ModelSpec spec = lag_spec(2.0);
            spec.writing = writing;
            spec.memory = {generate::whole_order_taps};
            if (fixed) {
                spec.input_full_scale = 1.0;
            }
            const auto made = [&](const std::string& prefix) {
                return generate::make_model_header(spec, prefix, "", {});
            };
            for (const std::string& prefix : {std::string("9x"), std::string("a@b"), std::string(61, 'a')}) {
                EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)made(prefix); }),
                          "--prefix: expected letters, digits and underscores, found " + prefix);
            }
            const std::string longest(60, 'a');
            EXPECT_TRUE(generate::check_bits_here(generate::written(spec, longest, made(longest))).good());
        }
    }
}

}  // namespace
