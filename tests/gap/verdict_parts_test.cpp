// A verdict's file, text and page, from one made by hand: each field that the schema has, and nothing that is not in
// it.
#include "gap/verdict/verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "gap/verdict/page.hpp"
#include "gap/verdict/plot.hpp"

namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

gap::OfDrive of_drive() {
    gap::OfDrive of{};
    of.chosen = "backlash";
    of.where.time = {{0.0, 2.0, 0.95, "start"}, {2.0, 4.0, 0.05, ""}};
    of.where.frequency = {{0.0, 0.5, 0.9, ""}, {0.5, 5.0, 0.1, ""}};
    of.where.input_level = {{0.1, 0.1, 0.9, ""}, {0.2, 0.3, 0.1, ""}};
    of.where.output_level = {{-1.0, 1.0, 1.0, ""}};
    of.where.rising = 0.5;
    of.where.falling = 0.3;
    of.where.still = 0.2;
    of.base.form = "second_order";
    of.base.model = "1 / (1.23456 s + 1)";
    of.base.in_short = "1 / (1.235 s + 1)";
    of.base.linear_share = 0.75;
    of.base.parameters = {{"gain", 1.5, {{1.25, 1.75}}}};
    of.confidence = 0.875;
    return of;
}

gap::Verdict verdict_of(gap::OfDrive of) {
    return {gap::Outcome::attributed,
            {"simulation", 0.5, 0.1, 0.05},
            {{"backlash", 0.1, 60.0}, {"none", 0.5, -40.0}},
            std::move(of),
            "rest",
            {}};
}

gap::Cause backlash() { return {"backlash", {{"gap", 0.25, {{0.2, 0.3}}}}, 0.5, 0.1, 0.8, 0.875}; }

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

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

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

// --- The page.

gap::Curve ramp(std::size_t samples) {
    gap::Curve curve{"r<a>mp.csv", {}, {}, {}, {}};
    for (std::size_t i = 0; i < samples; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(samples - 1);
        curve.time_s.push_back(10.0 * share);
        curve.measured.push_back(share);
        curve.left_by_base.push_back(0.25 * share);
    }
    return curve;
}

TEST(VerdictPage, DrawsWhatWasMeasuredAndSimulated) {
    gap::OfDrive of = of_drive();
    of.chosen = "none";
    const gap::Verdict verdict = verdict_of(of);
    const std::string page = gap::to_html(verdict, of, {{ramp(5)}});
    // From 64 to 1090 along, from 8 for the highest to 296 for the lowest.
    EXPECT_THAT(
        page,
        HasSubstr(
            "<polyline class=\"measured\" points=\"64.0,296.0 320.5,224.0 577.0,152.0 833.5,80.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(
        page,
        HasSubstr("<polyline class=\"base\" points=\"64.0,296.0 320.5,242.0 577.0,188.0 833.5,134.0 1090.0,80.0 \"/>"));
    EXPECT_THAT(
        page,
        HasSubstr("<polyline class=\"base\" points=\"64.0,136.0 320.5,104.0 577.0,72.0 833.5,40.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, AllOf(HasSubstr("output, r&lt;a&gt;mp.csv"), Not(HasSubstr("class=\"after\"")),
                            Not(HasSubstr("base + "))));
    // Marks of 0 to 1 by fifths, of 0 to 0.25 by twentieths, of 10 s by 2 s; the first says in what.
    for (const char* mark :
         {">0</text>", ">0.2</text>", ">0.8</text>", ">1</text>", ">0 s</text>", ">2</text>", ">10</text>"}) {
        EXPECT_THAT(page, HasSubstr(mark)) << mark;
    }
    EXPECT_THAT(page, AllOf(HasSubstr(">0.15</text>"), Not(HasSubstr(">0.3</text>"))));
    EXPECT_EQ(count_of(page, "<svg class=\"screen\""), 2U);
    EXPECT_EQ(count_of(page, "<svg class=\"phone\""), 2U);
}

