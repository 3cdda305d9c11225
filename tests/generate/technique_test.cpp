// The C of a header's step where no compiler here tells: which loops it has by length and target, how it is laid out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "bench/generate/header.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/texts/template.hpp"
#include "bench/texts/text.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;

std::string header(const std::string& kernel, std::size_t taps, const std::string& prefix = "my") {
    return generate::make_header(
        {.kernel = kernel, .order = 0.5, .taps = taps, .step_s = 0.01, .prefix = prefix, .provenance = {}});
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

// A shorter loop over a constant costs less than to enter the core's own.
TEST(Technique, TheCoresOwnLoopIsForLongWindows) {
    for (const auto& [kernel, first, loop] :
         {std::tuple("ring_multi_f32", 17U, "my_f32_dot_floats(s, "),
          std::tuple("mirror_multi_f32", 17U, "dot_floats(s, "),
          std::tuple("mirror_multi_q31", 17U, "my_q31_dot_smlal_onto(s0, "),
          std::tuple("mirror_hornersplit_f32", 41U, "my_f32_horner_floats(t, table, newer, i / 4U)")}) {
        EXPECT_THAT(header(kernel, first), HasSubstr(loop)) << kernel;
        EXPECT_THAT(header(kernel, first), HasSubstr("_M7\n")) << kernel;
        EXPECT_THAT(header(kernel, first - 1), Not(HasSubstr(loop))) << kernel;
        EXPECT_THAT(header(kernel, first - 1), Not(HasSubstr("_M7\n"))) << kernel;
    }
    for (const char* kernel :
         {"mirror_multifma_f32", "mirror_hornersplitfma_f32", "mirror_multi_f64", "ring_plain_f32"}) {
        EXPECT_THAT(header(kernel, 100), Not(HasSubstr("_M7"))) << kernel;
    }
    EXPECT_THAT(header("mirror_smlald_q15", 5), HasSubstr("my_q15_dot_smlald_onto(sum, coefficients, samples, words)"));
    EXPECT_THAT(header("mirror_smlad_q15", 50), Not(HasSubstr("dot_smlald")));
}

TEST(Technique, SumsInSoftwareAreToldApart) {
    // Where sums are in double a target without its own is told apart, if there is a past.
    EXPECT_THAT(header("ring_oldest_f64", 2), HasSubstr("#define MY_F64_SOFT_DOUBLE "));
    EXPECT_THAT(header("ring_oldest_f64", 2), HasSubstr("#pragma GCC unroll 1\n"));
    EXPECT_THAT(header("ring_plain_f32a64", 2), HasSubstr("#define MY_F32A64_SOFT_DOUBLE "));
    EXPECT_THAT(header("ring_oldest_f64", 1), Not(HasSubstr("#define MY_F64_SOFT_DOUBLE ")));
    EXPECT_THAT(header("ring_oldest_f32", 2), Not(HasSubstr("SOFT_DOUBLE")));
    EXPECT_THAT(header("ring_oldest_f64", 2), HasSubstr("(__ARM_FP & 8)"));  // the bit of double precision
    EXPECT_THAT(header("ring_oldest_f32", 2), HasSubstr("(__ARM_FP & 4)"));
}

// Whole, as long as that is short.
TEST(Technique, FewModesAreUnrolled) {
    const auto text = [](long modes, bool compensated, bool in_software = false) {
        generate::HeaderText made;
        made.facts = {{"past", 2}, {"decaying", modes}, {"compensated", compensated}, {"in_software", in_software}};
        for (const char* place : {"name", "sample", "coefficient", "accumulator", "call", "rolled"}) {
            made.places[place] = "";
        }
        made.places["NAME"] = "MY";
        made.chains = {{"history", {"modes", "history"}}, {"header", {"header"}}};
        return made.section("history", "sum");
    };
    EXPECT_THAT(text(17, false), HasSubstr("#pragma GCC unroll 8\n"));
    EXPECT_THAT(text(17, true), HasSubstr("#pragma GCC unroll 8\n"));
    EXPECT_THAT(text(18, false), HasSubstr("#pragma GCC unroll 2\n"));
    EXPECT_THAT(text(18, true), HasSubstr("#pragma GCC unroll 10\n"));
    EXPECT_THAT(text(18, true, true), Not(HasSubstr("unroll 10")));
    EXPECT_THAT(text(18, true, true), HasSubstr("for (i = MY_MODES; i > 0U; --i) {"));
    const std::string pairs = "for (i = MY_MODES / 2U; i > 0U; --i) {";
    EXPECT_THAT(text(1, false), Not(HasSubstr(pairs)));
    EXPECT_THAT(text(2, false), HasSubstr(pairs));
    EXPECT_THAT(text(1, true), HasSubstr("            table += 2;\n            average += 2;\n"));
    EXPECT_THAT(text(1, false), HasSubstr("            table += 2;\n            average += 1;\n"));
    EXPECT_THAT(text(2, false), Not(HasSubstr("            table += 2;\n")));
    EXPECT_THAT(text(2, false), HasSubstr("table += 2 * 2;\n"));
}

// All loads of a tile stand before its first product where that product is a fused one.
TEST(Technique, TilesOfFusedProductsLoadFirst) {
    const std::string fused = header("block_oldestfma_f32", 50);
    const std::string two = fused.substr(fused.find(" my_f32_add_two_groups("));
    const std::size_t barrier = two.find("__asm__ volatile");
    EXPECT_THAT(two.substr(barrier),
                testing::ContainsRegex("\\+t.\\(c\\[10\\]\\)\\);\n.*__asm__ volatile.*\n.*\\(s\\[3\\]\\)\\);"));
    EXPECT_LT(two.find("x[r] = samples[r];"), barrier);
    EXPECT_LT(barrier, two.find("my_f32_fused_multiply_add("));
    // None in a single group.
    EXPECT_GT(fused.find("__asm__ volatile", fused.find(" my_f32_add_group(")), fused.find(" my_f32_add_two_groups("));
    EXPECT_THAT(header("block_plain_q31", 50), Not(HasSubstr("__asm__ volatile")));
}

// Every statement of a step stands as deep as its braces.
TEST(Technique, StatementsAreIndentedByTheirBraces) {
    const std::regex statement(
        R"(^( *)((s|t|c|x)\d+ = |if \(|for \(|do \{|while \(|at |sum = |const @|--?[ax]|\+\+[ax]|mode |average|a -= |x \+= |\}))");
    for (const std::string& kernel : generate::generatable()) {
        const bool integral = bench::has_integrator(kernel);
        const std::string text = generate::make_header({.kernel = kernel,
                                                        .order = integral ? -0.5 : 0.5,
                                                        .taps = 31,
                                                        .step_s = {},
                                                        .prefix = "my",
                                                        .provenance = {}});
        const std::size_t begin = text.rfind("_STEP_ATTRIBUTES\nstatic inline");
        std::size_t depth = 0;
        for (const std::string& line : lines_of(text.substr(begin, text.find("The self-check") - begin))) {
            const std::size_t first = line.find_first_not_of(' ');
            if (first == std::string::npos || line[first] == '#') {
                continue;
            }
            std::smatch found;
            if (std::regex_search(line, found, statement) && depth > 0) {
                EXPECT_EQ(first, 4 * (depth - (line[first] == '}' ? 1 : 0))) << kernel << ": " << line;
            }
            depth += static_cast<std::size_t>(std::count(line.begin(), line.end(), '{'));
            depth -= static_cast<std::size_t>(std::count(line.begin(), line.end(), '}'));
        }
    }
}

// Lines of at most 117 columns, each with as many numbers as it holds.
TEST(Header, TablesFillTheirLines) {
    for (const char* kernel : {"shift_plain_f32", "shift_plain_f64", "ring_plain_q31", "mirror_smlald_q15"}) {
        const std::string text = header(kernel, 400);
        const std::size_t begin = text.find("_table[");
        const auto lines = lines_of(text.substr(begin, text.find("};", begin) - begin));
        ASSERT_GT(lines.size(), 20U);
        for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
            EXPECT_LE(lines[i].size(), 117U) << lines[i];
            const std::string next = lines[i + 1].substr(3, lines[i + 1].find(',') - 2);
            EXPECT_GT(lines[i].size() + next.size(), 117U - 4U) << lines[i];
            EXPECT_TRUE(lines[i].starts_with("    ")) << lines[i];
        }
    }
}

