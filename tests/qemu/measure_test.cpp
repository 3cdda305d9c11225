// What becomes of a firmware's answers, of the counter's log and of the timer's, from a program and logs made by hand:
// no emulator is needed to tell whether they are put together rightly.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/registry.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/firmware.hpp"
#include "qemu/emulate/model_run.hpp"
#include "qemu/emulate/software_double.hpp"
#include "qemu/emulate/watched.hpp"
#include "targets/shared/output_hash.hpp"
#include "tests/qemu/made_elf.hpp"
#include "tests/qemu/made_emulator.hpp"
#include "tests/qemu/made_program.hpp"
#include "tests/refusal.hpp"

namespace {

using test::block;
using test::block_answer;
using test::calls;
using test::check_calls;
using test::MadeElf;
using test::program;
using test::ring;

std::string text_of(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Build attributes as an assembler writes them: names of the processor (tags 4 and 5), its architecture (6), profile
// (7).
std::vector<std::uint8_t> attributes(std::uint8_t architecture, char profile) {
    std::vector<std::uint8_t> bytes{'A', 40, 0, 0, 0, 'a', 'e', 'a', 'b', 'i', 0, 1, 30, 0, 0, 0};
    for (const char c : {'\5', 'M', '7', '\0', '\x20', '\1', 'x', '\0', '\x22', '\1', '\x8a', '\1', '\1'}) {
        bytes.push_back(static_cast<std::uint8_t>(c));  // a processor, a text of tag 32, a number, one of tag 138
    }
    bytes.insert(bytes.end(), {6, architecture});
    if (profile != 0) {
        bytes.insert(bytes.end(), {7, static_cast<std::uint8_t>(profile)});
    }
    // Texts, of tags 4, 5, 67, and 32 behind a number, that would be another architecture if they were none.
    for (const int tag : {4, 5, 67, 32}) {
        bytes.insert(bytes.end(), {static_cast<std::uint8_t>(tag), 1, 6, 9, 0});
    }
    return bytes;
}

TEST(MadeElf, HasItsSymbolsFunctionsAndBytes) {
    const base::Scratch folder;
    MadeElf made;
    made.sections = {{0x100, test::bytes_of({0x11223344, 0x55667788})}, {0x20000000, {'h', 'e', 'l', 'l', 'o'}}};
    made.symbols = {{"first", 0x101, 4, true},       {"second", 0x109, 0x10, true},
                    {"of_assembly", 0x119, 0, true}, {"third", 0x121, 2, true},
                    {"data", 0x20000001, 5},         {"elsewhere", 0x500, 4, true, false},
                    {"_Z5shownif", 0x141, 8, true},  {"_Z5twicei", 0x151, 8, true},
                    {"_Z5twicef", 0x161, 8, true},   {"loop.constprop.0", 0x171, 8, true}};
    made.write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    EXPECT_EQ(elf.symbol("first"), 0x100U);  // without the Thumb bit
    EXPECT_EQ(elf.symbol("data"), 0x20000001U);
    EXPECT_FALSE(elf.symbol("elsewhere"));
    EXPECT_FALSE(elf.symbol("nothing"));
    EXPECT_EQ(elf.word(0x100), 0x11223344U);
    EXPECT_EQ(elf.word(0x104), 0x55667788U);
    EXPECT_EQ(elf.word(0x102), 0x77881122U);
    EXPECT_EQ(elf.text(0x20000000, 5), "hello");
    EXPECT_EQ(elf.text(0x20000001, 2), "el");
    for (const std::uint32_t address : {0xFCU, 0xFFU, 0x105U, 0x108U, 0x20000002U, 0xFFFFFFFFU}) {
        EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)elf.word(address); })
                      .find(folder.file("a.elf").string() + ": no section holds address 0x"),
                  0U);
    }
    // A function holds its bytes and no more; the end of one without a size is where the next begins.
    EXPECT_EQ(elf.function_at(0xFF), nullptr);
    EXPECT_EQ(elf.function_at(0x100)->name, "first");
    EXPECT_EQ(elf.function_at(0x103)->name, "first");
    EXPECT_EQ(elf.function_at(0x104), nullptr);
    EXPECT_EQ(elf.function_at(0x117)->name, "second");
    EXPECT_EQ(elf.function_at(0x118), nullptr);
    EXPECT_EQ(elf.end_of_function(0x108), 0x118U);
    EXPECT_EQ(elf.end_of_function(0x118), 0x120U);
    EXPECT_EQ(elf.end_of_function(0x1000), 0x1000U);
    // By the names of the linker and of C++.
    EXPECT_EQ(elf.function("second").address, 0x108U);
    EXPECT_EQ(elf.function("second").bytes, 0x10U);
    EXPECT_EQ(elf.function("shown").address, 0x140U);
    EXPECT_EQ(elf.function("shown(int, float)").address, 0x140U);
    EXPECT_EQ(elf.function("_Z5shownif").address, 0x140U);
    EXPECT_EQ(elf.function("twice(int)").address, 0x150U);
    EXPECT_EQ(elf.function("loop").address, 0x170U);
    EXPECT_NE(test::refusal(glsum::Exit::bad_input, [&] { (void)elf.function("twice"); })
                  .find("twice is the name of 2 functions: _Z5twicei at 0x150 _Z5twicef at 0x160"),
              std::string::npos);
    // The three closest, the closest first.
    EXPECT_NE(test::refusal(glsum::Exit::bad_input, [&] { (void)elf.function("secund"); })
                  .find("the closest names are second, "),
              std::string::npos);
    EXPECT_NE(test::refusal(glsum::Exit::bad_input, [&] { (void)elf.function("thirds"); })
                  .find("the closest names are third, first, twice(float)"),
              std::string::npos)
        << test::refusal(glsum::Exit::bad_input, [&] { (void)elf.function("thirds"); });
    EXPECT_THROW((void)elf.function("data"), glsum::Failure);
}

