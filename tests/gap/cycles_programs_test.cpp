// Rows of any programs' functions as a diagnosis takes them: of whole calls, where they lay, on which core.
#include "gap/cycles/programs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using gap::cycles::Programs;
using testing::DoubleEq;
using testing::ElementsAre;

// Four samples a call, and one.
const std::vector<qemu::MeasuredCall> calls{
    {"a.elf", "filter", "stm32f746-flash", "", "", 100.0, 4.0, 2},
    {"b.elf", "control", "stm32f746-itcm", "axi", "axi", 30.0, 1.0, 3},
};

// What was asked, and of each call some cycles and 25 instructions for each of what it is divided by.
struct Asked {
    std::vector<qemu::CoreVariant> variants;
    gap::cycles::PredictCalls by() {
        return [this](const std::vector<qemu::CoreVariant>& asked) {
            variants = asked;
            std::vector<std::vector<qemu::PredictedCall>> all;
            for (std::size_t v = 0; v < asked.size(); ++v) {
                const double cycles = 40.0 + 10.0 * static_cast<double>(v);
                all.push_back({{cycles, cycles - 1.0, cycles + 2.0, 25.0, {}}, {7.0, 6.0, 8.0, 12.0, {}}});
                all.back().front().lost[1] = 1.5;
            }
            return all;
        };
    }
};

TEST(CyclesPrograms, AreAskedAboutByWholeCalls) {
    Asked asked;
    const gap::cycles::Question question = Programs(calls, "", TEST_CORES, asked.by()).question();
    EXPECT_EQ(question.base, "stm32f746-flash and stm32f746-itcm");
    ASSERT_EQ(asked.variants.size(), 1U);
    EXPECT_EQ(asked.variants[0].core, "");  // each row's own
    ASSERT_EQ(question.rows.size(), 2U);
    const qemu::MeasuredCycles& filter = question.rows[0];
    EXPECT_EQ(filter.kernel, "filter");
    EXPECT_EQ(filter.program, "a.elf");
    EXPECT_EQ(filter.cycles, 400.0);
    EXPECT_EQ(filter.taps, 100U);  // instructions
    EXPECT_EQ(filter.per, 4.0);
    EXPECT_EQ(filter.line, 2U);
    EXPECT_FALSE(filter.maintenance);
    EXPECT_EQ(question.rows[1].cycles, 30.0);
    EXPECT_EQ(question.rows[1].taps, 12U);
}

// As the row says, or else its core file; a core with an instruction cache stands before all but the ITCM.
TEST(CyclesPrograms, LieWhereTheirRowsOrTheirCoreSay) {
    Asked asked;
    const auto places = [&](const char* core, const char* code, const char* data) {
        std::vector<qemu::MeasuredCall> one{calls.front()};
        one[0].core = core;
        one[0].code = code;
        one[0].data = data;
        const auto row = Programs(one, "", TEST_CORES, asked.by()).question().rows.front();
        return row.code + " " + row.data;
    };
    EXPECT_EQ(places("stm32f746-flash", "", ""), "flash_cached dtcm");
    EXPECT_EQ(places("stm32f746-flash-nocache", "", ""), "flash dtcm");
    EXPECT_EQ(places("stm32f746-flash-nocache", "axi", "axi"), "axi axi");
    EXPECT_EQ(places("stm32f746-flash", "axi", "axi"), "axi_cached axi");
    EXPECT_EQ(places("stm32f746-flash", "itcm", ""), "itcm dtcm");
    EXPECT_EQ(places("stm32f746-itcm", "", ""), "itcm dtcm");
    EXPECT_EQ(places("stm32f746-itcm", "flash", "dtcm"), "flash_cached dtcm");
}

TEST(CyclesPrograms, AreJudgedByOneCoreWhereItIsNamed) {
    Asked asked;
    const Programs programs(calls, "stm32f746-itcm", TEST_CORES, asked.by());
    const gap::cycles::Question question = programs.question();
    EXPECT_EQ(question.base, "stm32f746-itcm");
    EXPECT_EQ(asked.variants.at(0).core, "stm32f746-itcm");
    EXPECT_EQ(question.rows.front().code, "itcm");
    (void)programs.predict({{"stm32f746-itcm", "chain"}});
    EXPECT_EQ(asked.variants.at(0).core, "stm32f746-itcm");
    EXPECT_EQ(asked.variants.at(0).set, "chain");
}

// Rows that name their cores are asked by them where the variant is of all of these.
TEST(CyclesPrograms, ArePredictedByWholeCalls) {
    Asked asked;
    const Programs programs(calls, "", TEST_CORES, asked.by());
    const auto found = programs.predict({{"stm32f746-flash and stm32f746-itcm", "", {"single_issue"}}, {"m7-ideal"}});
    ASSERT_EQ(asked.variants.size(), 2U);
    EXPECT_EQ(asked.variants[0].core, "");
    EXPECT_THAT(asked.variants[0].without, ElementsAre("single_issue"));
    EXPECT_EQ(asked.variants[1].core, "m7-ideal");
    ASSERT_EQ(found.size(), 2U);
    ASSERT_EQ(found[0].size(), 2U);
    const qemu::PredictedCycles& filter = found[0][0];
    EXPECT_EQ(filter.nominal, 160.0);
    EXPECT_EQ(filter.low, 156.0);
    EXPECT_EQ(filter.high, 168.0);
    EXPECT_EQ(filter.beside, 0.0);
    EXPECT_EQ(filter.instructions, 100U);
    EXPECT_EQ(filter.half_cycles[1], 12);  // half cycles of four times one and a half
    EXPECT_EQ(filter.half_cycles[0], 0);
    EXPECT_EQ(found[1][0].nominal, 200.0);
    EXPECT_THAT((std::vector{found[1][1].nominal, found[1][1].low, found[1][1].high}),
                ElementsAre(DoubleEq(7.0), DoubleEq(6.0), DoubleEq(8.0)));
}

}  // namespace
