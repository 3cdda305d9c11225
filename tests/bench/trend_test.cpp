// Counters over several runs: change points, levels, which way was better.
#include "bench/gate/trend.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace bench::gate;
using bench::Json;
using testing::ElementsAre;
using testing::HasSubstr;

const char rules_text[] = R"([[rule]]
layer = "model_cycles"
rows = "gl/*/m7:*"
counters = "model_cycles_per_sample"
better = "lower"
relative = 0.1
level = "fail"
reason = "because"
[[rule]]
layer = "host_time"
rows = "gl/*/host"
counters = "cpu_time"
better = "lower"
relative = 0.05
anchor = "anchor"
level = "fail"
reason = "ratio"
)";

// Cycles of kernel a at three lengths, of b at one, saturations; host times of a beside the anchor's.
bench::NamedResults run(const std::string& name, const std::vector<double>& of_a, double of_b, double saturations,
                        double ns, const char* compiler = "GNU 12.2.0") {
    bench::Results made;
    made.context = {{"compiler", compiler},
                    {"flags", "-O3"},
                    {"n_samples", 100},
                    {"seed", 1},
                    {"cpu", "one"},
                    {"commit", "0123456789ab"},
                    {"date", "2026-11-26T01:02:03"}};
    const auto add = [&](const std::string& kernel, int taps, double cycles) {
        Json row = bench::make_row("gl/" + kernel + "/order:0.5/taps:" + std::to_string(taps) + "/m7:f746", 32);
        row["model_cycles_per_sample"] = cycles;
        made.rows.push_back(row);
    };
    for (std::size_t n = 0; n < of_a.size(); ++n) {
        add("a", 50 * static_cast<int>(n + 1), of_a[n]);
    }
    add("b", 50, of_b);
    Json accuracy = bench::make_row("gl/b/order:0.5/taps:50/accuracy/signal:step", 100);
    accuracy["saturations"] = saturations;
    made.rows.push_back(accuracy);
    for (int i = 0; i < 20; ++i) {
        for (const auto& [kernel, time] :
             {std::pair("a", ns * (1.0 + 0.001 * (i * 7 % 20))), std::pair("anchor", 10.0)}) {
            Json host = bench::make_row(std::string("gl/") + kernel + "/order:0.5/taps:50/host", 100);
            host["repetition_index"] = i;
            host["cpu_time"] = time;
            made.rows.push_back(host);
        }
    }
    return {name, made};
}

Trend trend_of(const std::vector<bench::NamedResults>& runs, const std::vector<std::string>& counters = {"*"}) {
    return trend(runs, parse_rules(rules_text, "rules"), {"*"}, counters);
}

TEST(Trend, FindsWhereACounterChangedAndByHowMuch) {
    const Trend found =
        trend_of({run("one", {100, 200, 300}, 50, 0, 100.0), run("two", {100, 200, 300}, 50, 0, 100.0),
                  run("three", {110, 240, 300}, 50, 3, 100.0), run("four", {99, 240, 300}, 25, 3, 50.0)});
    ASSERT_EQ(found.changes.size(), 5U);
    // Run 3: two lengths of a, and b saturates where it did not. 1.1 and 1.2.
    const Change& cycles = found.changes[0];
    EXPECT_EQ(cycles.run, 2U);
    EXPECT_EQ(cycles.kernel, "a");
    EXPECT_EQ(cycles.counter, "model_cycles_per_sample");
    EXPECT_EQ(cycles.rows, 2U);
    EXPECT_EQ(cycles.of, 3U);
    EXPECT_EQ(cycles.worse, 2U);
    EXPECT_NEAR(std::exp(cycles.log_ratio), std::sqrt(1.1 * 1.2), 1e-12);
    EXPECT_NEAR(std::exp(cycles.lowest), 1.1, 1e-12);
    EXPECT_NEAR(std::exp(cycles.highest), 1.2, 1e-12);
    EXPECT_EQ(found.changes[1].counter, "saturations");
    EXPECT_EQ(found.changes[1].without_ratio, 1U);
    EXPECT_EQ(found.changes[1].log_ratio, 0.0);  // from 0 there is none
    // Run 4: b halves, the host's time does, a falls at one length; the largest first.
    EXPECT_EQ(found.changes[2].run, 3U);
    EXPECT_NEAR(found.changes[2].log_ratio, std::log(0.5), 0.01);
    EXPECT_NEAR(found.changes[3].log_ratio, std::log(0.5), 0.01);
    EXPECT_NEAR(found.changes[4].log_ratio, std::log(0.9), 1e-12);
    EXPECT_EQ(found.changes[4].better, 1U);
    EXPECT_EQ(found.runs[1].changed, 0U);
    EXPECT_EQ(found.runs[2].changed, 3U);
    EXPECT_EQ(found.runs[2].worse, 2U);
    EXPECT_EQ(found.runs[2].better, 0U);  // no rule says which way saturations are better
    EXPECT_EQ(found.runs[3].changed, 3U);
    EXPECT_EQ(found.runs[3].better, 3U);
    EXPECT_EQ(found.runs[0].commit, "012345678");
    EXPECT_EQ(found.runs[0].date, "2026-11-26");
    EXPECT_TRUE(found.incomparable.empty());
}