TEST(MadeElf, ALabelInCodeIsAFunctionOfItsFirstInstruction) {
    const base::Scratch folder;
    MadeElf made;
    made.sections = {{0x100, test::bytes_of({0, 0})}, {0x20000000, test::bytes_of({0})}};
    made.symbols = {{"label", 0x105, 0, true}, {"in_memory", 0x20000000, 0}, {"f", 0x101, 4, true}};
    made.write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    EXPECT_EQ(elf.function("label").address, 0x104U);
    EXPECT_EQ(elf.function("label").bytes, 2U);
    EXPECT_THROW((void)elf.function("in_memory"), glsum::Failure);
}

TEST(MadeElf, OtherMachinesTypesAndDamageAreRefused) {
    const base::Scratch folder;
    const auto said = [&](const MadeElf& made) {
        made.write(folder.file("a.elf"));
        return test::refusal(glsum::Exit::bad_input, [&] { const qemu::Elf elf(folder.file("a.elf")); });
    };
    MadeElf made;
    made.sections = {{0, test::bytes_of({0})}};
    made.symbols = {{"f", 1, 2, true}};
    made.machine = 62;
    EXPECT_NE(said(made).find("an ELF of machine 62 and type 2"), std::string::npos);
    made.machine = 40;
    made.type = 1;
    EXPECT_NE(said(made).find("an ELF of machine 40 and type 1"), std::string::npos);
    made.type = 2;
    made.symbols = {{std::string(8193, 'x'), 1, 2, true}};
    EXPECT_NE(said(made).find("a symbol's name of more than 8192 bytes"), std::string::npos);
    made.symbols = {{std::string(8192, 'x'), 1, 2, true}};
    made.write(folder.file("a.elf"));
    EXPECT_EQ(qemu::Elf(folder.file("a.elf")).symbols().size(), 1U);
}

