// Functions held against a baseline: every growth is worse, all that changed is told, and files are read as written.
#include "qemu/emulate/function_gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "made_elf.hpp"

namespace {

using testing::HasSubstr;

qemu::GatedProgram gated() {
    qemu::GatedFunction step;
    step.name = "step";
    step.calls = 5;
    step.instructions_median = 20;
    step.instructions_max = 22;
    step.cycles_median = 15.5;
    step.cycles_max = 18.0;
    step.low = 14.0;
    step.high = 17.0;
    step.code_bytes = 64;
    step.stack_bytes = 16;
    step.stalls = {{"load_use", 3.5}, {"single_issue", 1.0}};
    qemu::GatedFunction never;
    never.name = "never";
    never.code_bytes = 8;
    return {"abc", "a-core", "def", {never, step}};
}

std::vector<qemu::FunctionChange> after(const std::function<void(qemu::GatedProgram&)>& change) {
    qemu::GatedProgram now = gated();
    change(now);
    return qemu::changes(gated(), now);
}

TEST(FunctionGate, TheSameProgramHasNoChange) {
    EXPECT_TRUE(after([](auto&) {}).empty());
    EXPECT_TRUE(after([](auto& p) { p.elf_sha256 = "other"; }).empty());
}

TEST(FunctionGate, AnyGrowthIsWorseAndAnyFallPasses) {
    const std::function<void(qemu::GatedFunction&, int)> quantities[] = {
        [](auto& f, int by) { f.cycles_median += 0.5 * by; }, [](auto& f, int by) { f.cycles_max += 0.5 * by; },
        [](auto& f, int by) { f.instructions_median += by; }, [](auto& f, int by) { f.instructions_max += by; },
        [](auto& f, int by) { f.code_bytes += 2 * by; },      [](auto& f, int by) { f.stack_bytes += 4 * by; }};
    for (const auto& quantity : quantities) {
        for (const int by : {1, -1}) {
            const auto found = after([&](auto& p) { quantity(p.functions[1], by); });
            ASSERT_EQ(found.size(), 1U);
            EXPECT_EQ(found[0].name, "step");
            EXPECT_EQ(found[0].worse, by > 0) << found[0].text;
        }
    }
    // More of one thing is worse, however much less there is of another.
    EXPECT_TRUE(after([](auto& p) { p.functions[1].cycles_median = 1, p.functions[1].stack_bytes = 20; })[0].worse);
}

TEST(FunctionGate, SaysWhatCyclesWereLostToTheLargestFirst) {
    const auto found = after([](auto& p) {
        p.functions[1].cycles_median = 27.5;
        p.functions[1].stalls = {{"load_use", 15.5}, {"mac_latency", 1.0}};
    });
    EXPECT_EQ(found.at(0).text,
              "cycles 15.5 -> 27.5 (+12); lost to: load_use +12, mac_latency +1, single_issue -1; as many "
              "instructions: by where it lies, or what runs before it");
}

TEST(FunctionGate, FunctionsComeAndGo) {
    auto found = after([](auto& p) { p.functions.pop_back(); });
    EXPECT_TRUE(found.at(0).worse);
    EXPECT_THAT(found[0].text, HasSubstr("gone"));
    found = after([](auto& p) { p.functions[1].name = "other"; });
    ASSERT_EQ(found.size(), 2U);
    EXPECT_FALSE(found[0].worse);
    EXPECT_THAT(found[0].text, HasSubstr("new"));
    found = after([](auto& p) { p.functions[1].calls = 0; });
    EXPECT_TRUE(found.at(0).worse);
    EXPECT_EQ(found[0].text, "no longer called");
    found = after([](auto& p) { p.functions[0].calls = 2; });
    EXPECT_FALSE(found.at(0).worse);
    found = after([](auto& p) { p.functions[0].code_bytes = 10; });
    EXPECT_TRUE(found.at(0).worse);
    EXPECT_EQ(found[0].text, "code bytes 8 -> 10");
}

TEST(FunctionGate, AnotherCoreCannotBeCompared) {
    try {
        (void)after([](auto& p) { p.core_sha256 = "other"; });
        FAIL();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::not_comparable);
        EXPECT_THAT(failure.what(), HasSubstr("whose core file or placement is another"));
    }
}

