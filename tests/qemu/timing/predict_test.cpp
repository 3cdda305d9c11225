// What is predicted for measured rows, from a program and timing logs made by hand: which cores are asked for, which of
// their figures belong to which row, and what is added beside the call.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "base/failure.hpp"
#include "qemu/emulate/silicon.hpp"
#include "tests/qemu/made_emulator.hpp"
#include "tests/qemu/made_program.hpp"

namespace {

using testing::HasSubstr;

constexpr const char* keep_what_was_told =
    "for last; do :; done; cp \"$last\" plan; awk 'END {print NR}' plan >>runs\n"
    "cp \"$(of watch)\" watch; cp \"$(of timing)\" request; cp \"$(of marks)\" marks\n";
// Of the row of the plan with t taps 11 calls, and a last one that is another: of t instructions, on core c of
// nominally 100 t + c half cycles, 2 less and 4 more, of which c were lost to the first effect.
constexpr const char* answer_each_row = R"sh(
cores=$(grep -c '^core ' request)
awk -v cores="$cores" -v effects="$EFFECTS" -v last="${LAST:-1}" '
    function one(calls, t, c, e) {
        printf "calls %d 1024 %d", calls, t
        for (c = 0; c < cores; ++c) {
            printf " core 3 %d %d %d %d", 100 * t + c, 100 * t + c - 2, 100 * t + c + 4, c
            for (e = 1; e < effects; ++e) printf " 0"
            printf " 0"
        }
        print ""
    }
    { one(11, 9999); one(last, $2); print "end" }' plan >"$(of times)"
)sh";

class Predict : public testing::Test {
protected:
    void SetUp() override {
        test::MadeElf made = test::program();
        made.symbols.push_back({"glsum_silicon_shift_fir_q31", 0x701, 0x10, true});
        made.write(folder_.file("a.elf"));
        setenv("EFFECTS", std::to_string(timing::effect_count).c_str(), 1);
        answers("");
    }
    void TearDown() override { unsetenv("EFFECTS"); }
    void answers(const std::string& behind) {
        emulator_ = test::made_emulator(folder_, keep_what_was_told + std::string(answer_each_row) + behind);
    }
    [[nodiscard]] std::string text_of(const char* name) const {
        std::ifstream in(folder_.file(name));
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::vector<std::vector<qemu::PredictedCycles>> predict(const std::vector<qemu::MeasuredCycles>& rows,
                                                            const std::vector<qemu::CoreVariant>& variants = {
                                                                {"stm32f746-itcm"}}) {
        return qemu::predict({folder_.file("a.elf"), "x.so", TEST_CORES, emulator_}, "m.csv", rows, variants);
    }
    std::string fault(glsum::Exit status, const std::vector<qemu::MeasuredCycles>& rows) {
        try {
            (void)predict(rows);
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), status) << failure.what();
            return failure.what();
        }
        return "none";
    }

    base::Scratch folder_;
    qemu::Emulator emulator_;
};

TEST_F(Predict, EachPlacementIsACoreAndEachKernelAndLengthIsRunOnce) {
    const auto predicted =
        predict({{"ring_plain_f32", "itcm", "dtcm", false, 30, 1.0, 2},
                 {"ring_plain_f32", "flash_cached", "axi", true, 30, 1.0, 3},
                 {"shift_fir_q31", "flash", "dtcm", false, 5, 1.0, 4},
                 {"ring_plain_f32", "itcm", "dtcm", true, 30, 1.0, 5}},
                {{"stm32f746-itcm"}, {"stm32f746-itcm", "published", {"call_overhead", "load_use"}}});
    EXPECT_EQ(text_of("plan"), "ring_plain_f32 30\nshift_fir_q31 5");
    EXPECT_EQ(text_of("watch"), "1024\n1792\n");
    EXPECT_EQ(text_of("marks"), "1536 1552 1568\n");
    // Without its cache code in flash is what the row says, not what the core file does.
    EXPECT_THAT(text_of("request"),
                testing::EndsWith("core stm32f746-itcm itcm dtcm 1 -\n"
                                  "core stm32f746-itcm flash axi 1 -\n"
                                  "core stm32f746-itcm flash dtcm 0 -\n"
                                  "core stm32f746-itcm itcm dtcm 1 published call_overhead load_use\n"
                                  "core stm32f746-itcm flash axi 1 published call_overhead load_use\n"
                                  "core stm32f746-itcm flash dtcm 0 published call_overhead "
                                  "load_use\n"));
    ASSERT_EQ(predicted.size(), 2U);
    // The last call's; beside it the core file has 11 cycles for reading the counter and 95 for maintenance.
    const int cores[2][4] = {{0, 1, 2, 0}, {3, 4, 5, 3}};
    const double beside[2][4] = {{11, 106, 11, 106}, {0, 95, 0, 95}};
    for (int v = 0; v < 2; ++v) {
        ASSERT_EQ(predicted[v].size(), 4U);
        for (int i = 0; i < 4; ++i) {
            const qemu::PredictedCycles& one = predicted[v][i];
            const int taps = i == 2 ? 5 : 30;
            EXPECT_EQ(one.instructions, static_cast<std::uint64_t>(taps));
            EXPECT_EQ(one.beside, beside[v][i]) << v << i;
            EXPECT_EQ(one.nominal, 50.0 * taps + 0.5 * cores[v][i] + beside[v][i]) << v << i;
            EXPECT_EQ(one.low, one.nominal - 1.0);
            EXPECT_EQ(one.high, one.nominal + 2.0);
            EXPECT_EQ(one.half_cycles[0], cores[v][i]);
        }
    }
}