TEST(MadeElf, RunsOnTheCoreByItsAttributesOrItsVectors) {
    const base::Scratch folder;
    MadeElf made;
    made.symbols = {{"f", 1, 2, true}};
    const auto checked = [&]() -> std::string {
        made.write(folder.file("a.elf"));
        try {
            qemu::Elf(folder.file("a.elf")).check_runs_on("Cortex-M7");
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            const std::string what = failure.what();
            return what.substr(what.find("found ") + 6);
        }
        return "";
    };
    made.sections = {{0, test::bytes_of({0x20001000, 0x101})}};
    // [Arm IHI 0045]: v6-M 11, v6S-M 12, v7E-M 13, and v7 10 of profile M.
    for (const auto& [architecture, profile] :
         {std::pair(11, 'M'), std::pair(12, 'M'), std::pair(13, 'M'), std::pair(10, 'M'), std::pair(13, '\0')}) {
        made.attributes = attributes(static_cast<std::uint8_t>(architecture), profile);
        EXPECT_EQ(checked(), "") << architecture;
    }
    for (const auto& [architecture, profile, name] :
         {std::tuple(10, 'A', "one for ARMv7, profile A"), std::tuple(10, '\0', "one for ARMv7"),
          std::tuple(14, 'A', "one for ARMv8-A, profile A"), std::tuple(15, 'R', "one for ARMv8-R, profile R"),
          std::tuple(16, 'M', "one for ARMv8-M baseline, profile M"),
          std::tuple(17, 'M', "one for ARMv8-M mainline, profile M"),
          std::tuple(21, 'M', "one for ARMv8.1-M mainline, profile M"),
          std::tuple(22, 'A', "one for ARMv9-A, profile A"), std::tuple(9, '\0', "one for architecture 9")}) {
        made.attributes = attributes(static_cast<std::uint8_t>(architecture), profile);
        EXPECT_EQ(checked(), name);
    }
    // The first pair lies just behind the heads: the format (a byte), the section's length (4), "aeabi" (6), tag and
    // length of the whole file's part (1 and 4).
    made.attributes = {'A', 19, 0, 0, 0, 'a', 'e', 'a', 'b', 'i', 0, 1, 9, 0, 0, 0, 6, 10, 7, 'M'};
    EXPECT_EQ(checked(), "");
    // Without any: by the vector table at address 0, whose second word begins in Thumb state.
    made.attributes.clear();
    EXPECT_EQ(checked(), "");
    const std::string none = "none whose vector table at address 0 starts it in Thumb state";
    made.sections = {{0, test::bytes_of({0x20001000, 0x100})}};
    EXPECT_EQ(checked(), none);
    made.sections = {{0, {0, 0, 0, 0, 1, 0, 0}}};
    EXPECT_EQ(checked(), none);
    made.sections = {{0x100, test::bytes_of({0x20001000, 0x101})}};
    EXPECT_EQ(checked(), none);
}

TEST(MadeElf, DoubleRoutinesAreItsOwnFromTheirFirstByteToTheirLast) {
    const base::Scratch folder;
    MadeElf made;
    made.sections = {{0, test::bytes_of({0, 0})}};
    made.symbols = {{"__aeabi_dadd", 0x201, 0x10, true},
                    {"__adddf3", 0x201, 0x10, true},
                    {"__aeabi_dmul", 0x301, 0, true},
                    {"memcpy", 0x341, 4, true},
                    {"__aeabi_fadd", 0x401, 4, true}};
    made.write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    timing::TimingRequest request;
    request.cores = {{"one", "", ""}};
    const timing::TimingRequest own = qemu::for_program(request, elf);
    ASSERT_EQ(own.double_routines.size(), 2U);
    EXPECT_EQ(own.double_routines[0].begin, 0x200U);
    EXPECT_EQ(own.double_routines[0].end, 0x210U);
    EXPECT_EQ(own.double_routines[1].begin, 0x300U);
    EXPECT_EQ(own.double_routines[1].end, 0x340U);  // where the next function begins
    EXPECT_EQ(own.cores.size(), 1U);
}

// Of 3 taps: the first call, three that fill the past, 32 of a turn, one on the painted stack. Of 40 taps the turn is
// 40, of whose first 32 the mean is. In halves: 32 first halves behind.
const std::string rows_of_log =
    calls(ring, 1, "100 10 5 7") + calls(ring, 3, "500 90 90 90") + calls(ring, 16, "50 20 10 4") +
    calls(ring, 16, "70 24 10 6") + calls(ring, 1, "999 999 999 999") + calls(ring, 1, "200 20 10 14") +
    calls(ring, 40, "900 1 1 1") + calls(ring, 32, "50 20 10 4") + calls(ring, 8, "80 99 99 99") +
    calls(ring, 1, "50 20 10 4") + calls(block, 1, "31 3 2 1") + calls(block, 2, "9 9 9 9") +
    calls(block, 33, "40 8 4 2") + calls(block_answer, 32, "5 1 1 1");
