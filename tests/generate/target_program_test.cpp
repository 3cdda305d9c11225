// How code becomes a program of the board, where no compiler for it is needed: one in its place says how it was called.
#include "bench/verify/target_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "tests/generate/pretend_compiler.hpp"
#include "tests/qemu/made_emulator.hpp"
#include "tests/qemu/made_program.hpp"

namespace {

using glsum::Exit;
using testing::HasSubstr;
using testing::Not;

class TargetProgram : public testing::Test {
protected:
    void flags(const std::string& flags) const { compiler_.flags(flags); }
    // What both compilers were called with, a line each.
    std::string linked() {
        (void)generate::link_for_target("int x;\n", board_, scratch_);
        return compiler_.calls();
    }

    test::PretendCompiler compiler_;
    qemu::Board& board_ = compiler_.board;
    base::Scratch& scratch_ = compiler_.scratch;
};

void expect_failure(const std::function<void()>& act, Exit status, const std::string& words) {
    try {
        act();
        ADD_FAILURE() << "not refused: " << words;
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), status);
        EXPECT_THAT(failure.what(), HasSubstr(words));
    }
}

// For which core, how hard to optimise and where functions begin; not how products contract, nor what is to be seen.
TEST_F(TargetProgram, IsCompiledAsTheFirmwareIs) {
    flags("-mcpu=cortex-m7 -mthumb -g -O3 -Wall -ffp-contract=off -falign-functions=8");
    const std::string said = linked();
    const std::string compiled = said.substr(0, said.find('\n'));
    const std::string program = said.substr(said.find('\n') + 1);
    EXPECT_THAT(compiled, HasSubstr(" -mcpu=cortex-m7 -mthumb -O3 -falign-functions=8 -c "));
    EXPECT_THAT(compiled, HasSubstr("-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror"));
    EXPECT_THAT(compiled, HasSubstr(scratch_.file("counted.c").string()));
    EXPECT_THAT(program, HasSubstr(" -mcpu=cortex-m7 -mthumb -O3 -falign-functions=8 -I"));
    EXPECT_THAT(program, HasSubstr((scratch_.file("board") / "libboard.a").string()));
    EXPECT_THAT(program, HasSubstr((scratch_.file("board") / "memory.ld").string()));
    EXPECT_THAT(said, Not(HasSubstr("contract")));
    EXPECT_THAT(said, Not(HasSubstr("GLSUM_CORTEX_M4")));
    std::ifstream in(scratch_.file("counted.c"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "int x;\n");
}

TEST_F(TargetProgram, OfACortexM4SaysSo) {
    flags("-mcpu=cortex-m4 -O2");
    EXPECT_THAT(linked(), HasSubstr(" -mcpu=cortex-m4 -DGLSUM_CORTEX_M4 -O2 -c "));
}

TEST_F(TargetProgram, NeedsTheFlagsOfTheFirmware) {
    const auto link = [&] { (void)linked(); };
    expect_failure(link, Exit::missing, "build_info.json: expected the flags of the firmware");
    for (const char* text : {"[1]", "{\"flags\": 3}", "{\"other\": \"-O3\"}", "{"}) {
        std::ofstream(board_.measure_elf.parent_path() / "build_info.json") << text;
        expect_failure(link, Exit::missing, "expected the flags of the firmware");
    }
}

TEST_F(TargetProgram, ACompilerThatRefusesIsQuoted) {
    expect_failure([] { generate::compile("echo it is wrong; exit 3", "the compiler"); }, Exit::check_failed,
                   "the compiler refuses: echo it is wrong; exit 3\nit is wrong\n");
    EXPECT_NO_THROW(generate::compile("echo it is good", "the compiler"));
    expect_failure([&] { generate::write_file(scratch_.file("none") / "file.c", "x"); }, Exit::bad_input,
                   "cannot write");
}

// A program with two functions to be watched, and an emulator that says `said`.
class TargetRun : public testing::Test {
protected:
    void SetUp() override {
        test::MadeElf made = test::program();
        made.symbols.push_back({"count_k0", 0x701, 0x10, true});
        made.symbols.push_back({"count_k1", 0x711, 0x10, true});
        made.write(folder_.file("verify.elf"));
        timing_.cores = {{"m7-ideal", "", ""}};
    }
    generate::TargetRun run(const std::string& said, std::size_t answers = 2) {
        board_.emulator = test::made_emulator(folder_, R"sh(cp "$(of watch)" seen_watch
cp "$(of marks)" seen_marks
cp "$(of timing)" seen_timing
{ echo "calls 1792 5 10 1 2 3"; echo "calls 1808 7 20 1 1 1"; echo end; } >"$(of out)"
{ echo "unknown 600 9"; echo end; echo "unknown 700 9"; echo end; } >"$(of times)"
)sh" + said);
        return generate::run_on_target(folder_.file("verify.elf"), {"count_k0", "count_k1"}, answers, board_, timing_,
                                       folder_, [&] { ++done_; });
    }
    [[nodiscard]] std::string seen(const char* name) const {
        std::ifstream in(folder_.file(name));
        return {std::istreambuf_iterator<char>(in), {}};
    }

    base::Scratch folder_;
    qemu::Board board_;
    timing::TimingRequest timing_;
    int done_ = 0;
};

TEST_F(TargetRun, HasTheAnswersCountsAndTimesOfEachFunction) {
    const generate::TargetRun found = run("echo row 0 7; echo row 1 4294967295; echo end 2\n");
    EXPECT_EQ(found.answers, (std::vector<std::uint32_t>{7, 0xFFFFFFFF}));
    EXPECT_EQ(found.entries, (std::vector<std::uint32_t>{0x700, 0x710}));
    EXPECT_EQ(done_, 2);
    ASSERT_EQ(found.counts.runs.size(), 2U);
    EXPECT_EQ(found.counts.runs[1].entry, 0x710U);
    EXPECT_EQ(found.counts.runs[1].calls, 7U);
    EXPECT_EQ(found.counts.runs[1].counts.instructions, 20U);
    ASSERT_EQ(found.timings.size(), 2U);
    EXPECT_EQ(found.timings[0].unknown.count(600), 1U);
    EXPECT_EQ(found.timings[1].unknown.count(700), 1U);
    // What is watched, between which marks, on which core.
    EXPECT_EQ(seen("seen_watch"), "1792\n1808\n");
    EXPECT_EQ(seen("seen_marks"), "1536 1552 1568\n");
    EXPECT_THAT(seen("seen_timing"), HasSubstr("core m7-ideal "));
}

TEST_F(TargetRun, TakesAnswersInTurnAndNothingElse) {
    const generate::TargetRun found =
        run("echo hello; echo row; echo row 1 5; echo row 0; echo row 0 x; echo line 0 3; echo row 0 4; echo row 0 6\n"
            "echo row 1 8; echo row 2 9\n");
    EXPECT_EQ(found.answers, (std::vector<std::uint32_t>{4, 8}));
    EXPECT_EQ(done_, 2);
    expect_failure([&] { (void)run("echo row 0 4; echo row 2 5\n"); }, Exit::check_failed,
                   "the firmware gave 1 answers of 2 and stopped");
    expect_failure([&] { (void)run("echo row 0 4; echo row 1 5\n", 3); }, Exit::check_failed,
                   "the firmware gave 2 answers of 3 and stopped");
}

}  // namespace
