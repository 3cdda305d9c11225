// What is predicted for measured calls of any program's functions: one run for each function, on every core that rows
// and variants ask for, and each row's share of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "base/failure.hpp"
#include "qemu/emulate/predicted_calls.hpp"
#include "tests/qemu/made_emulator.hpp"
#include "tests/qemu/made_program.hpp"

namespace {

using testing::HasSubstr;

// Of the function at E two calls of E instructions. On core c they take 1000 + 100 c half cycles, 20 less and 40 more,
// of which c + 1 were lost to the first effect and 8 to the last.
constexpr const char* answer_each_function = R"sh(
entry=$(cat "$(of watch)")
echo "$entry" >>runs
cp "$(of timing)" "request$entry"
cores=$(grep -c '^core ' "$(of timing)")
awk -v cores="$cores" -v effects="$EFFECTS" -v entry="$entry" 'BEGIN {
    printf "calls 2 %d %d", entry, entry
    for (c = 0; c < cores; ++c) {
        printf " core 3 %d %d %d %d", 1000 + 100 * c, 980 + 100 * c, 1040 + 100 * c, c + 1
        for (e = 2; e < effects; ++e) printf " 0"
        printf " 8 0"
    }
    print "\nend"
}' >"$(of times)"
)sh";

class PredictCalls : public testing::Test {
protected:
    void SetUp() override {
        test::MadeElf made = test::program();
        made.sections.push_back({0, test::bytes_of({0x20001000, test::ring + 1})});  // what starts it
        made.write(folder_.file("a.elf"));
        setenv("EFFECTS", std::to_string(timing::effect_count).c_str(), 1);
        emulator_ = test::made_emulator(folder_, answer_each_function);
    }
    void TearDown() override { unsetenv("EFFECTS"); }
    [[nodiscard]] std::string text_of(const char* name) const {
        std::ifstream in(folder_.file(name));
        return {std::istreambuf_iterator<char>(in), {}};
    }
    [[nodiscard]] qemu::MeasuredCall row(const char* function, const char* code, const char* data, double per,
                                         unsigned line, const char* core = "stm32f746-itcm") const {
        return {folder_.file("a.elf"), function, core, code, data, 100.0, per, line};
    }
    std::vector<std::vector<qemu::PredictedCall>> predict(const std::vector<qemu::MeasuredCall>& rows,
                                                          const std::vector<qemu::CoreVariant>& variants = {{}}) {
        return qemu::predict_calls({[&](const base::Machine&) { return emulator_; }, "x.so", TEST_CORES}, rows, "m.csv",
                                   variants, 1);
    }
    std::string fault(const std::vector<qemu::MeasuredCall>& rows) {
        try {
            (void)predict(rows);
        } catch (const glsum::Failure& failure) {
            return failure.what();
        }
        return "none";
    }

    base::Scratch folder_;
    qemu::Emulator emulator_;
};

TEST_F(PredictCalls, AFunctionRunsOnceOnAllThatIsAskedOfIt) {
    const auto predicted =
        predict({row("step_of_ring", "itcm", "dtcm", 1.0, 3), row("step_of_block", "", "", 4.0, 4),
                 row("step_of_ring", "flash", "dtcm", 2.0, 5), row("step_of_ring", "flash", "axi", 1.0, 6),
                 row("step_of_ring", "itcm", "dtcm", 8.0, 7)},
                {{}, {"", "published", {}}, {"", "published", {"load_use"}}, {"m7-ideal"}});
    EXPECT_EQ(text_of("runs"), "1024\n1088\n");
    std::string asked;
    for (const char* place : {"itcm dtcm", "flash dtcm", "flash axi"}) {
        for (const char* core : {"stm32f746-itcm % 1 -", "stm32f746-itcm % 1 published",
                                 "stm32f746-itcm % 1 published load_use", "m7-ideal % 1 -"}) {
            const std::string text = core;
            asked += "core " + text.substr(0, text.find('%')) + place + text.substr(text.find('%') + 1) + "\n";
        }
    }
    EXPECT_THAT(text_of("request1024"), testing::EndsWith("\n" + asked));
    EXPECT_THAT(text_of("request1024"), HasSubstr("folder " + std::string(TEST_CORES) + "\n"));
    EXPECT_THAT(text_of("request1088"),
                testing::EndsWith("\ncore stm32f746-itcm - - 1 -\ncore stm32f746-itcm - - 1 published\n"
                                  "core stm32f746-itcm - - 1 published load_use\ncore m7-ideal - - 1 -\n"));
    // By variant and row: the core it asked for, and its share of a call.
    const int cores[4][5] = {{0, 0, 4, 8, 0}, {1, 1, 5, 9, 1}, {2, 2, 6, 10, 2}, {3, 3, 7, 11, 3}};
    const double per[] = {1.0, 4.0, 2.0, 1.0, 8.0};
    ASSERT_EQ(predicted.size(), 4U);
    for (std::size_t v = 0; v < 4; ++v) {
        ASSERT_EQ(predicted[v].size(), 5U);
        for (std::size_t i = 0; i < 5; ++i) {
            const qemu::PredictedCall& call = predicted[v][i];
            const double half_cycles = 1000.0 + 100.0 * cores[v][i];
            EXPECT_EQ(call.cycles, half_cycles / 2.0 / per[i]) << v << i;
            EXPECT_EQ(call.low, (half_cycles - 20.0) / 2.0 / per[i]) << v << i;
            EXPECT_EQ(call.high, (half_cycles + 40.0) / 2.0 / per[i]) << v << i;
            EXPECT_EQ(call.instructions, (i == 1 ? 1088.0 : 1024.0) / per[i]) << v << i;
            EXPECT_EQ(call.lost.front(), (cores[v][i] + 1.0) / 2.0 / per[i]) << v << i;
            EXPECT_EQ(call.lost.back(), 4.0 / per[i]) << v << i;
        }
    }
}

// Before anything runs; and what goes wrong while it runs, by the first row that asked for it.
TEST_F(PredictCalls, WhatGoesWrongNamesItsRow) {
    const qemu::MeasuredCall good = row("step_of_ring", "itcm", "dtcm", 1.0, 3);
    EXPECT_THAT(fault({good, row("no_such_step", "itcm", "dtcm", 1.0, 7)}), testing::StartsWith("m.csv:7: "));
    EXPECT_THAT(fault({good, row("step_of_ring", "itcm", "dtcm", 1.0, 8, "no-such-core")}),
                testing::StartsWith("m.csv:8: "));
    EXPECT_THAT(fault({good, row("step_of_ring", "moon", "dtcm", 1.0, 9)}), testing::StartsWith("m.csv:9: "));
    EXPECT_EQ(text_of("runs"), "");
    emulator_ = test::made_emulator(folder_, "exit 7\n");
    EXPECT_THAT(fault({good, row("step_of_ring", "", "", 1.0, 10)}), testing::StartsWith("m.csv:3: "));
}

}  // namespace