// All rows that two runs share count in a series' step, those that did not change too: (1.1 1.2 1)^(1/3).
TEST(Trend, LevelsAreOfAllRowsAndCarryOn) {
    const Trend found = trend_of({run("one", {100, 200, 300}, 50, 0, 100.0), run("two", {110, 240, 300}, 50, 0, 100.0),
                                  run("three", {110, 240}, 50, 0, 100.0)},
                                 {"model_cycles*"});
    ASSERT_EQ(found.series.size(), 1U);
    EXPECT_EQ(found.series[0].kernel, "a");
    const double level = std::cbrt(1.1 * 1.2);
    EXPECT_NEAR(found.series[0].level[0], 1.0, 1e-12);
    EXPECT_NEAR(found.series[0].level[1], level, 1e-12);
    EXPECT_NEAR(found.series[0].level[2], level, 1e-12);
    EXPECT_THAT(found.series[0].changed, ElementsAre(false, true, false));
}

// Of two that moved as far the order is that of their names.
TEST(Trend, ChangesAndSeriesThatAreAsLargeStandByName) {
    const Trend found =
        trend_of({run("one", {100}, 50, 0, 100.0), run("two", {200}, 100, 0, 100.0)}, {"model_cycles*"});
    ASSERT_EQ(found.series.size(), 2U);
    EXPECT_EQ(found.series[0].kernel, "a");
    EXPECT_EQ(found.series[1].kernel, "b");
    ASSERT_EQ(found.changes.size(), 2U);
    EXPECT_EQ(found.changes[0].kernel, "a");
    EXPECT_EQ(found.changes[1].kernel, "b");
}

TEST(Trend, HostTimesOfNoMoreThanTheirNoiseDoNotChange) {
    EXPECT_TRUE(trend_of({run("one", {1}, 1, 0, 100.0), run("two", {1}, 1, 0, 100.02)}, {"cpu_time"}).changes.empty());
    EXPECT_EQ(trend_of({run("one", {1}, 1, 0, 100.0), run("two", {1}, 1, 0, 110.0)}, {"cpu_time"}).changes.size(), 1U);
}

TEST(Trend, SaysWhichRunsCannotBeCompared) {
    bench::NamedResults other = run("two", {1}, 1, 0, 100.0);
    other.results.context["n_samples"] = 200;
    const Trend found = trend_of({run("one", {1}, 1, 0, 100.0), other, other});
    ASSERT_EQ(found.incomparable.size(), 1U);
    EXPECT_EQ(found.incomparable[0], "n_samples: 100 in one, 200 in two");
}

