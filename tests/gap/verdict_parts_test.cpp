// A verdict's file and text, from one made by hand: each field that the schema has, and nothing that is not in it.
#include "gap/verdict/verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/count_of.hpp"
#include "tests/gap/verdict_case.hpp"

namespace {

using nlohmann::json;
using test::count_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using verdict_test::backlash;
using verdict_test::of_drive;
using verdict_test::verdict_of;

json file_of(const gap::Verdict& verdict) { return json::parse(gap::to_json(verdict)); }

// Where inputs are counted from stands beside the base, and only where it is not 0.
TEST(VerdictFile, SaysWhereInputsAreCountedFrom) {
    gap::OfDrive of = of_drive();
    EXPECT_FALSE(file_of(verdict_of(of))["base"].contains("idle_input"));
    EXPECT_THAT(gap::to_text(verdict_of(of)), Not(HasSubstr("counted from")));
    of.base.idle_input = 1000.0;
    EXPECT_EQ(file_of(verdict_of(of))["base"]["idle_input"], 1000.0);
    EXPECT_THAT(gap::to_text(verdict_of(of)), HasSubstr("; inputs, those of causes too, are counted from 1000"));
}

TEST(VerdictFile, OfADriveHasTheSchemasFields) {
    gap::OfDrive of = of_drive();
    of.alternatives = {{backlash()}};
    of.extrapolated = {"falling output"};
    gap::Verdict verdict = verdict_of(of);
    verdict.notes = {"a note"};
    const json wanted = {
        {"schema", "glsum-gap-1"},
        {"verdict", "attributed"},
        {"effects",
         {{{"effect", "backlash"},
           {"alternative", 0},
           {"parameters", {{"gap", 0.25}}},
           {"interval", {{"gap", {0.2, 0.3}}}},
           {"gap_before", 0.5},
           {"gap_after", 0.1},
           {"shrink", 0.8},
           {"confidence", 0.875}}}},
        {"ranking",
         {{{"effect", "backlash"}, {"gap_after", 0.1}, {"score", 60.0}},
          {{"effect", "none"}, {"gap_after", 0.5}, {"score", -40.0}}}},
        {"gap", {{"metric", "simulation"}, {"base", 0.5}, {"after", 0.1}, {"noise_floor", 0.05}}},
        {"where",
         {{"time",
           {{{"from_s", 0.0}, {"to_s", 2.0}, {"share", 0.95}, {"after", "start"}},
            {{"from_s", 2.0}, {"to_s", 4.0}, {"share", 0.05}}}},
          {"frequency",
           {{{"from_hz", 0.0}, {"to_hz", 0.5}, {"share", 0.9}}, {{"from_hz", 0.5}, {"to_hz", 5.0}, {"share", 0.1}}}},
          {"input_level", {{{"from", 0.1}, {"to", 0.1}, {"share", 0.9}}, {{"from", 0.2}, {"to", 0.3}, {"share", 0.1}}}},
          {"output_level", {{{"from", -1.0}, {"to", 1.0}, {"share", 1.0}}}},
          {"direction", {{"rising", 0.5}, {"falling", 0.3}, {"still", 0.2}}}}},
        {"extrapolated", {"falling output"}},
        {"base",
         {{"form", "second_order"},
          {"model", "1 / (1.23456 s + 1)"},
          {"parameters", {{"gain", 1.5}}},
          {"interval", {{"gain", {1.25, 1.75}}}},
          {"linear_share", 0.75}}},
        {"next_experiment", "rest"},
        {"confidence", 0.875},
        {"split", false},
        {"notes", {"a note"}}};
    EXPECT_EQ(file_of(verdict), wanted);
}

TEST(VerdictFile, SaysWhichCausesStandTogether) {
    gap::OfDrive of = of_drive();
    gap::Cause drift = backlash();
    drift.effect = "sensor_drift";
    of.alternatives = {{backlash(), drift}, {drift}};
    of.split = true;
    of.base.form = "";
    gap::Verdict verdict = verdict_of(of);
    verdict.outcome = gap::Outcome::ambiguous;
    const json file = file_of(verdict);
    EXPECT_EQ(file["verdict"], "ambiguous");
    ASSERT_EQ(file["effects"].size(), 3U);
    EXPECT_EQ(file["effects"][0]["alternative"], 0);
    EXPECT_EQ(file["effects"][1]["alternative"], 0);
    EXPECT_EQ(file["effects"][2]["alternative"], 1);
    EXPECT_EQ(file["effects"][1]["effect"], "sensor_drift");
    EXPECT_EQ(file["split"], true);
    EXPECT_EQ(file["base"]["form"], "given");
    EXPECT_FALSE(file.contains("suspect"));
    EXPECT_THAT(gap::to_text(verdict),
                AllOf(HasSubstr("verdict: ambiguous: backlash + sensor_drift or sensor_drift (confidence 0.88)"),
                      HasSubstr("judged by parts of the training record"), Not(HasSubstr("base: "))));
}

// What a cause takes is what the others leave without it, squared, over the squared gap.
TEST(VerdictFile, SaysWhatEachCauseTakes) {
    gap::OfDrive of = of_drive();
    gap::Cause drift = backlash();
    drift.effect = "sensor_drift";
    drift.gap_without = 0.2;  // (0.04 - 0.01) / 0.25
    drift.parameters[0].unit = "y/s";
    of.alternatives = {{backlash(), drift}};
    const gap::Verdict both = verdict_of(of);
    EXPECT_FALSE(file_of(both)["effects"][0].contains("gap_without"));
    EXPECT_EQ(file_of(both)["effects"][1]["gap_without"], 0.2);
    EXPECT_THAT(gap::to_text(both),
                AllOf(HasSubstr("  sensor_drift.gap = 0.25  [0.2, 0.3]  y/s\n"),
                      HasSubstr("  sensor_drift takes 12 % of the squared gap; without it 0.2000 is left\n"),
                      Not(HasSubstr("backlash takes"))));
    drift.gap_without = 0.5;
    drift.parameters[0].unit = "1";
    of.alternatives = {{drift}};
    EXPECT_THAT(gap::to_text(verdict_of(of)), AllOf(HasSubstr("  sensor_drift.gap = 0.25  [0.2, 0.3]\n"),
                                                    HasSubstr("  sensor_drift takes 96 % of the squared gap\n")));
    drift.gap_without = 0.05;  // others hide it: nothing, not less
    of.alternatives = {{drift}};
    EXPECT_THAT(gap::to_text(verdict_of(of)), HasSubstr("takes 0 % of the squared gap\n"));
    drift.gap_before = 0.0;  // of nothing there is no share
    of.alternatives = {{drift}};
    EXPECT_THAT(gap::to_text(verdict_of(of)), Not(HasSubstr("takes")));
}

// A word has no interval, a number may have none, a list one for each.
TEST(VerdictFile, HasIntervalsOfWhatHasSome) {
    gap::OfDrive of = of_drive();
    of.alternatives = {{{"missed_counts",
                         {{"format", "q15"},
                          {"step", 2.0},
                          {"at_s", std::vector<double>{3.0, 7.0}, {{2.5, 3.5}, {6.5, 7.5}}},
                          {"sizes", std::vector<double>{}}},
                         0.5,
                         0.1,
                         0.8,
                         0.9}}};
    const gap::Verdict verdict = verdict_of(of);
    const json effect = file_of(verdict)["effects"][0];
    EXPECT_EQ(effect["parameters"],
              (json{{"format", "q15"}, {"step", 2.0}, {"at_s", {3.0, 7.0}}, {"sizes", json::array()}}));
    EXPECT_EQ(effect["interval"], (json{{"at_s", {{2.5, 3.5}, {6.5, 7.5}}}, {"sizes", json::array()}}));
    EXPECT_THAT(gap::to_text(verdict),
                AllOf(HasSubstr("  missed_counts.format = q15\n"), HasSubstr("  missed_counts.step = 2\n"),
                      HasSubstr("  missed_counts.at_s = 3, 7  [2.5, 3.5, 6.5, 7.5]\n")));
}

TEST(VerdictFile, HasTheBasesRecordsAndDescriptionsAndTheSuspect) {
    gap::OfDrive of = of_drive();
    of.base.records = {{"a.csv", {{"offset", 0.5}, {"initial_output", 0.25}}}, {"b.csv", {{"offset", -0.125}}}};
    of.base.descriptions = {{"second_order", 0.01, 0.02}, {"first_order", 0.1, 0.2}};
    of.suspect =
        gap::Suspect{"backlash + gain_drift", {{"backlash", backlash().parameters}, {"gain_drift", {}}}, 0.25, 0.25};
    gap::Verdict verdict = verdict_of(of);
    verdict.outcome = gap::Outcome::unknown;
    const json file = file_of(verdict);
    EXPECT_EQ(file["base"]["records"],
              json::parse(R"([{"record": "a.csv", "numbers": {"offset": 0.5, "initial_output": 0.25}},
                              {"record": "b.csv", "numbers": {"offset": -0.125}}])"));
    EXPECT_EQ(file["base"]["descriptions"], json::parse(R"([{"form": "second_order", "gap_aside": 0.01, "gap": 0.02},
                                                            {"form": "first_order", "gap_aside": 0.1, "gap": 0.2}])"));
    EXPECT_EQ(file["suspect"],
              json::parse(
                  R"({"effects": [{"effect": "backlash", "parameters": {"gap": 0.25}, "interval": {"gap": [0.2, 0.3]}},
                                          {"effect": "gain_drift", "parameters": {}, "interval": {}}],
                              "gap_after": 0.25, "unexplained": 0.25})"));
    EXPECT_THAT(
        gap::to_text(verdict),
        AllOf(HasSubstr("verdict: unknown (confidence 0.88)\n"),
              HasSubstr("base: second_order, 1 / (1.235 s + 1); the best linear description explains 75.0 % of the "
                        "variance; of the records judged: offset 0.5, offset -0.125\n"),
              HasSubstr("suspect: backlash + gain_drift brings the gap from 0.5000 to 0.2500; 25 % of its square stay "
                        "unexplained\n")));
}

