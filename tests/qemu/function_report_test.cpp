// What a function takes, from calls that are made up: spreads, bands, where it is hot, and how that is told.
#include "qemu/emulate/function_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/scratch.hpp"
#include "made_elf.hpp"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr auto load_use = timing::index(timing::Effect::load_use);

timing::TimedRun run_of(std::uint64_t calls, std::uint64_t instructions, std::vector<std::int64_t> half_cycles,
                        std::int64_t lost = 0, std::int64_t in_double = 0) {
    timing::TimedRun run{calls, {0x100, instructions, {{std::move(half_cycles), {}, in_double}}}};
    run.call.cores[0].losses[load_use] = lost;
    return run;
}

TEST(FunctionTime, CountsEachCallOfARun) {
    timing::TimingLog log;
    log.runs = {run_of(1, 10, {30, 28, 34}, 7, 4), run_of(2, 12, {20, 18, 26}, 3, 2),
                run_of(1, 11, {90, 80, 100}, 5, 6)};
    log.runs[0].call.stack_bytes = 24;
    log.runs[1].call.stack_bytes = 40;
    log.hot = {{{0x104, {10, timing::Effect::load_use, 4}}, {0x100, {10}}, {0x108, {40}}}};
    log.unknown = {{0x10c, 3}};
    log.recursive = true;
    const qemu::FunctionTime time = qemu::function_time(log);
    EXPECT_EQ(time.calls, 4U);
    EXPECT_EQ(time.instructions.min, 10);
    EXPECT_EQ(time.instructions.median, 11);  // of 10, 11, 12, 12 the lower in the middle
    EXPECT_EQ(time.instructions.max, 12);
    EXPECT_EQ(time.nominal.min, 20);
    EXPECT_EQ(time.nominal.median, 20);
    EXPECT_EQ(time.nominal.max, 90);
    EXPECT_EQ(time.low, 18);
    EXPECT_EQ(time.high, 26);
    EXPECT_EQ(time.lost[load_use].min, 3);
    EXPECT_EQ(time.lost[load_use].median, 3);
    EXPECT_EQ(time.lost[load_use].max, 7);
    EXPECT_EQ(time.in_double.min, 2);
    EXPECT_EQ(time.in_double.median, 2);
    EXPECT_EQ(time.in_double.max, 6);
    EXPECT_EQ(time.stack_bytes, 40U);
    // The costliest first, of equals the one that comes first.
    EXPECT_THAT(time.hot, ElementsAre(std::pair(0x108U, timing::HotSpot{40}), std::pair(0x100U, timing::HotSpot{10}),
                                      std::pair(0x104U, timing::HotSpot{10, timing::Effect::load_use, 4})));
    EXPECT_EQ(time.unknown.at(0x10c), 3U);
    EXPECT_TRUE(time.recursive);
}

TEST(FunctionTime, TheNominalSetIsWithinItsBand) {
    timing::TimingLog log;
    log.runs = {run_of(1, 10, {30, 40, 50})};
    EXPECT_EQ(qemu::function_time(log).low, 30);
    log.runs = {run_of(1, 10, {30})};
    EXPECT_EQ(qemu::function_time(log).high, 30);
    EXPECT_TRUE(qemu::function_time(log).hot.empty());
}

qemu::FunctionReport made_report() {
    timing::TimingLog log;
    log.runs = {run_of(2, 10, {31, 28, 34}, 7, 9)};
    log.unknown = {{0x10c, 3}};
    log.recursive = true;
    qemu::FunctionReport report;
    report.function = "step";
    report.core.name = "a-core";
    report.without = {"call_overhead", "load_use"};
    report.time = qemu::function_time(log);
    report.hot = {{0x104, "a_symbol_of_more_than_24_letters", "ldr r0, [r1]", 12.5, "load_use", 3.5}};
    return report;
}

TEST(FunctionReport, IsReadByPeople) {
    qemu::FunctionReport report = made_report();
    const std::string text = qemu::to_text(report);
    EXPECT_THAT(text, testing::StartsWith("step on a-core, code in itcm, data in dtcm: 2 calls\n\n"));
    EXPECT_THAT(text, HasSubstr("instructions               10           10           10\n"));
    EXPECT_THAT(text, HasSubstr("model cycles             15.5         15.5         15.5   band 14.0 to 17.0\n"));
    EXPECT_THAT(text, HasSubstr("load_use                              3.5\n"));
    EXPECT_THAT(text, HasSubstr("double_precision_in_software          4.5   (all cycles within its routines)\n"));
    EXPECT_THAT(text, HasSubstr("call_overhead                         0.0   (lies beside a call"));
    EXPECT_THAT(text, Not(HasSubstr("store_buffer")));  // nothing was lost to it
    EXPECT_THAT(text,
                HasSubstr("0x00000104           12.5  load_use           a_symbol_of_more_than_24 ldr r0, [r1]\n"));
    EXPECT_THAT(text, HasSubstr("unknown encoding at 0x0000010c, executed 3 times"));
    EXPECT_THAT(text, HasSubstr("step calls itself"));
    report.time.recursive = false;
    report.time.unknown.clear();
    report.time.in_double = {};
    EXPECT_THAT(qemu::to_text(report), testing::EndsWith("ldr r0, [r1]\n"));
    EXPECT_THAT(qemu::to_text(report), Not(HasSubstr("double_precision")));
}

