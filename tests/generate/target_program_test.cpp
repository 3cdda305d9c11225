// How code becomes a program of the board, where no compiler for it is needed: one in its place says how it was called.
#include "bench/verify/target_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "base/failure.hpp"

namespace {

using glsum::Exit;
using testing::HasSubstr;
using testing::Not;

class TargetProgram : public testing::Test {
protected:
    void SetUp() override {
        path_ = std::getenv("PATH");
        setenv("PATH", ((scratch_.file("bin")).string() + ":" + path_).c_str(), 1);
        std::filesystem::create_directories(scratch_.file("bin"));
        std::filesystem::create_directories(scratch_.file("board"));
        board_.measure_elf = scratch_.file("board") / "measure.elf";
        board_.emulator.command = scratch_.file("board") / "emulate";
        for (const char* compiler : {"arm-none-eabi-gcc", "arm-none-eabi-g++"}) {
            const std::filesystem::path file = scratch_.file("bin") / compiler;
            std::ofstream(file) << "#!/bin/sh\necho \"$*\" >>'" << scratch_.file("calls").string() << "'\n";
            std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        }
    }
    void TearDown() override { setenv("PATH", path_.c_str(), 1); }
    void flags(const std::string& flags) {
        std::ofstream(board_.measure_elf.parent_path() / "build_info.json") << "{\"flags\": \"" << flags << "\"}";
    }
    // What both compilers were called with, a line each.
    std::string linked() {
        (void)generate::link_for_target("int x;\n", board_, scratch_);
        std::ifstream in(scratch_.file("calls"));
        return {std::istreambuf_iterator<char>(in), {}};
    }

    base::Scratch scratch_;
    qemu::Board board_;
    std::string path_;
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

}  // namespace