TEST(VerdictFile, NamesEachOutcome) {
    for (const auto& [outcome, name] :
         {std::pair(gap::Outcome::attributed, "attributed"), std::pair(gap::Outcome::ambiguous, "ambiguous"),
          std::pair(gap::Outcome::unknown, "unknown"), std::pair(gap::Outcome::no_gap, "no_gap")}) {
        gap::Verdict verdict = verdict_of(of_drive());
        verdict.outcome = outcome;
        EXPECT_EQ(file_of(verdict)["verdict"], name);
    }
}

// --- The text.

TEST(VerdictText, ExplainsVarianceByTheGapsSquare) {
    EXPECT_THAT(
        gap::to_text(verdict_of(of_drive())),
        AllOf(HasSubstr(
                  "gap, rms over the output's deviation, simulation: 0.5000 before, 0.1000 after, 0.0500 at best\n"),
              HasSubstr("variance explained: 75.0 % by the simulation, 99.0 % by the best candidate\n")));
    gap::Verdict worse = verdict_of(of_drive());
    worse.gap.base = 1.5;
    EXPECT_THAT(gap::to_text(worse), HasSubstr("variance explained: 0.0 % by the simulation"));
}

TEST(VerdictText, LeavesOutPlacesThatHoldLittle) {
    gap::OfDrive of = of_drive();
    // At the edges they are shown: a twentieth of the time, a tenth of a band or level.
    std::string text = gap::to_text(verdict_of(of));
    EXPECT_THAT(
        text,
        AllOf(HasSubstr("     0.000 to    2.000 s   95.0 %  start\n"), HasSubstr("     2.000 to    4.000 s    5.0 %"),
              HasSubstr("  constant                 90.0 %\n"), HasSubstr("       0.5 to        5 Hz  10.0 %\n"),
              HasSubstr("  input at 0.1                  90.0 %\n"),
              HasSubstr("  input 0.2 to 0.3              10.0 %\n"),
              HasSubstr("  output rising 50.0 %, falling 30.0 %, still 20.0 %\n")));
    EXPECT_THAT(text, Not(HasSubstr("  output -1 to 1")));  // one level says nothing
    of.where.time[1].share = 0.0499;
    of.where.frequency[1].share = 0.0999;
    of.where.input_level[1].share = 0.0999;
    of.where.output_level = {{-1.0, 0.0, 0.2, ""}, {0.0, 1.0, 0.8, ""}};
    text = gap::to_text(verdict_of(of));
    EXPECT_THAT(text, AllOf(Not(HasSubstr("4.000 s")), Not(HasSubstr("5 Hz")), Not(HasSubstr("input 0.2")),
                            HasSubstr("  output -1 to 0 "), HasSubstr("  output 0 to 1 ")));
}