TEST(TrendOutput, TableFileAndPictureSayTheSame) {
    const Trend found =
        trend_of({run("one", {100, 200, 300}, 50, 0, 100.0), run("two", {110, 240, 300}, 50, 3, 100.0)});
    const std::string text = to_table(found, 30);
    EXPECT_THAT(
        text,
        HasSubstr(
            "\n    2  two                                  012345678 2026-11-26      45        3       0       2\n"));
    EXPECT_THAT(text, HasSubstr("\n    2  a                          model_cycles_per_sample       +14.9 %      2 of 3 "
                                " worse   (+10 % to +20 %)\n"));
    EXPECT_THAT(text, HasSubstr("saturations                 from/to 0      1 of 1"));
    EXPECT_THAT(to_table(found, 1), HasSubstr("... and 1 more; --json has them all"));
    const auto json = Json::parse(to_json(found));
    EXPECT_EQ(json["schema"], "glsum-trend-1");
    EXPECT_EQ(json["runs"][1]["name"], "two");
    EXPECT_EQ(json["runs"][1]["changed"], 3);
    EXPECT_EQ(json["changes"][0]["run"], 2);
    EXPECT_NEAR(json["changes"][0]["ratio"].get<double>(), std::sqrt(1.32), 1e-12);
    EXPECT_FALSE(json["changes"][1].contains("ratio"));
    EXPECT_EQ(json["series"][0]["change_points"], Json::parse("[2]"));
    EXPECT_NEAR(json["series"][0]["ratio_to_first"][1].get<double>(), std::cbrt(1.32), 1e-12);
    const auto drawn = picture(found);
    ASSERT_TRUE(drawn);
    EXPECT_THAT(drawn->script, HasSubstr("$marks0 << END\n2 1.09"));
    const Trend same = trend_of({run("one", {1}, 1, 0, 100.0), run("two", {1}, 1, 0, 100.0)});
    EXPECT_THAT(to_table(same, 30), HasSubstr("nothing changed"));
    EXPECT_FALSE(picture(same));
}

// A run of rows that a test names itself, one value of the same counter each.
bench::NamedResults named(const char* name, const std::vector<std::pair<std::string, double>>& rows) {
    bench::NamedResults made = run(name, {}, 1, 0, 1.0);
    made.results.rows.clear();
    for (const auto& [row, value] : rows) {
        made.results.rows.push_back(bench::make_row(row, 1));
        made.results.rows.back()["model_cycles_per_sample"] = value;
    }
    return made;
}

std::string model_row(const std::string& kernel, int taps) {
    return "gl/" + kernel + "/order:0.5/taps:" + std::to_string(taps) + "/m7:f746";
}

// Rows that were 0 or became it have no ratio: they count as changed, the mean and the range are of the others.
TEST(Trend, RowsWithoutARatioDoNotBendTheMean) {
    const Trend found = trend_of({named("one", {{model_row("a", 1), 0.0},
                                                {model_row("a", 2), 100.0},
                                                {model_row("a", 3), 5.0},
                                                {model_row("a", 4), 100.0},
                                                {model_row("a", 5), 7.0}}),
                                  named("two", {{model_row("a", 1), 3.0},
                                                {model_row("a", 2), 200.0},
                                                {model_row("a", 3), 0.0},
                                                {model_row("a", 4), 800.0},
                                                {model_row("a", 5), 7.0}})});
    ASSERT_EQ(found.changes.size(), 1U);
    const Change& change = found.changes[0];
    EXPECT_EQ(change.of, 5U);
    EXPECT_EQ(change.rows, 4U);
    EXPECT_EQ(change.without_ratio, 2U);
    EXPECT_EQ(change.worse, 3U);
    EXPECT_EQ(change.better, 1U);
    EXPECT_NEAR(change.log_ratio, std::log(4.0), 1e-12);  // of 2 and 8
    EXPECT_NEAR(change.lowest, std::log(2.0), 1e-12);
    EXPECT_NEAR(change.highest, std::log(8.0), 1e-12);
    // A level is of all five rows.
    EXPECT_NEAR(found.series.at(0).level[1], std::pow(16.0, 0.2), 1e-12);
}

// A row of another program is its own series.
TEST(Trend, ARowOfAnotherProgramStandsByItsName) {
    const Trend found = trend_of({named("one", {{"BM_other/8", 100.0}, {"BM_other/16", 100.0}}),
                                  named("two", {{"BM_other/8", 150.0}, {"BM_other/16", 100.0}})});
    ASSERT_EQ(found.changes.size(), 1U);
    EXPECT_EQ(found.changes[0].kernel, "BM_other/8");
    EXPECT_EQ(found.changes[0].of, 1U);
}

// Where the intervals of host times end at 1 exactly nothing changed.
TEST(Trend, TimesThatAreTheSameToTheBitDoNotChange) {
    const auto still = [](const char* name) {
        bench::NamedResults made = run(name, {1}, 1, 0, 100.0);
        for (bench::Json& row : made.results.rows) {
            if (row.contains("cpu_time")) {
                row["cpu_time"] = 100.0;
            }
        }
        return made;
    };
    EXPECT_TRUE(trend_of({still("one"), still("two")}, {"cpu_time"}).changes.empty());
}