// Of a residual that grows like t: the integral of t^2 over each part.
TEST(VerdictPage, ShadesWhereTheSquaresLie) {
    const gap::Curve curve = ramp(6001);
    const std::vector<double> shade = gap::shade_of(curve.left_by_base, curve.time_s);
    ASSERT_EQ(shade.size(), 60U);
    for (std::size_t i = 0; i < 60; ++i) {
        // The integral of t^2 over a part, over that of the last part.
        const auto cube = [](double k) { return k * k * k; };
        const auto k = static_cast<double>(i);
        EXPECT_NEAR(shade[i], (cube(k + 1) - cube(k)) / (cube(60) - cube(59)), 0.012) << i;
    }
    EXPECT_EQ(gap::shade_of({0.0, std::nan(""), 0.0}, {0.0, 1.0, 2.0}), std::vector<double>(60, 0.0));
    gap::OfDrive of = of_drive();
    const std::string page = gap::to_html(verdict_of(of), of, {{curve}});
    EXPECT_THAT(page, HasSubstr("height=\"288.0\" opacity=\"0.30\""));
    EXPECT_THAT(page, Not(HasSubstr("opacity=\"0.00\"")));
}

TEST(VerdictPage, DrawsTheInputAndTheNextRecordInSteps) {
    gap::OfDrive of = of_drive();
    gap::Curve curve = ramp(5);
    curve.input = {0.0, 0.0, 1.0, 1.0, 0.0};
    gap::NextRecord next{"a <step>",
                         {0.0, 1.0, 2.0},
                         {0.0, 1.0, 1.0},
                         {{"backlash", {0.0, 0.5, 1.0}}, {"rate_limit, refitted", {0.0, 0.0, 1.0}}}};
    const std::string page = gap::to_html(verdict_of(of), of, {{curve}, next, "glsum diagnose drive --log <x>"});
    EXPECT_THAT(page,
                HasSubstr("<polyline class=\"input\" points=\"64.0,86.0 320.5,86.0 577.0,86.0 577.0,8.0 833.5,8.0 "
                          "1090.0,8.0 1090.0,86.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("<polyline class=\"input\" points=\"64.0,86.0 577.0,86.0 577.0,8.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("<polyline class=\"after\" points=\"64.0,186.0 577.0,97.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("<polyline class=\"base\" points=\"64.0,186.0 577.0,186.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("output, simulated: a &lt;step&gt;"));
    EXPECT_THAT(page, AllOf(HasSubstr("</i>backlash</span>"), HasSubstr("</i>rate_limit, refitted</span>")));
    EXPECT_THAT(page, HasSubstr("<code>glsum diagnose drive --log &lt;x&gt;</code>"));
    EXPECT_EQ(count_of(page, "<svg class=\"screen\""), 5U);
    EXPECT_THAT(gap::to_html(verdict_of(of), of, {}), Not(HasSubstr("<svg")));
}

TEST(VerdictPage, LeavesOutWhatIsNoNumberAndThinsWhatIsLong) {
    gap::OfDrive of = of_drive();
    gap::Curve curve = ramp(5);
    curve.left_by_chosen = {0.0, std::nan(""), 0.0, 0.0, 0.0};
    std::string page = gap::to_html(verdict_of(of), of, {{curve}});
    EXPECT_THAT(page,
                HasSubstr("<polyline class=\"after\" points=\"64.0,296.0 577.0,152.0 833.5,80.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("base + backlash"));
    // Of 4400 samples every second one.
    page = gap::to_html(verdict_of(of), of, {{ramp(4400)}});
    const std::size_t from = page.find("class=\"measured\" points=\"");
    EXPECT_EQ(count_of(page.substr(from, page.find("\"/>", from) - from), ","), 2200U);
    page = gap::to_html(verdict_of(of), of, {{ramp(4399)}});
    EXPECT_EQ(count_of(page.substr(from, page.find("\"/>", from) - from), ","), 4399U);
    // What never moves is drawn with a span of 1.
    gap::Curve flat = ramp(5);
    flat.measured.assign(5, 3.0);
    flat.left_by_base.assign(5, 0.0);
    EXPECT_THAT(gap::to_html(verdict_of(of), of, {{flat}}),
                HasSubstr("<polyline class=\"measured\" points=\"64.0,296.0 "));
}

TEST(VerdictPage, ListsFourteenCandidatesAndNoneWithTheirBars) {
    gap::OfDrive of = of_drive();
    of.where.rising = 0.625;
    gap::Verdict verdict = verdict_of(of);
    verdict.ranking.clear();
    for (int i = 1; i <= 16; ++i) {
        verdict.ranking.push_back({i == 2 ? "backlash" : "effect-" + std::to_string(i), 0.05 * i, 100.0 - i});
    }
    verdict.ranking.push_back({"none", 0.5, 40.0});
    const std::string page = gap::to_html(verdict, of, {});
    EXPECT_THAT(page, AllOf(HasSubstr("effect-14<"), Not(HasSubstr("effect-15<")), HasSubstr("<td>none</td>")));
    EXPECT_THAT(page,
                HasSubstr("<td>backlash</td><td><span class=\"track\"><span class=\"bar2\" style=\"width:20.0%\">"));
    EXPECT_THAT(
        page,
        HasSubstr(
            "<td>effect-1</td><td><span class=\"track\"><span class=\"bar\" style=\"width:10.0%\"></span></span></td>"
            "<td class=\"n\">0.0500</td><td class=\"n\">59.0</td>"));
    EXPECT_THAT(
        page,
        HasSubstr(
            "<td>effect-14</td><td><span class=\"track\"><span class=\"bar\" style=\"width:100.0%\">"));  // no wider
    EXPECT_THAT(page, AllOf(HasSubstr("style=\"width:62.5%\"></span></span></td><td class=\"n\">62.5 %</td>"),
                            HasSubstr("<td class=\"n\">30.0 %</td>"), HasSubstr("<td class=\"n\">20.0 %</td>"),
                            HasSubstr("<td>0 to 2 s</td>"), HasSubstr("<td class=\"n\">95.0 %</td><td>start</td>")));
    verdict.gap.base = 0.0;
    EXPECT_THAT(gap::to_html(verdict, of, {}),
                HasSubstr("<td>effect-14</td><td><span class=\"track\"><span class=\"bar\" style=\"width:0.0%\">"));
}

TEST(VerdictPage, SaysWhatTheTextSays) {
    gap::OfDrive of = of_drive();
    of.alternatives = {{backlash()}, {backlash()}};
    of.extrapolated = {"input above <1>"};
    of.split = true;
    gap::Verdict verdict = verdict_of(of);
    verdict.notes = {"a \"note\" & more"};
    const std::string page = gap::to_html(verdict, of, {});
    EXPECT_THAT(
        page, AllOf(HasSubstr("<h1>attributed: backlash or backlash</h1>"),
                    HasSubstr("confidence 0.88; gap (simulation) 0.5000 before, 0.1000 after, 0.0500 at best"),
                    HasSubstr("Extrapolated, as training has none of it: input above &lt;1&gt;."),
                    HasSubstr("Judged by parts"), HasSubstr("Note: a &quot;note&quot; &amp; more."),
                    HasSubstr("<p>base: second_order"), HasSubstr("<ul><li>backlash.gap = 0.25  [0.2, 0.3]</li></ul>"),
                    HasSubstr("<h2>Next</h2><p>rest.</p>")));
    of.extrapolated.clear();
    of.split = false;
    EXPECT_THAT(gap::to_html(verdict, of, {}),
                AllOf(Not(HasSubstr("Extrapolated")), Not(HasSubstr("Judged by parts"))));
}

// A label at the picture's right edge ends there: in the middle of its tick, half of it would be cut off.
TEST(VerdictPage, TheLastTimeIsNotCutOff) {
    const gap::PlotOf plot{"output", 300.0, {{"measured", {0.0, 1.0, 2.0}}}};
    const std::string to_a_tick = gap::to_svg(plot, {0.0, 3000.0, 6000.0});
    EXPECT_EQ(count_of(to_a_tick, "text-anchor=\"end\">6000<"), 2U);  // on a screen and on a phone
    EXPECT_THAT(to_a_tick, HasSubstr("text-anchor=\"middle\">0 s<"));
    const std::string beyond = gap::to_svg(plot, {0.0, 3000.0, 7000.0});
    EXPECT_THAT(beyond, HasSubstr("text-anchor=\"middle\">6000<"));
}

}  // namespace