TEST(VerdictText, ShowsTheTenBestAndNone) {
    gap::Verdict verdict = verdict_of(of_drive());
    verdict.ranking.clear();
    for (int i = 1; i <= 12; ++i) {
        verdict.ranking.push_back({"effect-" + std::to_string(i) + ".", 0.01 * i, 100.0 - i});
    }
    verdict.ranking.push_back({"none", 0.5, 40.0});
    const std::string text = gap::to_text(verdict);
    EXPECT_THAT(text, AllOf(HasSubstr("effect-10."), Not(HasSubstr("effect-11.")), HasSubstr("\n  none ")));
    EXPECT_THAT(text, testing::ContainsRegex("effect-2\\. +0\\.0200 +58\\.0\n"));  // over none
    EXPECT_THAT(text, testing::ContainsRegex("none +0\\.5000 +0\\.0\n"));
}

TEST(VerdictText, EndsWithNotesAndWhatComesNext) {
    gap::Verdict verdict = verdict_of(of_drive());
    EXPECT_EQ(count_of(gap::to_text(verdict), "note:"), 0U);
    EXPECT_THAT(gap::to_text(verdict), AllOf(testing::EndsWith("\n\nnext: rest\n"), Not(HasSubstr("extrapolated"))));
    verdict.notes = {"first", "second"};
    std::get<gap::OfDrive>(verdict.of).extrapolated = {"input above 1", "falling output"};
    EXPECT_THAT(gap::to_text(verdict),
                testing::EndsWith(
                    "\nextrapolated, as training has none of it: input above 1, falling output\n\nnote: first\nnote: "
                    "second\n\nnext: rest\n"));
}