// A fall counts as a rise does, whichever run it was in, and however little it was.
TEST(Trend, TheSeriesThatMovedFurthestIsFirst) {
    const auto first_of = [](const std::vector<double>& of_a, const std::vector<double>& of_b) {
        std::vector<bench::NamedResults> runs;
        for (std::size_t i = 0; i < of_a.size(); ++i) {
            runs.push_back(run(std::to_string(i), {of_a[i]}, of_b[i], 0, 100.0));
        }
        const Trend found = trend_of(runs, {"model_cycles*"});
        EXPECT_EQ(found.series.size(), 2U);
        return found.series.front().kernel;
    };
    EXPECT_EQ(first_of({100, 150}, {100, 50}), "b");
    EXPECT_EQ(first_of({100, 150, 150}, {100, 50, 100}), "b");  // there and back
    EXPECT_EQ(first_of({100, 100.25}, {100, 100.5}), "b");
    EXPECT_EQ(first_of({100, 200}, {100, 150}), "a");
}

// Half as much is more of a change than half as much again.
TEST(Trend, TheLargestChangeOfARunIsFirst) {
    const Trend largest = trend_of({run("one", {100}, 100, 0, 100.0), run("two", {150}, 50, 0, 100.0)}, {"model*"});
    EXPECT_EQ(largest.changes.at(0).kernel, "b");
}

// What a context does not tell, or not in words, stays empty.
TEST(Trend, ARunWithoutCommitAndDateIsShownWithoutThem) {
    bench::NamedResults bare = run("one", {1}, 1, 0, 100.0);
    bare.results.context.erase("commit");
    bare.results.context["date"] = 20261126;
    bench::NamedResults brief = run("two", {1}, 1, 0, 100.0);
    brief.results.context["commit"] = "abc";
    const Trend found = trend_of({bare, brief});
    EXPECT_EQ(found.runs[0].commit, "");
    EXPECT_EQ(found.runs[0].date, "");
    EXPECT_EQ(found.runs[1].commit, "abc");
}

// Made by hand: a change of each verdict, of one row, of several, and without a ratio.
Trend by_hand() {
    Trend made;
    made.runs = {{"first.json", "0123456", "2026-01-02", 40, 0, 0, 0},
                 {"second.json", "89abcde", "2026-02-03", 41, 7, 3, 2}};
    made.changes = {{1, "a", "cycles", 3, 4, std::log(1.25), std::log(0.5), std::log(2.0), 0, 1, 2},
                    {1, "b", "cycles", 1, 1, std::log(0.5), std::log(0.5), std::log(0.5), 0, 1, 0},
                    {1, "c", "cycles", 2, 2, std::log(1.5), std::log(1.5), std::log(1.5), 1, 0, 1},
                    {1, "d", "saturations", 1, 9, 0.0, 0.0, 0.0, 1, 0, 0}};
    made.series = {{"a", "cycles", {1.0, 1.25}, {false, true}}, {"b", "cycles", {1.0, 1.0}, {false, false}}};
    return made;
}

TEST(TrendOutput, TheTableHasTheRunsThenTheChanges) {
    const std::string runs =
        "\n  run  file                                 commit    date          rows  changed  better   worse\n"
        "    1  first.json                           0123456   2026-01-02      40\n"
        "    2  second.json                          89abcde   2026-02-03      41        7       3       2\n";
    const std::string changes =
        "\n  run  kernel                     counter                        change        rows\n"
        "    2  a                          cycles                          +25 %      3 of 4  mixed   (-50 % to +100 "
        "%)\n"
        "    2  b                          cycles                          -50 %      1 of 1  better\n";
    const std::string rest =
        "    2  c                          cycles                          +50 %      2 of 2  worse\n"
        "    2  d                          saturations                 from/to 0      1 of 9\n";
    const std::string legend =
        "\n  change: against the run before, the geometric mean of the rows that changed. Host times change where the\n"
        "  interval of their ratio to the anchor leaves 1 out.\n";
    EXPECT_EQ(to_table(by_hand(), 4), runs + changes + rest + legend);
    EXPECT_EQ(to_table(by_hand(), 5), runs + changes + rest + legend);
    EXPECT_EQ(to_table(by_hand(), 2), runs + changes + "  ... and 2 more; --json has them all\n" + legend);
    Trend still = by_hand();
    still.changes.clear();
    EXPECT_EQ(to_table(still, 4), runs + "\n  nothing changed\n");
}