const std::string reached = "reached 1024 1024 1030 1280 64\nreached 1088 1088\nend\n";

class MeasureMade : public testing::Test {
protected:
    void SetUp() override {
        program().write(folder_.file("measure.elf"));
        say("row 0 0 ab 12 34 56\nrow 1 0 cd 13 35 57\nrow 2 5\nrow 3 0 ef 14 36 58\nend 4\n");
        log(check_calls() + rows_of_log + reached);
        emulator_ = test::made_emulator(
            folder_,
            "echo \"$GLSUM_QEMU_PLUGIN\" >plugin\n"
            "cp log \"$(of out)\"; cp \"$(of watch)\" watch\n"
            "if [ -n \"$(of timing)\" ]; then cp times \"$(of times)\"; cp \"$(of marks)\" marks; cp \"$(of timing)\" "
            "request; fi\n"
            "cat said\n");
    }
    void say(const std::string& text) { std::ofstream(folder_.file("said")) << text; }
    void log(const std::string& text) { std::ofstream(folder_.file("log")) << text; }
    std::vector<qemu::MeasuredRow> measure(qemu::Counting counting = qemu::Counting::blocks,
                                           const timing::TimingRequest& timing = {}) {
        const qemu::Board board{folder_.file("measure.elf"), "replay.elf", "x.so", emulator_};
        std::vector<qemu::PlannedRow> plan;
        for (const std::size_t taps : {3U, 40U, 7U}) {
            plan.push_back({"ring_plain_f32", 0.5, taps, 0, qemu::calls_to_measure("ring_plain_f32", taps)});
        }
        plan.push_back({"block_plain_q31", 0.5, 2, 0, qemu::calls_to_measure("block_plain_q31", 2)});
        return qemu::measure(
            board, plan, {{0.5}}, [&] { ++done_; }, counting, timing);
    }
    std::string fault() {
        return test::refusal(glsum::Exit::check_failed, [&] { (void)measure(); });
    }

    base::Scratch folder_;
    qemu::Emulator emulator_;
    std::size_t done_ = 0;
};

TEST_F(MeasureMade, CountsAreTheMeansOfTheSteadyCalls) {
    const auto rows = measure();
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(done_, 4U);
    EXPECT_EQ(rows[0].hash, 0xABU);
    EXPECT_EQ(rows[0].stack_bytes, 12U);
    EXPECT_EQ(rows[0].state_bytes, 34U);
    EXPECT_EQ(rows[0].coefficient_bytes, 56U);
    EXPECT_EQ(rows[0].first, (qemu::CallCounts{100, 10, 5, 7}));
    EXPECT_DOUBLE_EQ(rows[0].instructions, 60.0);
    EXPECT_DOUBLE_EQ(rows[0].loads, 22.0);
    EXPECT_DOUBLE_EQ(rows[0].stores, 10.0);
    EXPECT_DOUBLE_EQ(rows[0].branches, 5.0);
    EXPECT_EQ(rows[0].worst_instructions, 70U);
    EXPECT_EQ(rows[0].code_bytes, 0x20U + 0x10U);  // the kernel's own function and the helper, each once
    EXPECT_TRUE(rows[0].cores.empty());
    EXPECT_EQ(rows[1].first.instructions, 200U);
    EXPECT_DOUBLE_EQ(rows[1].instructions, 50.0);
    EXPECT_DOUBLE_EQ(rows[1].loads, 20.0);
    EXPECT_EQ(rows[1].worst_instructions, 80U);
    EXPECT_EQ(rows[2].status, static_cast<glsum::Status>(5));
    EXPECT_EQ(rows[3].first.instructions, 31U);
    EXPECT_DOUBLE_EQ(rows[3].instructions, 40.0);
    EXPECT_DOUBLE_EQ(rows[3].branches, 2.0);
    EXPECT_EQ(rows[3].code_bytes, 0x30U);
    // The instrument is told of the loops first, then of the kernels with their halves.
    EXPECT_EQ(text_of(folder_.file("watch")), "2048\n2064\n2080\n2096\n2112\n2128\n2144\n1088\n1152\n1024\n");
    const std::string plugin = text_of(folder_.file("plugin"));
    EXPECT_EQ(plugin.find("x.so,watch="), 0U) << plugin;
    EXPECT_NE(plugin.find(",stream=off\n"), std::string::npos) << plugin;
    EXPECT_EQ(plugin.find("timing="), std::string::npos) << plugin;
    (void)measure(qemu::Counting::stream);
    EXPECT_NE(text_of(folder_.file("plugin")).find(",stream=on\n"), std::string::npos);
}