// The firmware reads at most 16 KB of a plan: 400 rows.
TEST_F(Predict, ALongPlanIsRunInParts) {
    std::vector<qemu::MeasuredCycles> rows;
    for (std::uint32_t taps = 1; taps <= 401; ++taps) {
        rows.push_back({"ring_plain_f32", "itcm", "dtcm", false, taps, 1.0, taps + 1});
    }
    const auto predicted = predict(rows);
    EXPECT_EQ(text_of("runs"), "400\n1\n");
    ASSERT_EQ(predicted.at(0).size(), 401U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(predicted[0][i].instructions, i + 1);
    }
}

TEST_F(Predict, WhatTheProgramCannotRunIsNamedWithItsLine) {
    const auto said = [&](const char* kernel, std::uint32_t taps) {
        return fault(glsum::Exit::bad_input, {{"ring_plain_f32", "itcm", "dtcm", false, 1, 1.0, 2},
                                              {kernel, "itcm", "dtcm", false, taps, 1.0, 7}});
    };
    EXPECT_THAT(said("no_kernel", 1), testing::StartsWith("m.csv:7: kernel: expected one of the registry's"));
    EXPECT_EQ(said("ring_plain_f32", 1025), "m.csv:7: taps: ring_plain_f32 takes 1 to 1024, found 1025");
    EXPECT_EQ(said("shift_fir_q31", 129), "m.csv:7: taps: shift_fir_q31 takes 1 to 128, found 129");
    EXPECT_EQ(predict({{"ring_plain_f32", "itcm", "dtcm", false, 1024, 1.0, 2},
                       {"shift_fir_q31", "itcm", "dtcm", false, 128, 1.0, 3}})[0]
                  .size(),
              2U);
}

TEST_F(Predict, OtherCallsThanWereAskedForAreNotBelieved) {
    const std::vector<qemu::MeasuredCycles> rows{{"shift_fir_q31", "itcm", "dtcm", false, 5, 1.0, 2},
                                                 {"ring_plain_f32", "itcm", "dtcm", false, 30, 1.0, 3}};
    setenv("LAST", "2", 1);
    EXPECT_THAT(fault(glsum::Exit::check_failed, rows), HasSubstr("13 calls of shift_fir_q31 were seen, 12 expected"));
    unsetenv("LAST");
    answers("sed -i '0,/^end$/s//unknown 260 3\\nend/' \"$(of times)\"\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed, rows), HasSubstr("does not know the encoding at 0x00000104"));
    answers("sed -i '/^end$/q' \"$(of times)\"\n");
    EXPECT_THAT(fault(glsum::Exit::check_failed, rows), HasSubstr("1 rows were seen, 2 expected"));
}

TEST(SiliconLine, IsTheOneOfLeastSquares) {
    const qemu::FittedLine line = qemu::fit_line({1, 2, 3, 4}, {6, 5, 7, 10});
    EXPECT_NEAR(line.slope, 1.4, 1e-12);
    EXPECT_NEAR(line.constant, 3.5, 1e-12);
    EXPECT_EQ(qemu::fit_line({5, 5}, {40, 60}).slope, 0.0);  // of one length there is only a mean
    EXPECT_EQ(qemu::fit_line({5, 5}, {40, 60}).constant, 50.0);
}

}  // namespace
