// What a header's words say of its numbers: scales, names of designs, what forgets increments, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/failure.hpp"
#include "bench/generate/header.hpp"
#include "tests/generate/text_of_header.hpp"
#include "tests/refusal.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;

generate::Spec spec_of(const std::string& kernel, double order, std::size_t taps) {
    return {.kernel = kernel, .order = order, .taps = taps, .step_s = 0.01, .prefix = "my", .provenance = {}};
}

std::string header(const std::string& kernel, double order, std::size_t taps) {
    return generate::make_header(spec_of(kernel, order, taps));
}

// Magnitudes of all weights sum up to 2 for 0 < v <= 1, which one integer bit holds, and for v = 1.5 to 3. There a
// coefficient of -1.5 takes half of its scale. Increments may be 2: samples have half of their scale.
TEST(HeaderWords, ScalesAreThoseOfTheMagnitudes) {
    const std::string half = header("ring_plain_q31", 0.5, 50);
    EXPECT_THAT(half, HasSubstr("Input: fractions of 31 bits, x = integer / 2^31, so -1 <= x < 1. "));
    EXPECT_THAT(half, HasSubstr("\n * a_j / 2^0; "));
    EXPECT_THAT(half, HasSubstr("S_k = output * 2^(1 - 31), to nearest, halves up: 1 integer bit "));
    EXPECT_THAT(half, HasSubstr(" * +2^1 can saturate"));
    EXPECT_THAT(half, HasSubstr("#define MY_Q31_OUTPUT_EXPONENT 1 "));
    const std::string above = header("ring_plain_q31", 1.5, 50);
    EXPECT_THAT(above, HasSubstr("a_j / 2^1; "));
    EXPECT_THAT(above, HasSubstr("S_k = output * 2^(2 - 31), to nearest, halves up: 2 integer bits "));
    const std::string narrow = header("ring_plain_q15", 0.5, 50);
    EXPECT_THAT(narrow, HasSubstr("Input: fractions of 15 bits, x = integer / 2^15, so -1 <= x < 1. "));
    EXPECT_THAT(narrow, HasSubstr("Coefficients: fractions of 15 bits of\n"));
    EXPECT_THAT(header("mirror_plain_q15c31", 0.5, 50),
                HasSubstr("so -1 <= x < 1. Coefficients: fractions of 31 bits of\n"));
    const std::string increments = header("mirrordelta_plain_q31", 1.0, 50);
    EXPECT_THAT(increments, HasSubstr("Input: fractions of 30 bits, x = integer / 2^30, so -2 <= x < 2. "));
    // Of order 1 the sum is the increment itself, which no bit beside the sample's one has to hold.
    EXPECT_THAT(increments, HasSubstr("#define MY_Q31_OUTPUT_EXPONENT 1 "));
}

// Of v <= 0 what is forgotten of increments is a level, which stays; above, as much again as is left out.
TEST(HeaderWords, WhatForgetsIncrementsKeepsTheLevel) {
    for (const double order : {0.0, -0.5}) {
        EXPECT_THAT(header("mirrordelta_plain_f32", order, 50),
                    HasSubstr("(truncation): none for v <= 0: the signal's level goes with the increments\n"))
            << order;
    }
    double sum = 1.0;
    double weight = 1.0;
    for (int j = 1; j < 50; ++j) {
        weight *= 1.0 - 1.5 / j;
        sum += std::fabs(weight);
    }
    const double told = test::number_behind(header("mirrordelta_plain_f32", 0.5, 50), "(truncation): ");
    EXPECT_GE(told, 2.0 * (2.0 - sum));
    EXPECT_LT(told, 2.0 * (2.0 - sum) * 1.01);  // to three digits
}

std::string identity_of(const std::string& text) {
    const std::size_t at = text.find("#define MY_F32_IS_");
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

// Two headers of one design go together whatever their comments say; of two designs one is an error.
TEST(HeaderWords, ADesignIsNamedAndTellsItsHeadersApart) {
    generate::Spec spec = spec_of("shift_plain_f32", 0.5, 50);
    const std::string text = generate::make_header(spec);
    EXPECT_THAT(text, HasSubstr("#define MY_F32_DESIGN \"shift_plain_f32, 50, v = 0.5, h = 0.01 s\"\n"));
    spec.provenance = {"made on another day"};
    spec.licence = "MIT";
    ASSERT_NE(generate::make_header(spec), text);
    EXPECT_EQ(identity_of(generate::make_header(spec)), identity_of(text));
    EXPECT_NE(identity_of(header("shift_plain_f32", 0.5, 49)), identity_of(text));
    EXPECT_NE(identity_of(header("shift_plain_f32", 0.75, 50)), identity_of(text));
    // Without a step there is no factor of it.
    spec.step_s = {};
    const std::string plain = generate::make_header(spec);
    EXPECT_THAT(plain, HasSubstr("#define MY_F32_DESIGN \"shift_plain_f32, 50, v = 0.5\"\n"));
    EXPECT_THAT(plain, Not(HasSubstr("STEP_FACTOR")));
    EXPECT_NE(identity_of(plain), identity_of(text));
}

TEST(HeaderWords, AFittedFilterSaysWhoseItIs) {
    generate::Spec spec = spec_of("shift_plain_f32", 0.5, 3);
    spec.fitted = glsum::design::FittedFilter{3.5, {-0.5, 0.25}, {}, {}};
    spec.fitted_by = "a filter of ours";
    spec.use = "For w h up to 1.";
    const std::string text = generate::make_header(spec);
    EXPECT_EQ(text.find("/**\n * shift_plain_f32, 3 taps: a sum fitted to the derivative of order v = 0.5\n *\n"
                        " * For w h up to 1.\n"),
              0U);
    EXPECT_THAT(text,
                HasSubstr("#define MY_F32_DESIGN \"shift_plain_f32, 3, v = 0.5, h = 0.01 s, a filter of ours\"\n"));
    EXPECT_THAT(text, HasSubstr("#define MY_F32_STEP_FACTOR 3.5F /* w_0 h^-v: "));
    EXPECT_THAT(text, HasSubstr("    -0.5F, 0.25F,\n"));
    EXPECT_THAT(text, Not(HasSubstr("truncation")));
    // Of a model it is the past, whatever fitted it.
    spec.past_of_model = true;
    const std::string past = generate::make_header(spec);
    EXPECT_EQ(past.find("/**\n * shift_plain_f32, 3 taps: the past of a model\n"), 0U);
    EXPECT_THAT(past, HasSubstr("v = 0.5, h = 0.01 s, the past of a model\"\n"));
}

TEST(HeaderWords, WhatCannotBeMadeIsRefusedInWords) {
    const auto refused = [](generate::Spec spec) {
        return test::refusal(glsum::Exit::bad_input, [&] { (void)generate::make_header(spec); });
    };
    EXPECT_EQ(refused(spec_of("ring_plain_f33", 0.5, 5)),
              "no kernel is called ring_plain_f33; the nearest is ring_plain_f32");
    EXPECT_EQ(refused(spec_of("mirror_simd_f32", 0.5, 5)),
              "mirror_simd_f32 cannot be generated: it needs the host's vector unit");
    EXPECT_THAT(refused(spec_of("ring_plain_f32", 2.5, 5)), HasSubstr("ring_plain_f32 with 5 taps at order 2.5: "));
    generate::Spec spec = spec_of("ring_plain_f32", 0.5, 5);
    spec.prefix = "a-b";
    EXPECT_EQ(refused(spec), "--prefix: expected letters, digits and underscores, found a-b");
}

}  // namespace
