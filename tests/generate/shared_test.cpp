// Statements of the kernels in the words of a header: what is taken, what is left out, what is called otherwise.
#include "bench/texts/shared.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "base/build_info.hpp"
#include "bench/generate/header.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Shared, IsTheKernelsTextInTheHeadersWords) {
    EXPECT_EQ(generate::shared("plain older", {{"accumulate<Format, fused>", "@name@_multiply_add"}}),
              "    table += newer_count;\n"
              "@rolled@"
              "    for (size_t i = 0; i < older_count; ++i) {\n"
              "        sum = @name@_multiply_add(sum, table[i], older[i]);\n"
              "    }\n");
    EXPECT_EQ(generate::shared("plain"), "    @accumulator@ sum = @name@_start(newest);\n");
    EXPECT_EQ(generate::shared("ring push", {{"samples", "S->past"}, {"past", "P"}}, 8),
              "        head = next_head(head, P);\n"
              "        @NAME@_KEEP_WORD(head);\n"
              "        S->past[head] = newest;\n");
    // A cast of C++ becomes one of C.
    EXPECT_THAT(generate::shared("next_head"), HasSubstr("(head == 0 ? (uint32_t)(past) : head) - 1;"));
    EXPECT_THROW((void)generate::shared("plain old"), std::out_of_range);
    EXPECT_THROW((void)generate::shared(""), std::out_of_range);
}

// Each text is there once: a second one of its name would never be read.
TEST(Shared, EveryNameIsTakenOnce) {
    const std::string_view mark = "// C99: ";
    for (std::size_t at = 0; (at = generate::kernel_sources.find(mark, at)) != std::string_view::npos; ++at) {
        const std::string_view line =
            generate::kernel_sources.substr(at, generate::kernel_sources.find('\n', at) + 1 - at);
        EXPECT_EQ(generate::kernel_sources.find(line), generate::kernel_sources.rfind(line)) << line;
    }
}

// The build takes today's files.
TEST(Shared, TextsAreThoseOfTheSources) {
    std::ifstream file(std::string(build_info::source_folder) + "/kernels/glsum/window/plain.hpp");
    std::ostringstream text;
    text << file.rdbuf();
    ASSERT_FALSE(text.str().empty());
    EXPECT_NE(generate::kernel_sources.find(text.str()), std::string_view::npos);
}

// A length that is known is told to the compiler but where that costs: over two pieces, and with mixed words.
TEST(Shared, LengthsAreConstantsWhereThatDoesNotCost) {
    const auto header = [](const char* kernel) {
        return generate::make_header(
            {.kernel = kernel, .order = 0.5, .taps = 20, .step_s = {}, .prefix = "my", .provenance = {}});
    };
    for (const char* kernel : {"shift_plain_f32", "mirror_plain_f32", "mirrordelta_plain_q31"}) {
        EXPECT_THAT(header(kernel), Not(HasSubstr("_KEEP_WORD(past)"))) << kernel;
    }
    for (const char* kernel : {"ring_plain_f32", "ring_plain_q31", "mirror_plain_q15c31"}) {
        EXPECT_THAT(header(kernel), HasSubstr("_KEEP_WORD(past)")) << kernel;
    }
    // Whole, a loop of fused products would load between them; in software an address costs more.
    EXPECT_THAT(header("mirror_multifma_f32"), HasSubstr("_KEEP_WORD(past)"));
    EXPECT_THAT(header("mirror_multi_f64"), HasSubstr("_KEEP_WORD(past)"));
    EXPECT_THAT(header("mirror_multi_f32"), Not(HasSubstr("_KEEP_WORD(past)")));
    EXPECT_THAT(header("ring_horner_f32"), HasSubstr("_KEEP_WORD(samples)"));
    EXPECT_THAT(header("ring_horner_f64"), Not(HasSubstr("_KEEP_WORD(samples)")));
}

// In software a call from each turn would cost more than the loop.
TEST(Shared, LoopsOfAFewTurnsAreWrittenOut) {
    const auto header = [](const char* kernel) {
        return generate::make_header(
            {.kernel = kernel, .order = 0.5, .taps = 50, .step_s = {}, .prefix = "my", .provenance = {}});
    };
    for (const char* kernel : {"block_oldestfma_f32", "block_plain_q31", "nested_plain_f32"}) {
        EXPECT_THAT(header(kernel), HasSubstr("_UNROLLED _Pragma(\"GCC unroll 16\")")) << kernel;
    }
    EXPECT_THAT(header("nested_plain_f64"), HasSubstr("_UNROLLED _Pragma(\"GCC unroll 1\")"));
    EXPECT_THAT(header("ring_plain_f32"), Not(HasSubstr("_UNROLLED")));
}

// A sum is a loop of the kernel's, whatever is called in it.
TEST(Shared, CallsAreTheHeaders) {
    const auto step = [](const char* kernel) {
        const std::string text = generate::make_header(
            {.kernel = kernel, .order = 0.5, .taps = 20, .step_s = {}, .prefix = "my", .provenance = {}});
        return text.substr(text.find("my_step_"));
    };
    EXPECT_THAT(step("ring_horner_f32"), HasSubstr("my_f32_horner_step(older[i - 1], table[newer_count + i], sum);"));
    EXPECT_THAT(step("ring_hornerfma_f32"), HasSubstr("my_f32_fused_horner_step(newer[i - 1], table[i], sum);"));
    EXPECT_THAT(step("ring_compensated_f32"),
                HasSubstr("my_f32_add(&sum, &lost, my_f32_multiply(table[i], older[i]));"));
    EXPECT_THAT(step("mirror_hornersplit_f32"), HasSubstr("my_f32_product(table[3], t3)"));
    EXPECT_THAT(step("ring_multi_f32"), HasSubstr("s2 = my_f32_multiply_add(s2, table[i + 2], older[i + 2]);"));
    EXPECT_THAT(step("mirror_pairwise_f32"), HasSubstr("const float p7 = my_f32_multiply(a[7], x[7]);"));
    EXPECT_THAT(step("nested_plain_f32"), HasSubstr("const float block = my_f32_together(younger, past[at]);"));
    EXPECT_THAT(step("block_plain_q31"), HasSubstr("my_q31_add_share(S->coming + q, first + q, samples, count);"));
    EXPECT_THAT(step("transposed_oldest_f32"), HasSubstr("*to = my_f32_multiply_add(*to, *a++, newest);"));
    EXPECT_THAT(step("mirrordelta_plain_q31"), HasSubstr("my_q31_saturate((int64_t)(newest) - S->before);"));
    EXPECT_THAT(step("mirrorlinear_plain_f32"),
                HasSubstr("my_f32_carry(S->mean, from_mean / (float)(k - MY_F32_PAST));"));
    EXPECT_THAT(step("mirror_scaled_q15"), HasSubstr("sum = sum * ((int64_t)(1) << (1));"));
    EXPECT_THAT(step("shift_fir_q15"), HasSubstr("S->past[i] = moving;"));
}

}  // namespace
