// What becomes of a program's timing logs: what the plugin is told, one log a part, and whose fault it is without one.
#include "qemu/emulate/timed_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "base/failure.hpp"
#include "made_emulator.hpp"
#include "made_program.hpp"

namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

const std::string no_losses = [] {
    std::string text;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        text += " 0";
    }
    return text + " 0\n";
}();

class TimedProgram : public testing::Test {
protected:
    void SetUp() override {
        test::MadeElf made = test::program();
        made.symbols.push_back({"__aeabi_dadd", 0x901, 0x10, true});
        made.write(folder_.file("a.elf"));
        log("calls 2 1024 50 core 1 80" + no_losses + "end\ncalls 1 1024 60 core 1 90" + no_losses + "end\n");
        ends_with(0);
    }
    [[nodiscard]] std::string text_of(const char* name) const {
        std::ifstream in(folder_.file(name));
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void log(const std::string& text) { std::ofstream(folder_.file("log")) << text; }
    void ends_with(int status) {
        emulator_ =
            test::made_emulator(folder_,
                                "echo \"$GLSUM_QEMU_PLUGIN\" >plugin; shift; echo \"$*\" >arguments\n"
                                "cp \"$(of watch)\" watch; cp \"$(of timing)\" request; cp log \"$(of times)\"\n"
                                "[ -z \"$(of marks)\" ] || cp \"$(of marks)\" marks\n"
                                "echo one; echo two; exit " +
                                    std::to_string(status) + "\n");
    }
    std::vector<timing::TimingLog> time(const std::optional<qemu::Marks>& marks = {},
                                        const std::function<void(const std::string&)>& line = {}) {
        timing::TimingRequest request;
        request.cores_folder = "cores";
        request.cores = {{"a-core", "", ""}};
        request.stretches = stretches_;
        return qemu::time_program(emulator_, "x.so", folder_.file("a.elf"), {"one", "2"}, {1024, 1088}, request, marks,
                                  line);
    }
    std::string fault(glsum::Exit status) {
        try {
            (void)time();
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), status) << failure.what();
            return failure.what();
        }
        return "none";
    }

    base::Scratch folder_;
    qemu::Emulator emulator_;
    std::set<std::uint32_t> stretches_;
};

TEST_F(TimedProgram, TellsThePluginAndReadsALogAPart) {
    std::vector<std::string> lines;
    const auto logs = time(qemu::Marks{16, 32, 48}, [&](const std::string& line) { lines.push_back(line); });
    ASSERT_EQ(logs.size(), 2U);
    EXPECT_EQ(logs[0].runs.at(0).calls, 2U);
    EXPECT_EQ(logs[1].runs.at(0).call.cores.at(0).half_cycles.at(0), 90);
    EXPECT_EQ(lines, (std::vector<std::string>{"one", "two"}));
    EXPECT_THAT(text_of("plugin"), testing::StartsWith("x.so,watch="));
    EXPECT_EQ(text_of("arguments"), "one 2\n");
    EXPECT_EQ(text_of("watch"), "1024\n1088\n");
    EXPECT_EQ(text_of("marks"), "16 32 48\n");
    EXPECT_EQ(text_of("request"), "folder cores\ndouble 2304 2320\ncore a-core - - 1 -\n");
}

TEST_F(TimedProgram, NeedsNoMarksAndNobodyToTell) {
    EXPECT_EQ(time().size(), 2U);
    EXPECT_THAT(text_of("plugin"), Not(HasSubstr("marks")));
}

// A program that fails says so itself; what its log lacks is then no news.
TEST_F(TimedProgram, AFailureOfTheProgramComesFirst) {
    ends_with(7);
    EXPECT_EQ(fault(glsum::Exit::check_failed), "a.elf under the emulator exited with 7; it said:\n  one\n  two");
    log("");
    EXPECT_THAT(fault(glsum::Exit::check_failed), HasSubstr("exited with 7"));
    ends_with(3);
    EXPECT_THAT(fault(glsum::Exit::missing), HasSubstr("exited with 3"));
    ends_with(0);
    EXPECT_THAT(fault(glsum::Exit::check_failed), HasSubstr("timing log: cut short"));
}

TEST_F(TimedProgram, ACallThatDidNotReturnIsToldWithWhy) {
    log("calls 2 1024 50 core 1 80" + no_losses + "unfinished\nend\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed),
                EndsWith("a.elf: a call of the timed function did not return before the program ended"));
    ends_with(3);
    EXPECT_THAT(fault(glsum::Exit::check_failed), HasSubstr("did not return; a.elf under the emulator exited with 3"));
}

