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
    // Run 4: b halves, the host's time does, a falls at one length; the largest first.
    EXPECT_EQ(found.changes[2].run, 3U);
    EXPECT_NEAR(found.changes[2].log_ratio, std::log(0.5), 0.01);
    EXPECT_NEAR(found.changes[3].log_ratio, std::log(0.5), 0.01);
    EXPECT_NEAR(found.changes[4].log_ratio, std::log(0.9), 1e-12);
    EXPECT_EQ(found.changes[4].better, 1U);
    EXPECT_EQ(found.runs[1].changed, 0U);
    EXPECT_EQ(found.runs[2].changed, 3U);
    EXPECT_EQ(found.runs[2].worse, 2U);
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
TEST(Trend, SeriesThatMovedAsFarStandByName) {
    const Trend found =
        trend_of({run("one", {100}, 50, 0, 100.0), run("two", {200}, 100, 0, 100.0)}, {"model_cycles*"});
    ASSERT_EQ(found.series.size(), 2U);
    EXPECT_EQ(found.series[0].kernel, "a");
    EXPECT_EQ(found.series[1].kernel, "b");
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

}  // namespace