TEST(FunctionGate, IsReadAsItWasWritten) {
    const std::string text = qemu::to_json(gated(), "why");
    EXPECT_THAT(text, HasSubstr("\"reason\": \"why\""));
    EXPECT_EQ(qemu::to_json(qemu::parse_gated_program(text, "file"), "why"), text);
    EXPECT_TRUE(qemu::changes(gated(), qemu::parse_gated_program(text, "file")).empty());
    for (const char* broken : {"", "[]", "{}", R"({"schema": "glsum-time-1"})", R"({"schema": "glsum-functions-1"})"}) {
        EXPECT_THROW((void)qemu::parse_gated_program(broken, "file"), glsum::Failure) << broken;
    }
}

TEST(FunctionGate, KeepsWhatTheCallsReached) {
    qemu::FunctionTime time;
    time.calls = 3;
    time.nominal = {20, 31, 40};
    time.instructions = {5, 6, 7};
    time.low = 28;
    time.high = 34;
    time.stack_bytes = 24;
    time.lost[timing::index(timing::Effect::load_use)].median = 5;
    time.in_double.median = 4;
    const base::Scratch folder;
    test::MadeElf made{{{0x100, std::vector<std::uint8_t>(64)}},
                       {{"step", 0x101, 12, true}, {"leaf", 0x111, 6, true}, {"apart", 0x121, 4, true}}};
    made.write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    time.hot = {{0x104, {9}}, {0x112, {8}}, {0x300, {7}}};
    const qemu::GatedFunction kept = qemu::gated_function(elf.function("step"), elf, time);
    EXPECT_EQ(kept.calls, 3U);
    EXPECT_EQ(kept.cycles_median, 15.5);
    EXPECT_EQ(kept.cycles_max, 20.0);
    EXPECT_EQ(kept.low, 14.0);
    EXPECT_EQ(kept.high, 17.0);
    EXPECT_EQ(kept.instructions_median, 6);
    EXPECT_EQ(kept.instructions_max, 7);
    EXPECT_EQ(kept.code_bytes, 18U);
    EXPECT_EQ(kept.stack_bytes, 24U);
    EXPECT_EQ(kept.stalls, (std::map<std::string, double>{{"double_precision_in_software", 2.0}, {"load_use", 2.5}}));
    // Of one that was never called nothing is known but its bytes, nor from a file.
    qemu::GatedProgram program = gated();
    program.functions = {qemu::gated_function(elf.function("step"), elf, std::nullopt)};
    for (const qemu::GatedFunction& uncalled :
         {program.functions[0], qemu::parse_gated_program(qemu::to_json(program, "why"), "file").functions.at(0)}) {
        EXPECT_EQ(uncalled.code_bytes, 12U);
        EXPECT_EQ(uncalled.calls, 0U);
        EXPECT_EQ(uncalled.instructions_median, 0);
        EXPECT_EQ(uncalled.instructions_max, 0);
        EXPECT_EQ(uncalled.cycles_median, 0.0);
        EXPECT_EQ(uncalled.cycles_max, 0.0);
        EXPECT_EQ(uncalled.low, 0.0);
        EXPECT_EQ(uncalled.high, 0.0);
        EXPECT_EQ(uncalled.stack_bytes, 0U);
        EXPECT_TRUE(uncalled.stalls.empty());
    }
    EXPECT_EQ(elf.functions_like({"*e*"}).size(), 2U);
    EXPECT_THROW((void)elf.functions_like({"none*"}), glsum::Failure);
}

}  // namespace
