// Blind cases of cycles: what is drawn, what is done to the rows, what is sealed, and which answers are right.
#include "gap/cycles/blind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "gap/cycles/explain.hpp"
#include "gap/cycles/tally.hpp"

namespace {

using gap::Outcome;
using gap::cycles::Explanation;

TEST(BlindCycles, SecretsAreOfEveryKindAndRepeatWithTheirSeed) {
    const std::vector<std::string> switches{"single_issue", "fpu_latency"};
    const auto secrets = gap::cycles::draw_secrets(400, 7, switches);
    EXPECT_EQ(secrets.size(), 400U);
    std::map<std::string, int> kinds;
    std::set<std::string> effects;
    for (const auto& secret : secrets) {
        ++kinds[secret.kind];
        effects.insert(secret.effects.begin(), secret.effects.end());
        EXPECT_EQ(secret.effects.size(), secret.kind == "two"                               ? 2U
                                         : secret.kind == "switch" || secret.kind == "cost" ? 1U
                                                                                            : 0U);
    }
    EXPECT_NEAR(kinds["nothing"], 100, 30);
    EXPECT_NEAR(kinds["two"], 60, 25);
    EXPECT_NEAR(kinds["unlisted"], 60, 25);
    EXPECT_EQ(effects, (std::set<std::string>{"bus_contention", "cache_maintenance", "call_overhead", "clock_ratio",
                                              "fpu_latency", "single_issue"}));
    const auto again = gap::cycles::draw_secrets(400, 7, switches);
    for (std::size_t i = 0; i < secrets.size(); ++i) {
        EXPECT_EQ(secrets[i].effects, again[i].effects);
        EXPECT_EQ(secrets[i].ratio, again[i].ratio);
    }
}

TEST(BlindCycles, WhatWasDoneIsInTheRows) {
    auto rows = gap::cycles::blind_rows();
    ASSERT_EQ(rows.size(), 72U);
    const std::vector<qemu::PredictedCycles> predicted(rows.size(), {1000.0, 0, 0, 100.0, 500, {}});
    gap::cycles::measure(rows, predicted, {.kind = "cost", .ratio = 2.0, .overhead = 10.0, .maintenance = 50.0}, 1);
    std::set<double> off;
    for (const auto& row : rows) {
        off.insert(row.cycles - (row.maintenance ? 2120.0 : 2020.0));
    }
    EXPECT_EQ(off, (std::set<double>{-1.0, 0.0, 1.0}));
    gap::cycles::measure(rows, predicted, {.kind = "cost", .contention = 0.5}, 1);
    EXPECT_NEAR(rows.front().cycles, 1000.0, 1.0);  // in ITCM and DTCM
    EXPECT_NEAR(rows.back().cycles, 1450.0, 1.0);
    gap::cycles::measure(rows, predicted, {.kind = "unlisted", .sawtooth = 1.0}, 1);
    for (const auto& row : rows) {
        EXPECT_NEAR(row.cycles, row.taps % 3 == 1 ? 1900.0 : 1000.0, 1.0) << row.taps;
    }
}

TEST(BlindCycles, OnlyTheWholeAnswerIsRight) {
    Explanation found{};
    found.outcome = Outcome::attributed;
    found.steps = {{"fpu_latency", {}, {}, 0, 0, 0}, {"call_overhead", {}, {}, 0, 0, 0}};
    EXPECT_TRUE(names(found, {.kind = "two", .effects = {"call_overhead", "fpu_latency"}}));
    EXPECT_FALSE(names(found, {.kind = "switch", .effects = {"fpu_latency"}}));
    EXPECT_FALSE(names(found, {.kind = "nothing"}));
    EXPECT_FALSE(names(found, {.kind = "unlisted"}));
    found.outcome = Outcome::ambiguous;
    EXPECT_FALSE(names(found, {.kind = "two", .effects = {"call_overhead", "fpu_latency"}}));
    found.alternatives = {{"interrupt_load", {}, {}, 0, 0, 0}, {"clock_ratio", {}, {}, 0, 0, 0}};
    EXPECT_TRUE(names(found, {.kind = "two", .effects = {"call_overhead", "clock_ratio", "fpu_latency"}}));
    found.outcome = Outcome::unknown;
    EXPECT_FALSE(names(found, {.kind = "two", .effects = {"call_overhead", "fpu_latency"}}));
    EXPECT_TRUE(names(found, {.kind = "unlisted"}));
    found.outcome = Outcome::no_gap;
    EXPECT_TRUE(names(found, {.kind = "nothing"}));
}

// The rival sets that fit silicon and every mechanism; a core of others' rules, or of none, has none to draw.
TEST(BlindCycles, OtherRulesAreTheRivalSetsAndEveryMechanism) {
    std::vector<std::string> wanted{"barred", "chain", "unfolded"};
    for (const std::string& mechanism : timing::mechanism_names()) {
        wanted.push_back(mechanism);
    }
    EXPECT_EQ(gap::cycles::other_rules_of("stm32f746-itcm", TEST_CORES), wanted);
    for (const char* core : {"m7-ideal", "cortex-m4-zerowait"}) {
        EXPECT_THROW((void)gap::cycles::other_rules_of(core, TEST_CORES), glsum::Failure) << core;
    }
}

TEST(BlindCycles, EveryMechanismHasAPlaceAndACoreFile) {
    for (const std::string& mechanism : timing::mechanism_names()) {
        EXPECT_TRUE(gap::cycles::has_place(mechanism)) << mechanism;
        EXPECT_EQ(gap::cycles::core_with("some", mechanism), "base = \"some\"\nmechanisms = [\"" + mechanism + "\"]\n");
    }
}

// What other rules do may go by the name of where they act, or by none; a cost beside them has its own.
TEST(BlindCycles, OtherRulesAreRightByAllButANameForWhatTheyDoNotTouch) {
    Explanation found{};
    const auto is_right = [&](Outcome outcome, const std::vector<std::string>& named, const std::string& set,
                              const std::vector<std::string>& effects) {
        found.outcome = outcome;
        found.steps.clear();
        for (const std::string& effect : named) {
            found.steps.push_back({effect, {}, {}, 0, 0, 0});
        }
        return names(found, {.kind = "rules", .effects = effects, .set = set});
    };
    for (const Outcome outcome : {Outcome::no_gap, Outcome::unknown, Outcome::ambiguous}) {
        EXPECT_TRUE(is_right(outcome, {}, "chain", {}));
    }
    EXPECT_TRUE(is_right(Outcome::attributed, {"fpu_latency"}, "chain", {}));
    EXPECT_FALSE(is_right(Outcome::attributed, {"fpu_latency"}, "unfolded", {}));
    EXPECT_TRUE(is_right(Outcome::attributed, {"single_issue"}, "unfolded", {}));
    EXPECT_FALSE(is_right(Outcome::attributed, {"call_overhead"}, "chain", {}));
    EXPECT_TRUE(is_right(Outcome::attributed, {"call_overhead"}, "chain", {"call_overhead"}));
    EXPECT_TRUE(is_right(Outcome::attributed, {"fpu_latency", "call_overhead"}, "chain", {"call_overhead"}));
    EXPECT_FALSE(is_right(Outcome::attributed, {"load_use", "call_overhead"}, "chain", {"call_overhead"}));
    EXPECT_FALSE(is_right(Outcome::unknown, {"call_overhead"}, "chain", {"call_overhead"}));
    found.alternatives = {{"interrupt_load", {}, {}, 0, 0, 0}, {"clock_ratio", {}, {}, 0, 0, 0}};
    EXPECT_TRUE(is_right(Outcome::ambiguous, {"fpu_latency"}, "chain", {"clock_ratio"}));
    EXPECT_FALSE(is_right(Outcome::ambiguous, {"fpu_latency"}, "chain", {"call_overhead"}));
    found.outcome = Outcome::attributed;
    found.steps = {{"dcache_misses", {}, {}, 0, 0, 0}};
    EXPECT_TRUE(names(found, {.kind = "rules", .mechanism = "random_replacement"}));
    EXPECT_FALSE(names(found, {.kind = "rules", .mechanism = "history_predictor"}));
}

TEST(BlindCycles, TheSealedTruthHasAllThatWasDone) {
    gap::cycles::Secret cost{.kind = "cost", .effects = {"clock_ratio"}};
    cost.ratio = 1.25;
    const std::string text = gap::cycles::seal({{.kind = "nothing"}, cost});
    EXPECT_EQ(text, nlohmann::ordered_json::parse(text).dump(2) + "\n");
    const auto truth = nlohmann::json::parse(text);
    ASSERT_EQ(truth.size(), 2U);
    EXPECT_EQ(truth[0]["case"], "case-001");
    EXPECT_EQ(truth[0]["kind"], "nothing");
    EXPECT_EQ(truth[1]["case"], gap::cycles::name_of_case(2));
    EXPECT_EQ(truth[1]["effects"], nlohmann::json({"clock_ratio"}));
    EXPECT_EQ(truth[1]["ratio"], 1.25);
    EXPECT_EQ(truth[1]["rules"], "nominal");
    for (const char* size : {"overhead", "maintenance", "contention", "sawtooth"}) {
        EXPECT_EQ(truth[1][size], 0.0) << size;
    }
}

TEST(BlindCycles, TheSealedTruthHasEachSizeByItsName) {
    const gap::cycles::Secret all{.kind = "rules and cost",
                                  .effects = {"call_overhead", "clock_ratio"},
                                  .set = "chain",
                                  .ratio = 0.75,
                                  .overhead = 20.0,
                                  .maintenance = 50.0,
                                  .contention = 0.25,
                                  .sawtooth = 0.375};
    const auto truth = nlohmann::json::parse(gap::cycles::seal({all, {.kind = "rules", .mechanism = "serial_fpu"}}));
    const nlohmann::json wanted{{"case", "case-001"},
                                {"kind", "rules and cost"},
                                {"effects", {"call_overhead", "clock_ratio"}},
                                {"rules", "chain"},
                                {"ratio", 0.75},
                                {"overhead", 20.0},
                                {"maintenance", 50.0},
                                {"contention", 0.25},
                                {"sawtooth", 0.375}};
    EXPECT_EQ(truth[0], wanted);
    EXPECT_EQ(truth[1]["rules"], "serial_fpu");
    EXPECT_EQ(truth[1]["ratio"], 1.0);
    EXPECT_EQ(gap::cycles::name_of_case(12), "case-012");
    EXPECT_EQ(gap::cycles::name_of_case(1234), "case-1234");
}

// Of 1000 cycles 100 lie beside the call. The 900 inside are half more at lengths of 3 n + 1, and a fifth more on the
// bus. Beside it come 15, and 50 of maintenance. All of it goes by 1.25, is rounded, and is counted to within one.
TEST(BlindCycles, RowsHaveAllThatWasDone) {
    const gap::cycles::Secret secret{
        .kind = "unlisted", .ratio = 1.25, .overhead = 15.0, .maintenance = 50.0, .contention = 0.2, .sawtooth = 0.5};
    const auto off = [&](const qemu::MeasuredCycles& one, double cycles) {
        std::vector<qemu::MeasuredCycles> rows(60, one);
        gap::cycles::measure(rows, std::vector<qemu::PredictedCycles>(60, {1000.0, 0, 0, 100.0, 500, {}}), secret, 4);
        std::set<double> found;
        for (const qemu::MeasuredCycles& measured : rows) {
            found.insert(measured.cycles - cycles);
        }
        return found;
    };
    const std::set<double> by_one{-1.0, 0.0, 1.0};
    EXPECT_EQ(off({"k", "itcm", "dtcm", false, 12, 0.0, 0}, std::round(1.25 * (900.0 + 115.0))), by_one);
    EXPECT_EQ(off({"k", "itcm", "dtcm", false, 10, 0.0, 0}, std::round(1.25 * (1350.0 + 115.0))), by_one);
    EXPECT_EQ(off({"k", "itcm", "axi", false, 11, 0.0, 0}, std::round(1.25 * (1080.0 + 115.0))), by_one);
    EXPECT_EQ(off({"k", "flash_cached", "axi", true, 10, 0.0, 0}, std::round(1.25 * (1620.0 + 165.0))), by_one);
}

// No counter runs backwards: the shortest call is of one cycle.
TEST(BlindCycles, RowsHaveACycleAtLeast) {
    std::vector<qemu::MeasuredCycles> rows(60, qemu::MeasuredCycles{"k", "itcm", "dtcm", false, 12, 0.0, 0});
    gap::cycles::measure(rows, std::vector<qemu::PredictedCycles>(60, {0.25, 0, 0, 0.0, 1, {}}), {.kind = "nothing"},
                         4);
    for (const qemu::MeasuredCycles& measured : rows) {
        EXPECT_EQ(measured.cycles, 1.0);
    }
}

// Clopper and Pearson (1934): 5 of 10 within 18.7 to 81.3 %; none of 10 within 0 to 30.8 %.
TEST(CyclesTally, HasTheShareOfEachKindWithItsInterval) {
    gap::cycles::Tally tally;
    for (int i = 0; i < 10; ++i) {
        tally.count("switch", i % 2 == 0);
        tally.count("cost", false);
    }
    EXPECT_EQ(tally.to_text(),
              "  cost           0 of 10, 0 % [0, 31]\n"
              "  switch         5 of 10, 50 % [19, 81]\n");
}

}  // namespace
