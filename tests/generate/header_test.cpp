// What a header says of itself: bounds as the kernel promises them, the closed form of what its window leaves out,
// sizes, and where it comes from. That it computes the kernel's bits is told by compiling it (compilers.sh).
#include "bench/generate/header.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/failure.hpp"
#include "base/rounded_up.hpp"
#include "bench/choose/provenance.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/texts/text.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/blocks.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/registry.hpp"
#include "tests/generate/text_of_header.hpp"

namespace {

using test::number_behind;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t horizon = 5000;

std::string header(const std::string& kernel, double order, std::size_t taps) {
    return generate::make_header({.kernel = kernel,
                                  .order = order,
                                  .taps = taps,
                                  .step_s = 0.01,
                                  .prefix = "my",
                                  .provenance = {"one", "", "two"}});
}

double promised(const std::string& kernel, double order, std::size_t taps) {
    double bound = -1.0;
    glsum::Registry::for_each([&]<class K>() {
        if constexpr (!std::is_same_v<K, glsum::Null> && !K::host_only) {
            if (K::name() == kernel) {
                const auto design =
                    bench::design_of(kernel, order, bench::length_of(kernel, order, taps, horizon), horizon);
                bench::HostLine<K> line(design);
                bound = glsum::error_bound<K>(design, line.state(), 1.0, horizon);
            }
        }
    });
    return bound;
}

TEST(Header, BoundsAreTheKernelsRoundedUp) {
    for (const auto& [kernel, order, taps] :
         {std::tuple("shift_plain_f32", 0.5, 50U), std::tuple("ring_plain_q31", 0.98, 40U),
          std::tuple("ring_oldest_f64", 1.5, 30U), std::tuple("modes_plain_f32", 0.5, 16U),
          std::tuple("nested_plain_f32", 0.5, 16U), std::tuple("mirrorhold_plain_f32", 0.5, 20U),
          std::tuple("mirrordelta_plain_q31", 0.5, 20U), std::tuple("modesdelta_plain_f32", 0.5, 16U),
          std::tuple("modessum_plain_f32", -0.5, 16U)}) {
        EXPECT_THAT(header(kernel, order, taps),
                    HasSubstr("inputs included: " + base::rounded_up(promised(kernel, order, taps)) + "\n"))
            << kernel;
    }
}

// Of all weights the magnitudes sum up to 2 for 0 < v <= 1 and to 2 v above, so that is what a window leaves out.
TEST(Header, WhatAWindowLeavesOutIsTheRestOfTheSum) {
    const auto left = [](double all, double order, std::size_t taps, double largest) {
        double sum = 1.0;
        double weight = 1.0;
        for (std::size_t j = 1; j < taps; ++j) {
            weight *= 1.0 - (order + 1.0) / static_cast<double>(j);
            sum += std::fabs(weight);
        }
        return "of that sum against full memory (truncation): " +
               base::rounded_up(largest * (all - sum) * (1.0 + 1e-9) + 1e-14) + "\n";
    };
    EXPECT_THAT(header("shift_plain_f32", 0.5, 50), HasSubstr(left(2.0, 0.5, 50, 1.0)));
    EXPECT_THAT(header("shift_plain_f32", 1.0, 50), HasSubstr(left(2.0, 1.0, 50, 1.0)));
    EXPECT_THAT(header("shift_plain_f32", 1.9909, 50), HasSubstr(left(2.0 * 1.9909, 1.9909, 50, 1.0)));
    EXPECT_THAT(header("shift_plain_f32", 0.0, 50), HasSubstr(left(1.0, 0.0, 50, 1.0)));
    // A guess may be wrong by as much again.
    EXPECT_THAT(header("mirrorhold_plain_f32", 0.5, 50), HasSubstr(left(2.0, 0.5, 50, 2.0)));
    EXPECT_THAT(header("shift_plain_f32", -0.5, 50),
                HasSubstr("(truncation): none for records without end (v < 0); of N samples, "
                          "the sum of |a_j| from L to N-1"));
    EXPECT_THAT(header("mirrorhold_plain_f32", -0.5, 50), HasSubstr("of N samples, twice the sum of |a_j|"));
}

// With modes and blocks the error of the design, over its horizon; of increments, which may be twice as large, twice.
TEST(Header, DesignsSayTheirErrorOverTheHorizon) {
    const std::string words = "of that sum against full memory (5000 samples from rest): ";
    const auto of_modes = [](const char* kernel, double order, std::size_t taps, double of_weights) {
        const std::size_t modes = bench::length_of(kernel, order, taps, horizon).modes.value();
        return glsum::design::approximate({of_weights, horizon}, taps - 2 * modes, modes).error;
    };
    // Three digits, rounded up.
    EXPECT_NEAR(number_behind(header("modes_plain_f32", 0.5, 16), words) / of_modes("modes_plain_f32", 0.5, 16, 0.5),
                1.0, 0.01);
    EXPECT_NEAR(number_behind(header("modesdelta_plain_f32", 0.5, 16), words) /
                    (2.0 * of_modes("modesdelta_plain_f32", 0.5, 16, -0.5)),
                1.0, 0.01);
    EXPECT_NEAR(number_behind(header("nested_plain_f32", 0.5, 16), words) /
                    glsum::design::design_blocks({0.5, horizon}, 16).error,
                1.0, 0.01);
    EXPECT_THAT(header("modes_plain_f32", 0.5, 16), HasSubstr("of these taps and modes, as designed in double"));
    EXPECT_THAT(header("nested_plain_f32", 0.5, 16), HasSubstr("of these taps and blocks"));
    EXPECT_THAT(header("mirrorhold_plain_f32", 0.5, 20),
                HasSubstr("of 20 taps and the tail's weights, over 5000 samples, rounding"));
    // Bounds that grow with the record say of which.
    for (const auto& [kernel, order, grows] :
         {std::tuple("mirrorhold_plain_f32", 0.5, true), std::tuple("modessum_plain_f32", -0.5, true),
          std::tuple("modes_plain_f32", 0.5, false), std::tuple("shift_plain_f32", 0.5, false)}) {
        EXPECT_EQ(header(kernel, order, 20).find(", over 5000 samples") != std::string::npos, grows) << kernel;
    }
}

TEST(Header, SizesAndScalesAreTheDesigns) {
    const std::string window = header("ring_plain_q15", 0.5, 50);
    EXPECT_THAT(window, HasSubstr("#define MY_Q15_TAPS 50U "));
    EXPECT_THAT(window, HasSubstr("#define MY_Q15_PAST 49U "));
    EXPECT_THAT(window, HasSubstr("#define MY_Q15_SAMPLES 49U "));
    EXPECT_THAT(window, HasSubstr("samples of 16 bits, coefficients of 16, exact sums in 64"));
    EXPECT_THAT(window, HasSubstr("ring_plain_q15, 50 taps: the Grünwald-Letnikov sum of order v = 0.5\n"));
    EXPECT_THAT(header("ring_plain_q31", 0.5, 50), HasSubstr("samples of 32 bits, coefficients of 32"));
    EXPECT_THAT(header("mirrordelta_plain_q31", 0.5, 50), HasSubstr("samples of 32 bits, coefficients of 32"));
    EXPECT_THAT(header("mirror_plain_f32", 0.5, 50), HasSubstr("#define MY_F32_SAMPLES 98U "));  // a doubled buffer
    EXPECT_THAT(header("shift_plain_f32", 0.5, 1), HasSubstr("#define MY_F32_SAMPLES 1U "));  // none, but C wants one
    EXPECT_THAT(header("shift_plain_f32", 0.5, 50), HasSubstr("#define MY_F32_STEP_FACTOR 10.0F "));  // 0.01^-0.5
    // The provenance is in the comment, line by line.
    EXPECT_THAT(window, HasSubstr(" * one\n *\n * two\n"));
    EXPECT_THROW((void)generate::make_header(
                     {.kernel = "ring_plain_f33", .order = 0.5, .taps = 5, .step_s = {}, .provenance = {}}),
                 glsum::Failure);
    EXPECT_THROW((void)generate::make_header(
                     {.kernel = "mirror_simd_f32", .order = 0.5, .taps = 5, .step_s = {}, .provenance = {}}),
                 glsum::Failure);
    EXPECT_THROW(
        (void)generate::make_header(
            {.kernel = "ring_plain_f32", .order = 0.5, .taps = 5, .step_s = {}, .prefix = "9", .provenance = {}}),
        glsum::Failure);
}

TEST(Header, APrefixIsTheFilesNameAsAnIdentifier) {
    EXPECT_EQ(generate::prefix_of_file("folder/my_sum.h"), "my_sum");
    EXPECT_EQ(generate::prefix_of_file("my-sum v2.h"), "my_sum_v2");
    EXPECT_EQ(generate::prefix_of_file("2nd.h"), "glsum_2nd");
    EXPECT_EQ(generate::prefix_of_file(std::string(80, '7') + ".h"), "glsum_" + std::string(54, '7'));
    EXPECT_EQ(generate::format_word("mirror_plain_q15c31"), "q15c31");
}

TEST(Provenance, SaysWhatWasMeasuredWhereAndHow) {
    choose::Answer answer;
    answer.question.conditions = {0.5, 0.002, {"step", "sine5"}, 700, 2020};
    answer.question.core = "a-core";
    answer.unit = "model cycles";
    answer.context = {{"glsum_version", "1.2"},        {"commit", "c0ffee"},    {"dirty", "true"},
                      {"compiler", "GNU 12"},          {"flags", "-O3"},        {"cpu", "a processor"},
                      {"target_compiler", "GNU 12.2"}, {"target_flags", "-Os"}, {"qemu_version", "QEMU 9"}};
    answer.choice.chosen = {"ring_plain_f32", 50, {0.0125, "sine5", ""}, {400.0, 420.0, 0.25, 408.0, ""}};
    EXPECT_EQ(
        choose::provenance(answer, "glsum generate"),
        (std::vector<std::string>{
            "Measured error 0.0125 (sine5): the largest of S_k over 700 samples at h = 0.002 s,",
            "relative to the largest exact full-memory sum, the worst of step, sine5",
            "Measured cost a sample of the kernel that this is made from: 400 model cycles, at most 420, for a-core",
            "", "Command: glsum generate", "glsum 1.2, commit c0ffee with changes",
            "Errors and expected bits: GNU 12, -O3", "Cost: GNU 12.2, -Os", "QEMU 9"}));
    answer.unit = "instructions";
    answer.context["dirty"] = "false";
    answer.choice.runner_up = {"modes_plain_f32", 16, {0.02, "step", ""}, {500.0, 500.0, 0.0, 320.0, ""}};
    answer.choice.kernels.resize(7);
    auto lines = choose::provenance(answer, "c");
    EXPECT_THAT(lines[2], HasSubstr("420, on an emulated Cortex-M7: no cycles"));
    EXPECT_EQ(lines[3], "Runner-up of 7 kernels: modes_plain_f32 with 2+7 taps, 500 instructions");
    EXPECT_EQ(lines[6], "glsum 1.2, commit c0ffee");
    answer.context["dirty"] = "unknown";
    EXPECT_EQ(choose::provenance(answer, "c")[6], "glsum 1.2, commit c0ffee (changes unknown)");
    answer.context["commit"] = "unknown";
    EXPECT_EQ(choose::provenance(answer, "c")[6], "glsum 1.2, commit unknown");
    answer.question.target = choose::Target::host;
    answer.choice.runner_up.reset();
    answer.context.erase("flags");
    lines = choose::provenance(answer, "c");
    EXPECT_THAT(lines[2], HasSubstr("420 cycles on a processor"));
    EXPECT_EQ(lines.back(), "Errors and expected bits: GNU 12, unknown");
    answer.question.target = choose::Target::m7;
    answer.choice.chosen->cost.fault = "no board";
    lines = choose::provenance(answer, "c");
    EXPECT_EQ(lines[2], "Cost not measured: no board");
    EXPECT_THAT(lines.back(), HasSubstr("Errors and expected bits"));
}

}  // namespace
