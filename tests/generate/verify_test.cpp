// Headers on the target, where no target is needed: what is compiled there, what counts, when a header has passed.
#include "bench/verify/verify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/target/target_rows.hpp"
#include "tests/choose/pretend_board.hpp"
#include "tests/generate/pretend_compiler.hpp"
#include "tests/refusal.hpp"

namespace {

using generate::SteadyCalls;
using generate::Verified;
using testing::HasSubstr;

constexpr std::uint32_t one = 0x100;
constexpr std::uint32_t other = 0x200;

qemu::CallRun run(std::uint32_t entry, std::uint64_t calls, std::uint64_t instructions, std::uint64_t stores) {
    return {entry, calls, {instructions, 0, stores, 0}};
}

// With 3 taps the calls 4 to 35, counted from 0: the past is full behind the third, and one more is left out.
TEST(SteadyCalls, Are32OnceThePastIsFull) {
    const auto mean = [](const std::vector<qemu::CallRun>& runs) {
        return generate::steady_calls_of({runs, {}}, {{one, 3}, {other, 3}}).at(one);
    };
    const SteadyCalls all = mean({run(one, 100, 10, 2)});
    EXPECT_EQ(all.instructions, 10.0);
    EXPECT_EQ(all.stores, 2.0);
    EXPECT_EQ(all.first_instructions, 10U);
    // What is before them and behind them does not count.
    const SteadyCalls steady = mean({run(one, 1, 99, 9), run(one, 3, 999, 99), run(one, 32, 10, 2), run(one, 1, 9, 9)});
    EXPECT_EQ(steady.instructions, 10.0);
    EXPECT_EQ(steady.stores, 2.0);
    EXPECT_EQ(steady.first_instructions, 99U);
    // In the share that each has of the 32, with another function's calls between.
    const SteadyCalls mixed =
        mean({run(one, 12, 16, 8), run(other, 7, 1, 1), run(one, 23, 48, 16), run(one, 5, 80, 0)});
    EXPECT_EQ(mixed.instructions, (8.0 * 16.0 + 23.0 * 48.0 + 1.0 * 80.0) / 32.0);
    EXPECT_EQ(mixed.stores, (8.0 * 8.0 + 23.0 * 16.0) / 32.0);
    EXPECT_EQ(mixed.first_instructions, 16U);
    EXPECT_THROW((void)mean({run(0x300, 1, 1, 1)}), std::out_of_range);
}

Verified passed(const char* kernel) { return {kernel, 50, 0, 1000.0, 1000.0, 50.0, 50.0, 600.0, 600.0}; }

TEST(Verified, CyclesCountToTheLastOneAndInstructionsBesideThem) {
    EXPECT_TRUE(passed("ring_plain_f32").good());
    Verified wrong = passed("ring_plain_f32");
    wrong.first_wrong = 1;
    EXPECT_FALSE(wrong.good());
    Verified more = passed("ring_plain_f32");
    more.header_instructions = 1070.0;
    EXPECT_TRUE(more.good());
    more.header_instructions = 1070.25;
    EXPECT_FALSE(more.good());
    more.header_instructions = 900.0;
    EXPECT_TRUE(more.good());
    more.header_cycles = 600.25;
    EXPECT_FALSE(more.good());
}

// In software double the place of a call's branches is no cost: 4 % or 30 cycles; nor are some registers saved: a
// thousandth or 8 instructions.
TEST(Verified, InSoftwareDoubleThePlaceIsNoCost) {
    const auto good = [](double instructions, double more_instructions, double cycles, double more_cycles) {
        return Verified{"ring_plain_f32a64", 50, 0, instructions, instructions + more_instructions, 0.0, 0.0, cycles,
                        cycles + more_cycles}
            .good();
    };
    EXPECT_TRUE(good(1000.0, 8.0, 400.0, 30.0));
    EXPECT_FALSE(good(1000.0, 8.03, 400.0, 30.0));
    EXPECT_FALSE(good(1000.0, 8.0, 400.0, 30.1));
    EXPECT_TRUE(good(100000.0, 100.0, 10000.0, 400.0));
    EXPECT_FALSE(good(100000.0, 100.5, 10000.0, 400.0));
    EXPECT_FALSE(good(100000.0, 100.0, 10000.0, 402.0));
}

TEST(Verified, ATableSaysWhichFailed) {
    Verified wrong = passed("shift_plain_q15");
    wrong.first_wrong = 7;
    wrong.header_instructions = 1100.0;
    wrong.header_cycles = 540.0;
    const std::string table = generate::to_table({passed("ring_plain_f32"), wrong}, "a-core", {});
    EXPECT_THAT(
        table, HasSubstr("ring_plain_f32                50  the kernel's        1000.0      1000.0   1.0000       600.0"
                         "      600.0   1.0000\n"));
    EXPECT_THAT(
        table, HasSubstr("shift_plain_q15               50  differ at 7         1000.0      1100.0   1.1000       600.0"
                         "      540.0   0.9000  FAILED\n"));
    EXPECT_TRUE(table.ends_with("cycles of the timing model for a-core\n")) << table;
}

// A C file with a function for each header, its types by its format, and whether its calls are of software double.
TEST(Verified, WhatIsCompiledCallsEachHeadersStep) {
    const auto spec = [](const char* kernel, std::size_t taps, const char* prefix) {
        return generate::Spec{
            .kernel = kernel, .order = 0.5, .taps = taps, .step_s = {}, .prefix = prefix, .provenance = {}};
    };
    const std::string source = generate::counted_source(
        {spec("ring_oldest_f64", 50, "k0"), spec("shift_plain_f32", 20, "k1"), spec("ring_plain_q31", 30, "k2"),
         spec("ring_plain_q15", 40, "k3"), spec("ring_plain_f32a64", 10, "k4")});
    EXPECT_THAT(source, HasSubstr("#define K0_F64_TABLE_ATTRIBUTES "));
    EXPECT_THAT(source, HasSubstr("#include \"k1.h\"\ntypedef float sample_k1;\ntypedef float output_k1;\n"));
    EXPECT_THAT(source, HasSubstr("typedef double sample_k0;\ntypedef double output_k0;\n"));
    EXPECT_THAT(source, HasSubstr("typedef int32_t sample_k2;\ntypedef int32_t output_k2;\n"));
    EXPECT_THAT(source, HasSubstr("typedef int16_t sample_k3;\ntypedef int32_t output_k3;\n"));
    EXPECT_THAT(source, HasSubstr("typedef float sample_k4;\ntypedef float output_k4;\n"));
    EXPECT_THAT(source, HasSubstr("return k1_step_f32(S, x);"));
    EXPECT_THAT(source, HasSubstr("glsum_make_calls(50U, 1U, call_k0);"));
    EXPECT_THAT(source, HasSubstr("glsum_make_calls(20U, 0U, call_k1);"));
    EXPECT_THAT(source, HasSubstr("glsum_make_calls(30U, 0U, call_k2);"));
    EXPECT_THAT(source, HasSubstr("glsum_make_calls(10U, 1U, call_k4);"));
    EXPECT_THAT(source, HasSubstr("entries[])(void) = {\n    verify_k0,\n    verify_k1,\n    verify_k2,\n"));
}

// Without the firmware's flags beside it nothing is compiled.
TEST(Verified, AFolderWithoutFlagsIsNamed) {
    const base::Scratch folder;
    qemu::Board board;
    board.measure_elf = folder.file("measure.elf");
    EXPECT_THAT(test::refusal(glsum::Exit::missing,
                              [&] {
                                  (void)generate::verify_on_target({{.kernel = "shift_plain_f32",
                                                                     .order = 0.5,
                                                                     .taps = 5,
                                                                     .step_s = {},
                                                                     .prefix = "a",
                                                                     .provenance = {}}},
                                                                   board, {});
                              }),
                HasSubstr("build_info.json: expected the flags of the firmware"));
}

// From a board and a compiler that are pretended: of each header its own answer, counts and cycles, beside its
// kernel's.
TEST(Verified, EachHeaderIsHeldAgainstItsKernel) {
    const test::PretendCompiler compiler;
    test::MadeElf made = test::program();
    made.symbols.push_back({"count_k0", 0x701, 0x10, true});
    made.symbols.push_back({"count_k1", 0x711, 0x10, true});
    made.write(compiler.linked());
    std::string losses;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        losses += " 0";
    }
    // The past of 5 taps and that of 40 fill; of a turn of 32 and of 40, and of two calls before it, the times.
    const auto said = [&](const base::Machine& machine) {
        const test::PretendBoard pretended(0.5, 60, 7, 20, 24, machine);
        pretended.knows(5);
        pretended.knows(40);
        pretended.runs(fmt::format(R"sh(
{{ echo "calls 1792 1 100 1 1 1"; echo "calls 1792 5 99 9 9 9"; echo "calls 1792 32 45 5 4 2"
   echo "calls 1808 1 200 1 1 1"; echo "calls 1808 40 99 9 9 9"; echo "calls 1808 40 380 5 6 2"; echo end; }} >"$(of out)"
{{ echo "calls 1 1792 100 core 1 2{0} 0"; echo "calls 34 1792 9 core 1 180{0} 0"; echo end
   echo "calls 1 1808 200 core 1 2{0} 0"; echo "calls 42 1808 9 core 1 1700{0} 0"; echo end; }} >"$(of times)"
echo row 0 0; echo row 1 9
)sh",
                                   losses));
        const auto spec = [](std::size_t taps) {
            return generate::Spec{
                .kernel = "ring_plain_f32", .order = 0.5, .taps = taps, .step_s = {}, .provenance = {}};
        };
        return generate::verify_on_target({spec(5), spec(40)}, pretended.board(),
                                          bench::timing_request(TEST_CORES, {"m7-ideal"}));
    };
    const std::vector<Verified> found = said(base::machines[0]);
    ASSERT_EQ(found.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(found[i].kernel, "ring_plain_f32");
        EXPECT_EQ(found[i].taps, i == 0 ? 5U : 40U);
        EXPECT_EQ(found[i].first_wrong, i == 0 ? 0U : 9U);
        EXPECT_DOUBLE_EQ(found[i].kernel_instructions, i == 0 ? 50.0 : 400.0);
        EXPECT_DOUBLE_EQ(found[i].header_instructions, i == 0 ? 45.0 : 380.0);
        EXPECT_DOUBLE_EQ(found[i].kernel_stores, 1.0);
        EXPECT_DOUBLE_EQ(found[i].header_stores, i == 0 ? 4.0 : 6.0);
        EXPECT_DOUBLE_EQ(found[i].kernel_cycles, i == 0 ? 100.0 : 800.0);
        EXPECT_DOUBLE_EQ(found[i].header_cycles, i == 0 ? 90.0 : 850.0);
        EXPECT_FALSE(found[i].single_issue);
    }
    // One instruction a cycle: where a product waits, a tenth more is none too many.
    EXPECT_TRUE(said(base::machines[1]).at(1).single_issue);
}

}  // namespace