TEST(FunctionReport, AsAFileHasEveryStall) {
    const auto json = nlohmann::json::parse(qemu::to_json(made_report(), "abc"));
    EXPECT_EQ(json["schema"], "glsum-time-1");
    EXPECT_EQ(json["elf_sha256"], "abc");
    EXPECT_EQ(json["function"], "step");
    EXPECT_EQ(json["core"], "a-core");
    EXPECT_EQ(json["placement"], nlohmann::json::parse(R"({"code": "itcm", "data": "dtcm"})"));
    EXPECT_EQ(json["calls"], 2);
    EXPECT_EQ(json["instructions"]["median"], 10);
    EXPECT_EQ(json["model_cycles"],
              nlohmann::json::parse(R"({"min": 15.5, "median": 15.5, "max": 15.5, "low": 14.0, "high": 17.0})"));
    EXPECT_EQ(json["stalls"].size(), timing::effect_count + 1);
    EXPECT_EQ(json["stalls"]["load_use"], 3.5);
    EXPECT_EQ(json["stalls"]["double_precision_in_software"], 4.5);
    EXPECT_EQ(json["hot"][0]["address"], "0x00000104");
    EXPECT_EQ(json["hot"][0]["cycles"], 12.5);
    EXPECT_EQ(json["hot"][0]["reason"], "load_use");
    EXPECT_EQ(json["hot"][0]["lost"], 3.5);
    EXPECT_EQ(json["unknown_encodings"], nlohmann::json::parse(R"([{"address": "0x0000010c", "executions": 3}])"));
}

TEST(FunctionReport, AsAFileHasEachRuleSet) {
    timing::TimingLog log;
    log.runs = {run_of(2, 10, {31, 28, 34}), run_of(1, 10, {33, 28, 34})};
    log.runs[0].call.cores[0].sets = {31, 29};
    log.runs[1].call.cores[0].sets = {33, 41};
    qemu::FunctionReport report{"step", {}, {}, qemu::function_time(log), {}};
    report.core.sets = {{"nominal", "", {}, true}, {"rival", "", {}, false}};
    const auto json = nlohmann::json::parse(qemu::to_json(report, "abc"));
    EXPECT_EQ(json["rule_sets"], nlohmann::json::parse(R"([
        {"name": "nominal", "fits": true, "min": 15.5, "median": 15.5, "max": 16.5},
        {"name": "rival", "fits": false, "min": 14.5, "median": 14.5, "max": 20.5}])"));
    // One function is an object, several are a list.
    EXPECT_EQ(nlohmann::json::parse(qemu::to_json(std::vector{report}, "abc")), json);
    EXPECT_EQ(nlohmann::json::parse(qemu::to_json(std::vector{report, report}, "abc")),
              (nlohmann::json::array({json, json})));
}

TEST(FunctionReport, ACallIsARow) {
    timing::TimingLog log;
    log.runs = {run_of(2, 10, {31, 28, 34}, 7, 9), run_of(1, 12, {40, 38, 44})};
    std::ostringstream text;
    qemu::write_calls_header(text);
    qemu::write_calls(text, "f(int, int)", log);
    std::istringstream lines(text.str());
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);) {
        rows.push_back(line);
    }
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_THAT(rows[0], testing::StartsWith("function,call,instructions,model_cycles,low,high,single_issue,"));
    EXPECT_THAT(rows[1], testing::StartsWith("\"f(int, int)\",1,10,15.5,14,17,"));
    EXPECT_THAT(rows[1], testing::EndsWith(",4.5"));
    EXPECT_THAT(rows[2], testing::StartsWith("\"f(int, int)\",2,10,15.5,14,17,"));
    EXPECT_THAT(rows[3], testing::StartsWith("\"f(int, int)\",3,12,20,19,22,"));
    for (const std::string& row : rows) {
        EXPECT_EQ(std::count(row.begin(), row.end(), ',') - (row[0] == '"' ? 1 : 0),
                  static_cast<std::ptrdiff_t>(timing::effect_count) + 6);
    }
}

TEST(FunctionReport, NamesTheFunctionThatAHotAddressIsIn) {
    const base::Scratch folder;
    test::MadeElf made{{{0x100, test::bytes_of({0xbf00bf00, 0xbf00bf00})}}, {{"leaf", 0x101, 8, true}}};
    made.write(folder.file("a.elf"));
    qemu::FunctionTime time;
    time.hot = {{0x104, {9, timing::Effect::unaligned_access, 5}},
                {0x100, {8}},
                {0x200, {7, timing::Effect::load_use, 1}}};  // half a cycle is a loss, too
    const auto hot = qemu::hot_instructions(time, qemu::Elf(folder.file("a.elf")), 2);
    ASSERT_EQ(hot.size(), 2U);
    EXPECT_EQ(hot[0].address, 0x104U);
    EXPECT_EQ(hot[0].symbol, "leaf");
    EXPECT_EQ(hot[0].cycles, 4.5);
    EXPECT_EQ(hot[0].reason, "unaligned_access");
    EXPECT_EQ(hot[0].lost, 2.5);
    EXPECT_EQ(hot[1].cycles, 4.0);
    EXPECT_EQ(hot[1].reason, "");
    const qemu::HotInstruction last = qemu::hot_instructions(time, qemu::Elf(folder.file("a.elf")), 9).back();
    EXPECT_EQ(last.symbol, "");
    EXPECT_EQ(last.reason, "load_use");
    EXPECT_EQ(last.lost, 0.5);
}

}  // namespace