TEST_F(MeasureMade, CyclesAreThoseOfEachRowsLog) {
    std::ofstream times(folder_.file("times"));
    for (const auto& [kernel, taps, first, halves] :
         {std::tuple("ring_plain_f32", 3U, 100, 0), std::tuple("ring_plain_f32", 40U, 200, 0),
          std::tuple("block_plain_q31", 2U, 31, 32)}) {
        const firmware::TimedCalls timed = qemu::timed_calls(kernel, taps);
        std::size_t count = 0;
        for (std::size_t call = 0; call < timed.calls(); ++call) {
            count += timed.contains(call) ? 1 : 0;
        }
        std::string losses;
        for (std::size_t e = 0; e < timing::effect_count; ++e) {
            losses += " 0";
        }
        times << "calls " << count << " 1024 " << first << " core 3 " << 2 * taps << ' ' << taps << ' ' << 3 * taps
              << losses << " 0\n";
        if (halves > 0) {
            times << "calls " << halves << " 1152 5 core 3 6 6 6" << losses << " 0\n";
        }
        times << "unknown " << 500 + taps << " 9\nend\n";
    }
    times.close();
    timing::TimingRequest request;
    request.cores_folder = TEST_CORES;
    request.cores = {{"m7-ideal", "", ""}};
    const auto rows = measure(qemu::Counting::blocks, request);
    for (const auto& [i, taps] : {std::pair(0, 3.0), std::pair(1, 40.0), std::pair(3, 2.0)}) {
        ASSERT_EQ(rows[i].cores.size(), 1U);
        EXPECT_NEAR(rows[i].cores[0].cycles, taps, 1e-12);
        EXPECT_NEAR(rows[i].cores[0].low, 0.5 * taps, 1e-12);
        EXPECT_NEAR(rows[i].cores[0].high, 1.5 * taps, 1e-12);
        EXPECT_EQ(rows[i].unknown_encodings, std::vector<std::uint32_t>{500 + static_cast<std::uint32_t>(taps)});
    }
    EXPECT_NEAR(rows[3].cores[0].latency_cycles, 3.0, 1e-12);
    EXPECT_TRUE(rows[2].cores.empty());
    EXPECT_EQ(text_of(folder_.file("marks")), "1536 1552 1568\n");
    EXPECT_NE(text_of(folder_.file("request")).find("core m7-ideal "), std::string::npos);
    // A core that does not exist is refused before anything runs.
    request.cores = {{"no-core", "", ""}};
    std::filesystem::remove(folder_.file("plugin"));
    EXPECT_THROW((void)measure(qemu::Counting::blocks, request), glsum::Failure);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("plugin")));
}

TEST_F(MeasureMade, AnInstrumentThatMiscountsIsNotBelieved) {
    std::string wrong = check_calls();
    wrong.replace(wrong.find("calls 2048 1 5 1 1 2"), 20, "calls 2048 1 6 1 1 2");
    log(wrong + rows_of_log + reached);
    EXPECT_EQ(fault(),
              "the instrument miscounts: glsum_check_steps with 1 turns: expected 5 instructions, 1 loads, 1 stores, 2 "
              "branches; found 6 instructions, 1 loads, 1 stores, 2 branches");
    wrong = check_calls();
    const std::string last = "calls 2144 1 6003 1002 1002 3001";
    ASSERT_NE(wrong.find(last), std::string::npos) << wrong;
    wrong.replace(wrong.find(last), last.size(), "calls 2144 1 6003 1002 1002 3000");
    log(wrong + rows_of_log + reached);
    EXPECT_NE(fault().find("glsum_check_nested with 1000 turns"), std::string::npos);
    log(check_calls() + rows_of_log + calls(ring, 1, "1 1 1 1") + reached);
    EXPECT_EQ(fault(), "the instrument saw more calls than the program made");
    log(check_calls() + reached);
    EXPECT_EQ(fault(), "the instrument saw other calls than the program made");
    log(check_calls() + calls(block, 1, "1 1 1 1") + rows_of_log + reached);
    EXPECT_EQ(fault(), "the instrument saw other calls than the program made");
    log(check_calls() + rows_of_log + "reached 1024 1024\nend\n");
    EXPECT_EQ(fault(), "the instrument saw no instruction of block_plain_q31");
}

