// Choices for two machines beside each other: what was chosen for one is shown on the other, at each one's clock.
#include "bench/choose/side_by_side.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/choose/report.hpp"
#include "tests/choose/pretend_board.hpp"

namespace {

using choose::Answer;
using choose::OnMachine;

class SideBySide : public testing::Test {
protected:
    void SetUp() override {
        const char* const cores[] = {"stm32f746-itcm", "stm32h747-m4"};  // 216 and 200 MHz
        for (std::size_t i = 0; i < 2; ++i) {
            Answer answer;
            answer.question.conditions = {0.5, 2e-6, {"step"}, 60, 2020};
            answer.question.target = i == 0 ? choose::Target::m7 : choose::Target::m4;
            answer.question.core = cores[i];
            answers_.push_back(answer);
        }
        for (const std::size_t taps : {3U, 5U}) {
            m7_.knows(taps);
            m4_.knows(taps);
        }
    }
    void choose(std::size_t machine, std::size_t taps) {
        answers_[machine].choice.chosen = choose::Candidate{"ring_plain_f32", taps, {0.01, "step", ""}, {}};
    }
    std::vector<OnMachine> rows() { return choose::side_by_side(answers_, {m7_.board(), m4_.board()}); }

    test::PretendBoard m7_{0.5, 60, 2020, 20, 24, base::machines[0]};
    test::PretendBoard m4_{0.5, 60, 2020, 50, 60, base::machines[1]};
    std::vector<Answer> answers_;
};

TEST_F(SideBySide, EachChoiceIsMeasuredOnEachMachine) {
    choose(0, 5);
    choose(1, 3);
    const std::vector<OnMachine> found = rows();
    ASSERT_EQ(found.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const OnMachine& row = found[i];
        const bool m4 = i >= 2;
        EXPECT_EQ(row.machine, &base::machines[m4 ? 1 : 0]);
        EXPECT_EQ(row.core, m4 ? "stm32h747-m4" : "stm32f746-itcm");
        EXPECT_EQ(row.clock_hz, m4 ? 200e6 : 216e6);
        EXPECT_EQ(row.kernel, "ring_plain_f32");
        EXPECT_EQ(row.taps, i % 2 == 0 ? 5U : 3U);
        EXPECT_EQ(row.length, i % 2 == 0 ? "5" : "3");
        const auto taps = static_cast<double>(row.taps);
        EXPECT_EQ(row.cost.fault, "");
        EXPECT_DOUBLE_EQ(row.cost.value, (m4 ? 50.0 : 20.0) * taps);
        EXPECT_DOUBLE_EQ(row.cost.limited, (m4 ? 60.0 : 24.0) * taps);
        EXPECT_EQ(row.cost.bytes, 12.0 * taps);
        EXPECT_EQ(row.chosen, i == 0 || i == 3);
    }
    // 250 cycles at 200 MHz; of the 2 us between samples what the upper end of the band takes: 300 cycles are 1.5 us.
    EXPECT_DOUBLE_EQ(found[2].microseconds(), 1.25);
    EXPECT_DOUBLE_EQ(found[2].share(2e-6), 0.75);
    const bench::Json json = to_json(found, answers_);
    EXPECT_EQ(json.at("schema"), "glsum-choices-1");
    ASSERT_EQ(json.at("choices").size(), 2U);
    EXPECT_EQ(json.at("choices")[1], to_json(answers_[1]));
    ASSERT_EQ(json.at("side_by_side").size(), 4U);
    const bench::Json& row = json.at("side_by_side")[2];
    EXPECT_EQ(row.at("microseconds"), found[2].microseconds());
    EXPECT_EQ(row.at("share"), found[2].share(2e-6));
    bench::Json plain = row;
    plain.erase("microseconds");
    plain.erase("share");
    plain["model_cycles_per_sample"] = std::round(row.at("model_cycles_per_sample").get<double>());
    plain["model_cycles_high"] = std::round(row.at("model_cycles_high").get<double>());
    EXPECT_EQ(plain, bench::Json::parse(R"({"target": "m4", "core": "stm32h747-m4", "clock_hz": 200000000.0,
        "kernel": "ring_plain_f32", "taps": "5", "model_cycles_per_sample": 250.0, "model_cycles_high": 300.0,
        "bytes": 60.0, "chosen": false})"));
    const std::string table = to_table(found, answers_);
    EXPECT_NE(table.find("\n  Cortex-M4  stm32h747-m4         ring_plain_f32                   5      250.0      300.0"
                         "       1.25       60   75.00%\n"
                         "  Cortex-M4  stm32h747-m4         ring_plain_f32                   3      150.0      180.0"
                         "       0.75       36   45.00%  chosen\n"),
              std::string::npos)
        << table;
    EXPECT_NE(table.find("as a share of the 2e-06 s\n"), std::string::npos) << table;
}

TEST_F(SideBySide, WhatBothChoseIsOneLineOfEach) {
    choose(0, 3);
    choose(1, 3);
    const std::vector<OnMachine> found = rows();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(found[0].chosen);
    EXPECT_TRUE(found[1].chosen);
    EXPECT_EQ(found[1].machine, &base::machines[1]);
}

TEST_F(SideBySide, AMachineForWhichNothingFitsSaysHowNear) {
    choose(0, 3);
    const std::vector<OnMachine> found = rows();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(found[0].chosen);
    EXPECT_FALSE(found[1].chosen);
    EXPECT_DOUBLE_EQ(found[1].cost.value, 150.0);
    const std::string table = to_table(found, answers_);
    EXPECT_NE(table.find("\n  Cortex-M4: " + nearest_miss(answers_[1]) + '\n'), std::string::npos) << table;
    EXPECT_EQ(table.find("Cortex-M7: nothing"), std::string::npos);
}

}  // namespace