// --- Cycles: the same type, file and text.

gap::Verdict of_cycles() {
    gap::OfCycles of{"m7-ideal", "stm32h747-dtcm", {}, {}, "every row's time", {}};
    of.steps = {{"call_overhead", {{"cycles", 10.0, {{8.0, 12.0}}}}, 0.5, 0.25, 0.625, 0.95}};
    of.alternatives = {{"clock_ratio", {{"ratio", 1.25}}, 0.25, 0.0625, 0.46875, 0.6},
                       {"interrupt_load", {{"share", 0.2}}, 0.25, 0.0625, 0.46875, 0.6}};
    of.where.kernels = {{"ring_plain_q31", 0.75}, {"ring_plain_f32", 0.25}};
    of.where.placements = {{"code=itcm data=dtcm", 1.0}};
    of.where.lines = {{"slope", 0.875}, {"constant", 0.125}};
    return {gap::Outcome::ambiguous,
            {"sum of absolute differences", 0.5, 0.0625, 0.1},
            {{"call_overhead", 0.25, 0.25}, {"clock_ratio", 0.0625, 0.1875}},
            of,
            "interrupts off",
            {"first", "second"}};
}

TEST(VerdictFile, OfCyclesHasTheSchemasFields) {
    const json wanted = json::parse(R"({
        "schema": "glsum-gap-1", "verdict": "ambiguous",
        "effects": [
            {"effect": "call_overhead", "parameters": {"cycles": 10.0}, "interval": {"cycles": [8.0, 12.0]}, "gap_before": 0.5,
             "gap_after": 0.25, "shrink": 0.625, "confidence": 0.95},
            {"effect": "clock_ratio", "parameters": {"ratio": 1.25}, "interval": {}, "gap_before": 0.25, "gap_after": 0.0625,
             "shrink": 0.46875, "confidence": 0.6},
            {"effect": "interrupt_load", "parameters": {"share": 0.2}, "interval": {}, "gap_before": 0.25, "gap_after": 0.0625,
             "shrink": 0.46875, "confidence": 0.6}],
        "alternatives": ["clock_ratio", "interrupt_load"],
        "ranking": [{"effect": "call_overhead", "gap_after": 0.25, "score": 0.25},
                    {"effect": "clock_ratio", "gap_after": 0.0625, "score": 0.1875}],
        "gap": {"metric": "sum of absolute differences", "base": 0.5, "after": 0.0625, "noise_floor": 0.1},
        "where": {"kernel": [{"kernel": "ring_plain_q31", "share": 0.75}, {"kernel": "ring_plain_f32", "share": 0.25}],
                  "slope": 0.875, "constant": 0.125, "placement": [{"placement": "code=itcm data=dtcm", "share": 1.0}],
                  "call": {"first": 0.0, "warm": 1.0}},
        "reference": "stm32h747-dtcm", "notes": ["first", "second"], "next_experiment": "interrupts off"})");
    EXPECT_EQ(file_of(of_cycles()), wanted);
}