TEST_F(MeasureMade, WhatTheProgramMustOfferIsAskedForByName) {
    for (const char* missing : {"glsum_watched", "glsum_watched_count", "glsum_mark_row", "glsum_mark_on",
                                "glsum_mark_off", "glsum_check_edge"}) {
        MadeElf without = program();
        std::erase_if(without.symbols, [&](const test::MadeSymbol& symbol) { return symbol.name == missing; });
        without.write(folder_.file("measure.elf"));
        EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)measure(); }),
                  folder_.file("measure.elf").string() + ": expected the symbol " + missing);
    }
}

// The same calls here: as many as the plan says, of a signal that is repeated where it is shorter.
TEST(Replay, HereHashesEveryCall) {
    const std::vector<double> signal = {0.5, -0.25, 0.125};
    const auto hash_of = [&](std::size_t calls) {
        bench::HostLine<glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>> line(glsum::Design{0.5, 4});
        firmware::OutputHash hash;
        for (std::size_t k = 0; k < calls; ++k) {
            hash.add(line.step(static_cast<float>(signal[k % 3])));
        }
        return hash.value();
    };
    const qemu::Signals signals = {{1.0}, signal};
    for (const std::size_t calls : {0U, 1U, 3U, 4U, 11U}) {
        const qemu::ReplayedRow row = qemu::replay_here({"ring_plain_f32", 0.5, 4, 1, calls}, signals);
        EXPECT_EQ(row.status, glsum::Status::ok);
        EXPECT_EQ(row.hash, hash_of(calls)) << calls;
    }
    EXPECT_EQ(qemu::replay_here({"ring_plain_f32", 7.0, 4, 1, 5}, signals).status, glsum::Status::order_out_of_range);
    EXPECT_THROW((void)qemu::replay_here({"no_kernel", 0.5, 4, 1, 5}, signals), std::out_of_range);
}

constexpr double some_ratios[] = {0.5, 0.25};
constexpr double some_input[] = {1.0, -1.0, 0.5};

// Steps of whole models, of a program whose table has rows of three words.
class MeasureModel : public testing::Test {
protected:
    void SetUp() override {
        MadeElf made = program();
        made.sections[1] = {0x2000, test::bytes_of({0x1000, 14, ring + 1, 0x100E, 15, block + 1, 2})};
        made.symbols[1] = {"glsum_watched_count", 0x2018, 4};
        made.write(folder_.file("model.elf"));
        std::ofstream(folder_.file("said")) << "row 0 0 ab 12 34 56\nrow 1 5\nrow 2 0 cd 13 35 57\nend 3\n";
        log(steps_ + reached);
        emulator_ = test::made_emulator(
            folder_,
            "echo \"$GLSUM_QEMU_PLUGIN\" >plugin\nfor last; do :; done\ncp \"$last\" plan\n"
            "cp \"$(sed -n '1s/^glsum-model-2 //p' plan)\" numbers\n"
            "cp log \"$(of out)\"; cp \"$(of watch)\" watch\n"
            "if [ -n \"$(of timing)\" ]; then cp times \"$(of times)\"; cp \"$(of marks)\" marks; cp \"$(of timing)\" "
            "request; fi\ncat said\n");
        design_.tables = tables_;
    }
    void log(const std::string& text) { std::ofstream(folder_.file("log")) << text; }
    std::vector<qemu::MeasuredRow> step(const timing::TimingRequest& timing = {}, std::size_t steps = 100) {
        const qemu::Board board{folder_.file("measure.elf"), "replay.elf", "x.so", emulator_};
        const std::vector<qemu::PlannedModel> plan = {{"ring_plain_f32", &design_, some_input, steps},
                                                      {"ring_plain_f32", &design_, some_input, steps},
                                                      {"block_plain_q31", &other_, some_input, 132}};
        return qemu::step_models(
            board, plan, [&] { ++done_; }, timing);
    }

