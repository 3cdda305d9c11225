// From rows to a question and a diagnosis: which core is asked about beside which, programs that differ, and what a
// board would run next.
#include "gap/cycles/diagnose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "base/failure.hpp"
#include "gap/cycles/blind.hpp"
#include "gap/cycles/tally.hpp"
#include "qemu/emulate/silicon_loops.hpp"

namespace {

using gap::Outcome;
using gap::cycles::Explanation;
using gap::cycles::Question;
using testing::ElementsAre;
using testing::HasSubstr;

qemu::MeasuredCycles row(const std::string& kernel, std::uint32_t taps, double cycles) {
    return {kernel, "itcm", "dtcm", false, taps, cycles, 0};
}

TEST(CyclesQuestion, ACoreThatPaysForAllIsItsOwnReference) {
    const Question own = gap::cycles::question_about({row("ring_plain_f32", 10, 1.0)}, {"stm32f746-itcm"}, TEST_CORES);
    EXPECT_EQ(own.base, "stm32f746-itcm");
    EXPECT_EQ(own.rows.size(), 1U);
    EXPECT_TRUE(own.base_off.empty());
    EXPECT_THAT(own.references, ElementsAre("stm32f746-itcm"));
    EXPECT_THAT(own.sets.at("stm32f746-itcm"), testing::Contains("published"));
    // A set that silicon speaks against is no candidate.
    EXPECT_THAT(own.fitting.at("stm32f746-itcm"), testing::Not(testing::IsEmpty()));
    EXPECT_THAT(own.fitting.at("stm32f746-itcm"), testing::Not(testing::Contains("published")));
}

TEST(CyclesQuestion, AnIdealCoreIsAskedAboutBesideThoseThatPay) {
    const Question ideal = gap::cycles::question_about({}, {"m7-ideal"}, TEST_CORES);
    EXPECT_EQ(ideal.base_off.size(), timing::effect_count);
    EXPECT_THAT(ideal.references, ElementsAre("stm32h747-dtcm", "stm32f746-itcm"));
    EXPECT_EQ(ideal.sets.size(), 2U);
    EXPECT_THROW((void)gap::cycles::question_about({}, {"m8"}, TEST_CORES), glsum::Failure);
}

// A tap takes 3 cycles and 5 instructions; of a rival loop a turn takes 4, or 6 of the first where the set is "slow".
std::vector<std::vector<qemu::PredictedCycles>> predict(const std::vector<qemu::MeasuredCycles>& rows,
                                                        const std::vector<qemu::CoreVariant>& variants) {
    std::vector<std::vector<qemu::PredictedCycles>> all;
    for (const qemu::CoreVariant& variant : variants) {
        all.emplace_back();
        for (const qemu::MeasuredCycles& one : rows) {
            double a_turn = 3.0;
            if (qemu::find_loop(one.kernel) != nullptr) {
                a_turn = one.kernel == qemu::rival_loops().front().name && variant.set == "slow" ? 6.0 : 4.0;
            }
            if (one.kernel == "ring_plain_f32" && variant.set == "published") {
                a_turn = 2.0;
            }
            all.back().push_back({a_turn * one.taps, 0, 0, 0, 5 * std::uint64_t{one.taps}, {}});
        }
    }
    return all;
}

Question of_the_core(std::vector<qemu::MeasuredCycles> rows) {
    Question question;
    question.rows = std::move(rows);
    question.base = "core";
    question.references = {"core"};
    question.sets["core"] = {"published", "fast", "slow"};
    question.fitting["core"] = {"fast", "slow"};
    return question;
}

TEST(CyclesDiagnosis, OtherCountsOfInstructionsAreAnotherProgram) {
    Question question = of_the_core({row("ring_plain_f32", 10, 60.0), row("ring_plain_f32", 20, 60.0)});
    question.rows[0].instructions = 50.5;  // a mean of whole counts
    question.rows[1].instructions = 101.0;
    const Explanation found = gap::cycles::diagnose(question, predict);
    EXPECT_EQ(found.outcome, Outcome::attributed);
    ASSERT_EQ(found.steps.size(), 1U);
    EXPECT_EQ(found.steps[0].effect, "different_binary");
    EXPECT_EQ(found.base_gap, 30.0 / 120.0);
    EXPECT_EQ(found.after_gap, found.base_gap);
    EXPECT_THAT(found.notes, ElementsAre("ring_plain_f32 at 20 taps: 101 instructions a call were measured, this "
                                         "build has 100"));
    EXPECT_THAT(found.next_experiment, HasSubstr("measure the ELF that is predicted"));
    question.rows[1].instructions = 100.5;
    question.rows[0].cycles = 30.0;
    EXPECT_EQ(gap::cycles::diagnose(question, predict).outcome, Outcome::no_gap);
}

TEST(CyclesDiagnosis, RivalRulesAreToldApartByTheLoopsThatDiffer) {
    Question question = of_the_core({});
    for (const std::string_view name : timing::effect_names) {
        question.base_off.emplace_back(name);
    }
    question.base = "ideal";
    for (const std::uint32_t taps : {10U, 20U, 40U, 80U, 160U, 320U}) {
        question.rows.push_back(row("ring_plain_f32", taps, 3.0 * taps));
    }
    // The ideal core takes one cycle a tap, published rules two.
    const Explanation found = gap::cycles::diagnose(question, [](const auto& rows, const auto& variants) {
        auto all = predict(rows, variants);
        for (std::size_t v = 0; v < variants.size(); ++v) {
            for (std::size_t i = 0; variants[v].core == "ideal" && i < rows.size(); ++i) {
                all[v][i].nominal = rows[i].taps;
            }
        }
        return all;
    });
    ASSERT_EQ(found.outcome, Outcome::ambiguous);
    EXPECT_EQ(found.next_experiment,
              "run these loops on the board with targets/nucleo-f746zg; cycles a turn under each rule set: "
              "rival_fma_chain (fast 4.00, slow 6.00)");
}

TEST(CyclesBlind, SwitchesThatShowChangeMoreThanThreePercent) {
    // Three rows of 100 cycles, of which the n-th effect, where it is not paid, takes or gives some in one row.
    const std::vector<std::vector<double>> without{{90.5, 100.0, 100.0},                          // 9.5 of 290.5: 3.3 %
                                                   {91.5, 100.0, 100.0},                          // 2.9 %
                                                   {100.0, 109.5, 100.0},                         // 3.1 %, more
                                                   {100.0, 100.0, 90.5},  {100.0, 100.0, 109.0},  // 2.9 %
                                                   {95.0, 105.0, 100.0},   // 3.3 %, which no sum shows
                                                   {95.5, 104.5, 100.0}};  // 3 %, not more
    const auto found = gap::cycles::switches_that_show("core", [&](const auto& variants) {
        std::vector<std::vector<qemu::PredictedCycles>> all;
        for (const qemu::CoreVariant& variant : variants) {
            std::vector<double> cycles(3, 100.0);
            for (std::size_t n = 0; n < without.size(); ++n) {
                cycles = variant.without == std::vector{std::string(timing::effect_names[n])} ? without[n] : cycles;
            }
            all.emplace_back();
            for (const double one : cycles) {
                all.back().push_back({one, 0, 0, 0, 1, {}});
            }
        }
        return all;
    });
    const auto name = [](std::size_t n) { return std::string(timing::effect_names[n]); };
    EXPECT_THAT(found, ElementsAre(name(0), name(2), name(3), name(5)));
}

TEST(CyclesBlind, OtherRulesMakeTheCyclesOfEachCase) {
    const auto secrets = gap::cycles::draw_other_rules(200, 3, {"chain", "serial_fpu"});
    std::map<std::string, int> kinds;
    std::map<std::string, int> sets;
    EXPECT_EQ(secrets.size(), 200U);
    std::map<std::string, int> mechanisms;
    for (const auto& secret : secrets) {
        ++kinds[secret.kind];
        ++sets[secret.set];
        ++mechanisms[secret.mechanism];
        EXPECT_EQ(secret.other_rules(), secret.set + secret.mechanism);
        EXPECT_EQ(secret.effects.size(), secret.kind == "rules" ? 0U : 1U);
        EXPECT_TRUE(secret.without.empty());
    }
    EXPECT_NEAR(kinds["rules"], 100, 25);
    EXPECT_NEAR(kinds["rules and cost"], 100, 25);
    EXPECT_NEAR(sets["chain"], 100, 25);
    EXPECT_NEAR(mechanisms["serial_fpu"], 100, 25);
    EXPECT_EQ(sets["chain"], mechanisms[""]);
    EXPECT_EQ(sets[""], mechanisms["serial_fpu"]);
}

}  // namespace