TEST_F(TimedProgram, AFunctionThatWasNeverCalledIsNamedAmongSeveral) {
    log("calls 2 1024 50 core 1 80" + no_losses + "end\nend\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed), EndsWith("a.elf: step_of_block was never called"));
    log("unfinished\nend\ncalls 2 1024 50 core 1 80" + no_losses + "end\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed), HasSubstr("a.elf: a call of step_of_ring did not return"));
}

TEST_F(TimedProgram, AFailureSaysWhereTheProgramWas) {
    ends_with(7);
    log("calls 2 1024 50 core 1 80" + no_losses + "at 1090\nfault 1030\nend\n");
    EXPECT_THAT(
        fault(glsum::Exit::check_failed),
        EndsWith("; it faulted at 0x00000406 in step_of_ring; the last instruction that it executed was at 0x00000442 "
                 "in step_of_block"));
    log("at 16\nend\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed),
                EndsWith("two; the last instruction that it executed was at 0x00000010"));
}

TEST_F(TimedProgram, EveryPartCallsTheFunction) {
    log("calls 2 1024 50 core 1 80" + no_losses + "end\nend\nend\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed), EndsWith("a.elf: the timed function was never called"));
}

// Stretches have their logs behind those of the functions; only one that was met has calls.
TEST_F(TimedProgram, AStretchNeedNotBeMet) {
    stretches_ = {1026, 1090};
    const std::string call = "calls 2 1024 50 core 1 80" + no_losses + "end\n";
    log(call + call + call + "end\n");
    const auto logs = time();
    ASSERT_EQ(logs.size(), 4U);
    EXPECT_TRUE(logs[3].runs.empty());
    EXPECT_THAT(text_of("request"), HasSubstr("\nstretch 1026\nstretch 1090\n"));
    log(call + call + "end\nend\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed), EndsWith("a.elf: none of its 2 glsum_mark_begin was executed"));
    log(call + "end\n" + call + "end\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed), EndsWith("a.elf: step_of_block was never called"));
}

TEST_F(TimedProgram, MarksThatDoNotPairAreBadInputUnlessTheProgramFailed) {
    stretches_ = {1026};
    const std::string call = "calls 2 1024 50 core 1 80" + no_losses + "end\n";
    log(call + call + "misused 1090 1026\nend\n");
    EXPECT_THAT(fault(glsum::Exit::bad_input),
                EndsWith("a.elf: glsum_mark_begin at 0x00000442 in step_of_block stands within the stretch that "
                         "glsum_mark_begin at 0x00000402 in step_of_ring began: stretches do not nest"));
    log(call + call + "misused 1090\nend\n");
    EXPECT_THAT(fault(glsum::Exit::bad_input),
                EndsWith("a.elf: glsum_mark_end at 0x00000442 in step_of_block ends no stretch"));
    log(call + call + "open 1026\nend\n");
    EXPECT_THAT(fault(glsum::Exit::bad_input),
                EndsWith("a.elf: the stretch that glsum_mark_begin at 0x00000402 in step_of_ring began never met "
                         "glsum_mark_end before the program ended"));
    ends_with(7);
    EXPECT_THAT(fault(glsum::Exit::check_failed),
                HasSubstr("never met glsum_mark_end; a.elf under the emulator exited with 7"));
}

// The vector table has 16 vectors of the core, whatever they hold, and interrupts up to what is no function's
// beginning; hard, memory, bus and usage faults are its third to sixth. A vector of 0 is where the core locks up.
TEST_F(TimedProgram, NamesTheHandlersOfTheVectorTable) {
    const auto asked_with = [&](const std::vector<std::uint32_t>& table) {
        test::MadeElf made = test::program();
        made.sections.push_back({0, test::bytes_of(table)});
        made.write(folder_.file("a.elf"));
        (void)time();
        const std::string text = text_of("request");
        return text.substr(text.find('\n') + 1, text.find("core a-core") - text.find('\n') - 1);
    };
    std::vector<std::uint32_t> table{0x20001000, 0x401, 0x441, 0x501, 0x511, 0, 0x801, 0x811};
    table.resize(16, 0x821);
    const std::string of_core =
        "handler 0\nhandler 1024\nhandler 1088\nhandler 1280\nhandler 1296\nhandler 2048\n"
        "handler 2064\nhandler 2080\n";
    const std::string faults = "faults 0\nfaults 1280\nfaults 1296\nfaults 2048\n";
    table.insert(table.end(), {0x401, 0, 0x403, 0x831});
    EXPECT_THAT(asked_with(table), EndsWith(of_core + faults));
    table[18] = 0x841;
    EXPECT_THAT(asked_with(table), EndsWith(of_core + "handler 2096\nhandler 2112\n" + faults));
    table[18] = 0xF01;  // beyond every function
    EXPECT_THAT(asked_with(table), EndsWith(of_core + faults));
    table.resize(5);
    EXPECT_THAT(asked_with(table), EndsWith("handler 1088\nhandler 1280\nhandler 1296\nfaults 1280\nfaults 1296\n"));
    // Of no more than 496 interrupts.
    table.assign(600, 0x401);
    table[511] = 0x501;
    table[512] = 0x801;
    EXPECT_THAT(asked_with(table), EndsWith("handler 1024\nhandler 1280\nfaults 1024\n"));
}

}  // namespace