// Past twice the window, so that every history wraps, and two turns of the inputs more.
TEST(Header, TheSelfCheckGoesPastTwiceTheWindow) {
    for (const std::size_t taps : {1U, 2U, 17U, 18U, 19U, 20U, 50U, 111U}) {
        const std::string text = header("ring_plain_f32", taps);
        const std::size_t at = text.find("for (k = 0U; k < ");
        ASSERT_NE(at, std::string::npos);
        const std::size_t steps = std::stoul(text.substr(at + 17));
        const std::size_t least = 2 * (taps - 1) + 3 + 2 * 37;
        EXPECT_EQ(steps % 37, 0U);
        EXPECT_GE(steps, least) << taps;
        EXPECT_LT(steps, least + 37) << taps;
        EXPECT_THAT(text, HasSubstr("k - " + std::to_string(steps - 37) + "U]"));
        EXPECT_THAT(text, HasSubstr("_check_input[37] = {"));
        EXPECT_THAT(text, HasSubstr("_check_last[37] = {"));
    }
    // What a kernel with blocks holds is more than its window.
    const std::string blocks = header("nested_plain_f32", 16);
    EXPECT_GT(std::stoul(blocks.substr(blocks.find("for (k = 0U; k < ") + 17)), 2U * 1000U);
}