    base::Scratch folder_;
    qemu::Emulator emulator_;
    const glsum::PastTable tables_[1] = {{2.0, some_ratios}};
    glsum::ModelDesign design_{.increments = false, .delay = 7, .input = 0.5, .constant = 0.25, .tables = {}};
    const glsum::ModelDesign other_{.half_input = true, .input_full_scale = 4.0, .tables = {}};
    // Of 100 steps the last 32, behind which one is on the painted stack; of 132 the same.
    const std::string steps_ = calls(ring, 1, "100 10 5 7") + calls(ring, 67, "500 90 90 90") +
                               calls(ring, 16, "50 20 10 4") + calls(ring, 16, "70 24 10 6") +
                               calls(ring, 1, "999 999 999 999") + calls(block, 2, "31 3 2 1") +
                               calls(block, 99, "40 8 4 2") + calls(block, 32, "48 16 8 4");
    std::size_t done_ = 0;
};

TEST_F(MeasureModel, CountsAreOfTheLastSteps) {
    const auto rows = step();
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(done_, 3U);
    EXPECT_EQ(rows[0].hash, 0xABU);
    EXPECT_EQ(rows[0].first, (qemu::CallCounts{100, 10, 5, 7}));
    EXPECT_DOUBLE_EQ(rows[0].instructions, 60.0);
    EXPECT_DOUBLE_EQ(rows[0].loads, 22.0);
    EXPECT_DOUBLE_EQ(rows[0].stores, 10.0);
    EXPECT_DOUBLE_EQ(rows[0].branches, 5.0);
    EXPECT_EQ(rows[0].worst_instructions, 500U);  // of all steps but the last
    EXPECT_EQ(rows[0].code_bytes, 0x20U + 0x10U);
    EXPECT_EQ(rows[1].status, static_cast<glsum::Status>(5));
    EXPECT_EQ(rows[1].first, qemu::CallCounts{});
    EXPECT_EQ(rows[2].first.instructions, 31U);
    EXPECT_DOUBLE_EQ(rows[2].instructions, (1.0 * 40.0 + 31.0 * 48.0) / 32.0);
    EXPECT_EQ(rows[2].worst_instructions, 48U);
    EXPECT_EQ(rows[2].code_bytes, 0x30U);
    EXPECT_EQ(text_of(folder_.file("watch")), "1088\n1024\n");
    EXPECT_EQ(text_of(folder_.file("plugin")).find("timing="), std::string::npos);
}

// What the program is told: each number to the last bit, each table and input once.
TEST_F(MeasureModel, ThePlanHoldsTheDesigns) {
    (void)step();
    const std::string plan = text_of(folder_.file("plan"));
    const std::string half = "3fe0000000000000";
    const std::string one = "3ff0000000000000";
    const std::string first = "ring_plain_f32 0 0 7 100 0 3 " + half + " 3fd0000000000000 " + one + ' ' + one + ' ' +
                              one + " 1 4000000000000000 3 2 ";
    EXPECT_EQ(plan.find("glsum-model-2 "), 0U);
    const std::string behind = plan.substr(plan.find('\n') + 1);
    EXPECT_EQ(behind.substr(0, first.size()), first) << behind;
    const std::string last =
        "block_plain_q31 1 1 0 132 0 3 " + one + " 0000000000000000 4010000000000000 " + one + ' ' + one + " 0\n";
    EXPECT_TRUE(behind.ends_with('\n' + last)) << behind;
    const std::string numbers = text_of(folder_.file("numbers"));
    ASSERT_EQ(numbers.size(), 5 * sizeof(double));
    double read[5];
    std::memcpy(read, numbers.data(), sizeof read);
    EXPECT_EQ(std::vector<double>(read, read + 5), (std::vector<double>{1.0, -1.0, 0.5, 0.5, 0.25}));
}

