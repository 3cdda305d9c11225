// What a core file may hold, to its ends; and that all that is asked of the emulator's timing arrives there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/timing_log.hpp"

namespace {

const std::filesystem::path cores(TEST_CORES);

// What is said of a file that changes the F746 by this.
std::string said_of(const std::string& text) {
    const base::Scratch scratch;
    std::ofstream(scratch.file("mine.toml")) << "base = \"stm32f746-itcm\"\n" + text;
    try {
        (void)timing::read_core_file(scratch.file("mine.toml"), cores);
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "read";
}

std::string row(const std::string& section, const std::string& name, const std::string& value) {
    return "[" + section + "]\n" + name + " = { value = " + value + ", mark = \"assumed\", source = \"a test\" }\n";
}

TEST(CoreLimits, FiguresAreZeroToATrillion) {
    EXPECT_EQ(said_of(row("rows.branch", "target_entries", "0")), "read");
    EXPECT_EQ(said_of(row("rows.memory", "clock_hz", "1000000000000")), "read");
    for (const char* beyond : {"-1", "1000000000001"}) {
        EXPECT_NE(said_of(row("rows.memory", "clock_hz", beyond)).find("mine.toml:3: memory.clock_hz: expected"),
                  std::string::npos)
            << beyond;
    }
}

// Of what is counted in bytes, and of nothing else.
TEST(CoreLimits, WidthsArePowersOfTwo) {
    for (const auto& [section, name] :
         {std::pair("rows.cache", "data_bytes"), std::pair("rows.cache", "instruction_bytes"),
          std::pair("rows.cache", "line_bytes"), std::pair("rows.fetch", "bytes")}) {
        EXPECT_EQ(said_of(row(section, name, "64")), "read") << name;
        EXPECT_NE(said_of(row(section, name, "48")).find("expected a power of two, found 48"), std::string::npos)
            << name;
    }
    EXPECT_EQ(said_of(row("rows.memory", "clock_hz", "48")), "read");
}

TEST(CoreLimits, RivalsLeaveTheChipAsItIs) {
    const auto rival = [](const std::string& section, const std::string& name) {
        return said_of("[set.other]\nnote = \"a test\"\n" + row("set.other." + section, name, "1"));
    };
    for (const auto& [section, name] :
         {std::pair("cache", "data_ways"), std::pair("memory", "clock_hz"), std::pair("measurement", "counter_reads"),
          std::pair("fetch", "bytes"), std::pair("branch", "target_entries"), std::pair("branch", "return_entries")}) {
        EXPECT_NE(rival(section, name).find("no row that a rival set may change"), std::string::npos)
            << section << name;
    }
    EXPECT_EQ(rival("issue", "two_loads_pair"), "read");
    EXPECT_EQ(rival("issue", "if_then_pairs"), "read");
    EXPECT_NE(said_of("[set.other]\nfits = true\n").find("expected note"), std::string::npos);
    EXPECT_NE(said_of("set = 3\n").find("mine.toml:2: expected [set.NAME]"), std::string::npos);
    EXPECT_NE(said_of("[set]\nother = 3\n").find("mine.toml:3: expected [set.NAME]"), std::string::npos);
}

// Whether a rival's rows meet what was measured is its own to say; without a word they do.
TEST(CoreLimits, RivalsAreReadWithTheirRows) {
    const base::Scratch scratch;
    std::ofstream(scratch.file("mine.toml"))
        << "base = \"stm32f746-itcm\"\n[set.a]\nnote = \"one\"\n[set.a.issue]\n"
           "two_loads_pair = { value = 5, mark = \"assumed\", source = \"a test\" }\n"
           "[set.b]\nnote = \"two\"\nfits = false\n";
    const timing::CoreFile core = timing::read_core_file(scratch.file("mine.toml"), cores);
    const timing::CoreFile base = timing::read_core(cores, "stm32f746-itcm");
    ASSERT_EQ(core.sets.size(), base.sets.size() + 2);
    const auto set = [&](const std::string& name) {
        return *std::find_if(core.sets.begin(), core.sets.end(), [&](const auto& one) { return one.name == name; });
    };
    EXPECT_TRUE(core.sets[0].fits);
    EXPECT_TRUE(set("a").fits);
    EXPECT_FALSE(set("b").fits);
    EXPECT_EQ(set("a").note, "one");
    EXPECT_EQ(set("a").figures.issue_two_loads_pair, 5);
    EXPECT_EQ(set("b").figures.issue_two_loads_pair, base.sets[0].figures.issue_two_loads_pair);
    // With the nominal one, at most eight.
    const auto with = [&](std::size_t more) {
        std::string text;
        for (std::size_t i = 0; i < more; ++i) {
            text += "[set.more" + std::to_string(i) + "]\nnote = \"a test\"\n";
        }
        return said_of(text);
    };
    EXPECT_EQ(timing::CoreFile::most_sets, 8U);
    EXPECT_EQ(with(8 - base.sets.size()), "read");
    EXPECT_NE(with(9 - base.sets.size()).find("expected at most 7 rival sets, found 8"), std::string::npos);
}

TEST(CoreLimits, AFileIsAtMostAMebibyteAndMeansWhatItSays) {
    const base::Scratch scratch;
    const std::string head = "base = \"stm32f746-itcm\"\n#";
    const auto read_with = [&](std::size_t bytes) {
        std::ofstream(scratch.file("mine.toml")) << head << std::string(bytes - head.size(), '.');
        return timing::read_core_file(scratch.file("mine.toml"), cores).text.size();
    };
    EXPECT_GT(read_with(1U << 20), 1U << 20);  // with those that it is based on
    EXPECT_THROW((void)read_with((1U << 20) + 1), glsum::Failure);
    EXPECT_NE(said_of("rows = 3\n").find("expected [rows.SECTION]"), std::string::npos);
    EXPECT_NE(said_of("[rows]\nissue = 3\n").find("expected a section of rows, found issue"), std::string::npos);
    EXPECT_NE(said_of("[rows.issue]\ntwo_loads_pair = 1\n").find("issue.two_loads_pair: expected { value = N"),
              std::string::npos);
    EXPECT_NE(said_of("placement = 3\n").find("expected placement = {"), std::string::npos);
    EXPECT_NE(said_of("effects_off = 3\n").find("expected effects_off = ["), std::string::npos);
    EXPECT_NE(said_of("note = \"\"\n").find("expected note = \"...\""), std::string::npos);
    for (const char* word : {"value", "mark", "source"}) {
        std::string text = row("rows.issue", "two_loads_pair", "1");
        text.replace(text.find(std::string(word) + " ="), std::string(word).size(), "other");
        EXPECT_NE(said_of(text).find("expected value, mark and source, found other"), std::string::npos) << word;
    }
    for (const timing::Mark mark :
         {timing::Mark::measured, timing::Mark::documented, timing::Mark::fitted, timing::Mark::assumed}) {
        std::string text = row("rows.issue", "two_loads_pair", "1");
        text.replace(text.find("assumed"), 7, name_of(mark));
        EXPECT_EQ(said_of(text), "read") << name_of(mark);
    }
    EXPECT_EQ(timing::mechanism_names(),
              (std::vector<std::string>{"history_predictor", "random_replacement", "serial_fpu"}));
    std::ofstream(scratch.file("other.toml")) << "base = \"stm32f746-itcm\"\nmechanisms = [\"random_replacement\"]\n";
    const auto mechanisms = timing::read_core_file(scratch.file("other.toml"), cores).sets[0].figures.mechanisms;
    EXPECT_FALSE(mechanisms.history_predictor || mechanisms.serial_fpu);
    EXPECT_TRUE(mechanisms.random_replacement);
}

TEST(TimingRequest, ArrivesWithAllThatItSays) {
    timing::TimingRequest request;
    request.cores_folder = "/a folder/cores";
    request.double_routines = {{16, 32}};
    request.unwinding.restorers = {{64, 80}, {96, 100}};
    request.unwinding.functions = {{16, 1}, {64, 2}};
    request.handlers = {4, 8};
    request.fault_handlers = {8};
    request.stretches = {12, 20};
    request.cores = {
        {"one", "", "axi", false, "chain", {"load_use", "single_issue"}, {{1, 2, timing::Place::axi}}, "/a b"}};
    std::stringstream text;
    timing::write_timing_request(text, request);
    const timing::TimingRequest read = timing::read_timing_request(text);
    EXPECT_EQ(read.cores_folder, request.cores_folder);
    ASSERT_EQ(read.double_routines.size(), 1U);
    ASSERT_EQ(read.unwinding.restorers.size(), 2U);
    EXPECT_EQ(read.unwinding.restorers[1].begin, 96U);
    EXPECT_EQ(read.unwinding.restorers[1].end, 100U);
    EXPECT_EQ(read.unwinding.functions, request.unwinding.functions);
    EXPECT_EQ(read.handlers, request.handlers);
    EXPECT_EQ(read.fault_handlers, request.fault_handlers);
    EXPECT_EQ(read.stretches, request.stretches);
    ASSERT_EQ(read.cores.size(), 1U);
    EXPECT_EQ(read.cores[0].name, "one");
    EXPECT_EQ(read.cores[0].code, "");
    EXPECT_EQ(read.cores[0].data, "axi");
    EXPECT_FALSE(read.cores[0].instruction_cache);
    EXPECT_EQ(read.cores[0].set, "chain");
    EXPECT_EQ(read.cores[0].without, request.cores[0].without);
    ASSERT_EQ(read.cores[0].ranges.size(), 1U);
    EXPECT_EQ(read.cores[0].file, "/a b");
    EXPECT_TRUE(timing::TimingRequest::Core{}.instruction_cache);
    // A core that is asked for by its file has the file's name.
    EXPECT_EQ(timing::core_asked_for("m7-ideal").name, "m7-ideal");
    EXPECT_EQ(timing::core_asked_for("m7-ideal").file, "");
    EXPECT_EQ(timing::core_asked_for("a/mine.toml").name, "mine");
    EXPECT_EQ(timing::core_asked_for("a/mine.toml").file, (std::filesystem::current_path() / "a/mine.toml").string());
}

// A call whose stack is known says so, one after another; and each core's rule sets follow it.
TEST(TimingLog, SaysStacksAndRuleSets) {
    timing::CoreTime core;
    core.half_cycles = {8, 6, 9};
    core.sets = {8, 6};
    timing::TimedCall call{0x100, 7, {core}};
    call.stack_bytes = 24;
    std::stringstream text;
    timing::TimingLogWriter writer(text);
    writer.add(call);
    writer.add(call);
    call.stack_bytes = 32;
    writer.add(call);
    call.cores[0].sets = {8, 7};
    writer.add(call);
    writer.finish(timing::CallTimer({}, {}, [](const timing::TimedCall&) {}));
    const timing::TimingLog log = timing::read_timing_log(text);
    ASSERT_EQ(log.runs.size(), 3U);
    EXPECT_EQ(log.runs[0].calls, 2U);
    EXPECT_EQ(log.runs[0].call.stack_bytes, 24U);
    EXPECT_EQ(log.runs[1].call.stack_bytes, 32U);
    EXPECT_EQ(log.runs[1].call.cores[0].sets, (std::vector<std::int64_t>{8, 6}));
    EXPECT_EQ(log.runs[2].call.cores[0].sets, (std::vector<std::int64_t>{8, 7}));
    // A damaged line does not fill the memory: of a thousand numbers at most.
    std::string many = "calls 1 256 7 core 1001";
    for (int i = 0; i < 2000; ++i) {
        many += " 1";
    }
    std::istringstream damaged(many + "\nend\n");
    EXPECT_THROW((void)timing::read_timing_log(damaged), std::runtime_error);
}

}  // namespace