TEST(Header, APrefixIsAnIdentifierOfAtMost60Letters) {
    const std::string longest(60, 'a');
    EXPECT_THAT(header("shift_plain_f32", 2, longest), HasSubstr(longest + "_step_f32("));
    for (const std::string& bad : {std::string(61, 'a'), std::string(), std::string("9a"), std::string("a-b"),
                                   std::string("a b"), std::string("\xc3\xa4")}) {
        EXPECT_THROW((void)header("shift_plain_f32", 2, bad), glsum::Failure) << bad;
    }
    EXPECT_EQ(generate::prefix_of_file(std::string(60, 'x') + ".h"), std::string(60, 'x'));
    EXPECT_EQ(generate::prefix_of_file(std::string(61, 'x') + ".h"), "glsum_" + std::string(54, 'x'));
}

// What ends a C comment is broken up, and each line begins with a star.
TEST(Header, NoProvenanceEndsTheComment) {
    const std::string text = generate::make_header({.kernel = "shift_plain_f32",
                                                    .order = 0.5,
                                                    .taps = 2,
                                                    .step_s = {},
                                                    .prefix = "my",
                                                    .licence = "MIT",
                                                    .provenance = {"a */ b */", "**/"}});
    EXPECT_THAT(text, HasSubstr(" * a * / b * /\n * ** /\n"));
    const std::size_t end = text.find("*/");
    EXPECT_LT(text.find("\n *\n * Licence: MIT.\n"), end);
    EXPECT_EQ(header("shift_plain_f32", 2).find("icence"), std::string::npos);  // of nothing nothing is said
}

// A window's table of words, for starts at an even and an odd sample.
TEST(Header, ConstantsAreTheDesigns) {
    const std::string pairs = header("mirror_smlald_q15", 50);
    EXPECT_THAT(pairs, HasSubstr("_ALIGNED 25U "));  // 49 coefficients in words
    EXPECT_THAT(pairs, HasSubstr("_SHIFTED 25U "));
    EXPECT_THAT(header("modes_plain_f32", 16), HasSubstr("_MODES 7U "));
    EXPECT_THAT(header("block_plain_q31", 50), HasSubstr("_GROUPS 13U "));
    EXPECT_THAT(header("nested_plain_f32", 16), HasSubstr("_BLOCKS "));
    EXPECT_THAT(header("shift_plain_f32", 50), Not(HasSubstr("_GAIN_")));
    // h^-v = 10 = 1.25 * 2^3.
    EXPECT_THAT(header("ring_plain_q15", 50), HasSubstr("_GAIN_MANTISSA 1342177280\n"));
    EXPECT_THAT(header("ring_plain_q15", 50), HasSubstr("_GAIN_EXPONENT (3)\n"));
    EXPECT_THAT(header("shift_plain_f64", 50), HasSubstr("_STEP_FACTOR 10.0 "));
    EXPECT_THAT(header("mirrorhold_plain_f32", 20), HasSubstr("_MINUS_ORDER (-0.5F) "));
}

TEST(Header, TextsAreFilledPlaceByPlace) {
    const generate::Places places = {{"a", "1"}, {"b", "@"}};
    EXPECT_EQ(generate::fill("@a@", places), "1");
    EXPECT_EQ(generate::fill("x@a@y@b@z", places), "x1y@z");
    EXPECT_EQ(generate::fill("", places), "");
    EXPECT_EQ(generate::fill("none", places), "none");
    EXPECT_THROW((void)generate::fill("@c@", places), std::out_of_range);
    EXPECT_THROW((void)generate::fill("@a", places), std::out_of_range);
}

}  // namespace