TEST(TrendOutput, ALargeChangeIsToldInFull) {
    Trend made = by_hand();
    made.changes[1].log_ratio = std::log(57.0);
    EXPECT_THAT(to_table(made, 4), HasSubstr(" +5600 %      1 of 1  better\n"));
}

TEST(TrendOutput, TheFileHoldsEveryField) {
    Trend made = by_hand();
    made.changes.erase(made.changes.begin() + 1);
    made.changes[0].log_ratio = made.changes[1].log_ratio = 0.0;  // e^0 is 1 to the bit
    made.changes[0].lowest = made.changes[0].highest = made.changes[1].lowest = made.changes[1].highest = 0.0;
    EXPECT_EQ(Json::parse(to_json(made)), Json::parse(R"({
        "schema": "glsum-trend-1",
        "runs": [{"name": "first.json", "commit": "0123456", "date": "2026-01-02", "rows": 40, "changed": 0,
                  "better": 0, "worse": 0},
                 {"name": "second.json", "commit": "89abcde", "date": "2026-02-03", "rows": 41, "changed": 7,
                  "better": 3, "worse": 2}],
        "changes": [{"run": 2, "kernel": "a", "counter": "cycles", "rows": 3, "of": 4, "better": 1, "worse": 2,
                     "ratio": 1.0, "ratio_lowest": 1.0, "ratio_highest": 1.0},
                    {"run": 2, "kernel": "c", "counter": "cycles", "rows": 2, "of": 2, "better": 0, "worse": 1,
                     "ratio": 1.0, "ratio_lowest": 1.0, "ratio_highest": 1.0},
                    {"run": 2, "kernel": "d", "counter": "saturations", "rows": 1, "of": 9, "better": 0, "worse": 0}],
        "series": [{"kernel": "a", "counter": "cycles", "ratio_to_first": [1.0, 1.25], "change_points": [2]},
                   {"kernel": "b", "counter": "cycles", "ratio_to_first": [1.0, 1.0], "change_points": []}]
    })"));
    // A blank a level, one line at the end.
    EXPECT_TRUE(to_json(made).starts_with("{\n \"schema\""));
    EXPECT_TRUE(to_json(made).ends_with("}\n"));
    // A range from less to more.
    const Json change = Json::parse(to_json(by_hand())).at("changes").at(0);
    EXPECT_NEAR(change.at("ratio").get<double>(), 1.25, 1e-12);
    EXPECT_NEAR(change.at("ratio_lowest").get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(change.at("ratio_highest").get<double>(), 2.0, 1e-12);
}

// A line and its change points for each of the eight series that moved furthest.
TEST(TrendOutput, ThePictureHasALineAndItsMarksForEachSeries) {
    const auto drawn = picture(by_hand());
    ASSERT_TRUE(drawn);
    const std::string& script = drawn->script;
    EXPECT_THAT(script, HasSubstr("\nset xrange [0.8:2.2]\n"));
    EXPECT_THAT(script, HasSubstr("$line0 << END\n1 1\n2 1.25\nEND\n$marks0 << END\n2 1.25\nEND\n"
                                  "$line1 << END\n1 1\n2 1\nEND\n$marks1 << END\nEND\nplot $line0 "));
    EXPECT_THAT(script, HasSubstr("lc rgb \"#0072B2\" title \"a cycles\", $marks0 using 1:2"));
    EXPECT_THAT(script, HasSubstr(", $line1 using 1:2 with lines lw 2 lc rgb \"#D55E00\" title \"b cycles\""));
    EXPECT_TRUE(script.ends_with("notitle\n"));
    Trend many = by_hand();
    many.series.assign(8, by_hand().series[0]);
    many.series.push_back({"ninth", "cycles", {1.0, 2.0}, {false, true}});
    const auto eight = picture(many);
    ASSERT_TRUE(eight);
    EXPECT_THAT(eight->script, HasSubstr("$line7 using"));
    EXPECT_THAT(eight->script, testing::Not(HasSubstr("ninth")));
}

}  // namespace