TEST(VerdictText, OfCyclesTellsEachStepInPerCent) {
    const std::string text = gap::to_text(of_cycles());
    EXPECT_THAT(text, AllOf(HasSubstr("ambiguous: the gap to m7-ideal is 50.0 % of the measured cycles, 6.25 % with "
                                      "what follows (noise 10.00 %)"),
                            testing::ContainsRegex("kernel +ring_plain_q31 +75\\.0 %\n"),
                            testing::ContainsRegex("along the length +slope +87\\.5 %\n"),
                            testing::ContainsRegex("call_overhead +10 cycles +8\\.0 to 12\\.0 +50\\.0% +25\\.0%\n"),
                            HasSubstr("what these rows cannot part (every row's time), each explains it as well:\n"),
                            testing::ContainsRegex("clock_ratio +1\\.25 ratio +25\\.0% +6\\.2%\n"),
                            HasSubstr("note: first\n\nnote: second\n"),
                            testing::EndsWith("\nnext experiment: interrupts off\n")));
    gap::Verdict bare = of_cycles();
    auto& of = std::get<gap::OfCycles>(bare.of);
    of.alternatives.clear();
    bare.next_experiment.clear();
    EXPECT_THAT(gap::to_text(bare),
                AllOf(HasSubstr("effect, in turn"), Not(HasSubstr("cannot part")), Not(HasSubstr("next"))));
    of.alternatives = {{"different_binary", {}, 0.5, 0.5, 0.0, 0.99}};
    of.steps.clear();
    EXPECT_THAT(gap::to_text(bare), AllOf(HasSubstr("effect, in turn"), HasSubstr("different_binary")));
    of.alternatives.clear();
    EXPECT_THAT(gap::to_text(bare), Not(HasSubstr("effect, in turn")));
}

}  // namespace