TEST_F(MeasureModel, CyclesAreThoseOfEachRowsLog) {
    std::ofstream times(folder_.file("times"));
    std::string losses;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        losses += " 0";
    }
    for (const auto& [steps, first, cycles] : {std::tuple(100U, 100, 30), std::tuple(132U, 31, 40)}) {
        const firmware::TimedCalls timed = firmware::timed_steps(steps, false);
        std::size_t count = 0;
        for (std::size_t call = 0; call < steps; ++call) {
            count += timed.contains(call) ? 1 : 0;
        }
        times << "calls " << count << " 1024 " << first << " core 3 " << 2 * cycles << ' ' << cycles << ' '
              << 3 * cycles << losses << " 0\nunknown " << 500 + steps << " 9\nend\n";
    }
    times.close();
    timing::TimingRequest request;
    request.cores_folder = TEST_CORES;
    request.cores = {{"m7-ideal", "", ""}};
    const auto rows = step(request);
    ASSERT_EQ(rows[0].cores.size(), 1U);
    EXPECT_NEAR(rows[0].cores[0].cycles, 30.0, 1e-12);
    EXPECT_NEAR(rows[0].cores[0].low, 15.0, 1e-12);
    EXPECT_NEAR(rows[0].cores[0].high, 45.0, 1e-12);
    EXPECT_EQ(rows[0].unknown_encodings, std::vector<std::uint32_t>{600});
    EXPECT_TRUE(rows[1].cores.empty());
    EXPECT_NEAR(rows[2].cores.at(0).cycles, 40.0, 1e-12);
    EXPECT_EQ(text_of(folder_.file("marks")), "1536 1552 1568\n");
    EXPECT_NE(text_of(folder_.file("request")).find("core m7-ideal "), std::string::npos);
    request.cores = {{"no-core", "", ""}};
    std::filesystem::remove(folder_.file("plugin"));
    EXPECT_THROW((void)step(request), glsum::Failure);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("plugin")));
}

TEST_F(MeasureModel, OtherStepsThanWereMadeAreNotBelieved) {
    const auto fault = [&] { return test::refusal(glsum::Exit::check_failed, [&] { (void)step(); }); };
    log(steps_ + calls(ring, 1, "1 1 1 1") + reached);
    EXPECT_EQ(fault(), "the instrument saw more steps than the program made");
    log(calls(block, 1, "1 1 1 1") + steps_ + reached);
    EXPECT_EQ(fault(), "the instrument saw other steps than the program made");
    log(calls(ring, 100, "1 1 1 1") + reached);
    EXPECT_EQ(fault(), "the instrument saw other steps than the program made");
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)step({}, 99); }),
              "expected at least 100 steps to count");
    std::filesystem::remove(folder_.file("model.elf"));
    EXPECT_EQ(test::refusal(glsum::Exit::missing, [&] { (void)step(); }),
              folder_.file("model.elf").string() + ": not found; expected from the firmware's build");
}

// x_k = u_(k-3) / 2 - x_(k-1): a table of one tap, two whole steps of delay, the input repeated.
TEST(MeasureHere, AModelIsSteppedAsItsDesignSays) {
    const glsum::PastTable tables[] = {{1.0, {}}};
    const glsum::ModelDesign design{.increments = false, .delay = 2, .input = 0.5, .tables = tables};
    const qemu::SteppedModel stepped = qemu::step_model_here({"ring_plain_f32", &design, some_input, 6});
    ASSERT_EQ(stepped.status, glsum::Status::ok);
    EXPECT_EQ(stepped.output, (std::vector<double>{0.0, 0.0, 0.0, 0.5, -1.0, 1.25, -0.75}));
    EXPECT_EQ(stepped.saturations, 0U);
    firmware::OutputHash hash;
    for (const float output : {0.0F, 0.0F, 0.0F, 0.5F, -1.0F, 1.25F, -0.75F}) {
        hash.add(output);
    }
    EXPECT_EQ(stepped.hash, hash.value());
    EXPECT_THROW((void)qemu::step_model_here({"no_kernel", &design, some_input, 6}), std::out_of_range);
}

}  // namespace
