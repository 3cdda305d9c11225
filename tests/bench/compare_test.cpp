// Two runs side by side, as JSON: read back field by field.
#include "bench/gate/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace bench::gate;
using bench::Json;
using bench::Results;

const char rules_text[] = R"([[rule]]
layer = "accuracy"
rows = "gl/*/accuracy/*"
counters = "error_max"
better = "lower"
relative = 0.1
level = "fail"
reason = "because"
[[rule]]
layer = "accuracy"
rows = "gl/*/accuracy/*"
counters = "effective_taps"
better = "higher"
absolute = 0
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

Results run(double error, double taps, double ns, const char* compiler, const std::string& own) {
    Results made;
    made.context = {{"compiler", compiler}, {"flags", "-O3"}, {"n_samples", 100}, {"seed", 1}, {"cpu", "one"}};
    Json row = bench::make_row("gl/a/order:0.5/taps:50/accuracy/signal:step", 100);
    row["error_max"] = error;
    row["effective_taps"] = taps;
    row["saturations"] = 0;
    made.rows.push_back(row);
    Json wrong = bench::make_row("gl/b/order:0.5/taps:50/accuracy/signal:step", 100);
    bench::mark_error(wrong, "wrong");
    made.rows.push_back(wrong);
    made.rows.push_back(bench::make_row("gl/" + own + "/order:0.5/taps:50/accuracy/signal:step", 100));
    for (int i = 0; i < 20; ++i) {
        for (const auto& [kernel, time] : {std::pair("a", ns), std::pair("anchor", 10.0)}) {
            Json host = bench::make_row(std::string("gl/") + kernel + "/order:0.5/taps:50/host", 100);
            host["repetition_index"] = i;
            host["cpu_time"] = time * (1.0 + 0.0001 * (i * 7 % 20));
            made.rows.push_back(host);
        }
    }
    return made;
}

TEST(CompareJson, HoldsEveryPairWithItsRatioAndWhichWayIsBetter) {
    const Results a = run(1e-3, 50.0, 100.0, "GNU 12.2.0", "only_here");
    const Results b = run(1.5e-3, 60.0, 80.0, "GNU 14.2.0", "only_there");
    const Json json = Json::parse(to_json(compare(a, b, parse_rules(rules_text, "rules"), {"*"}, {"*"})));
    EXPECT_EQ(json.at("schema"), "glsum-compare-1");
    ASSERT_EQ(json.at("conditions").size(), 1U) << json.at("conditions").dump();
    EXPECT_EQ(json.at("conditions")[0].at("field"), "compiler");
    EXPECT_EQ(json.at("conditions")[0].at("a"), "GNU 12.2.0");
    EXPECT_EQ(json.at("conditions")[0].at("b"), "GNU 14.2.0");
    EXPECT_TRUE(json.at("conditions")[0].at("comparable").is_boolean());
    EXPECT_EQ(json.at("only_a"), Json::parse(R"(["gl/only_here/order:0.5/taps:50/accuracy/signal:step"])"));
    EXPECT_EQ(json.at("only_b"), Json::parse(R"(["gl/only_there/order:0.5/taps:50/accuracy/signal:step"])"));
    EXPECT_EQ(json.at("wrong"), Json::parse(R"(["gl/b/order:0.5/taps:50/accuracy/signal:step"])"));
    std::map<std::string, Json> pairs;
    for (const Json& pair : json.at("pairs")) {
        if (pair.at("row").get<std::string>().starts_with("gl/a/")) {
            pairs[pair.at("counter").get<std::string>()] = pair;
        }
    }
    const Json& error = pairs.at("error_max");
    EXPECT_EQ(error.at("row"), "gl/a/order:0.5/taps:50/accuracy/signal:step");
    EXPECT_EQ(error.at("a"), 1e-3);
    EXPECT_EQ(error.at("b"), 1.5e-3);
    EXPECT_NEAR(error.at("ratio").get<double>(), 1.5, 1e-12);
    EXPECT_EQ(error.at("change"), "worse");
    EXPECT_FALSE(error.contains("ratio_low"));
    EXPECT_EQ(pairs.at("effective_taps").at("change"), "better");
    EXPECT_NEAR(pairs.at("effective_taps").at("ratio").get<double>(), 1.2, 1e-12);
    // Of a 0 there is no ratio, and where nothing changed no way.
    EXPECT_FALSE(pairs.at("saturations").contains("ratio"));
    EXPECT_FALSE(pairs.at("saturations").contains("change"));
    // Times by their ratio to the anchor's, with an interval.
    const Json& time = pairs.at("cpu_time");
    EXPECT_NEAR(time.at("ratio").get<double>(), 0.8, 0.01);
    EXPECT_LE(time.at("ratio_low").get<double>(), time.at("ratio").get<double>());
    EXPECT_GE(time.at("ratio_high").get<double>(), time.at("ratio").get<double>());
    EXPECT_GT(time.at("ratio_low").get<double>(), 0.75);
    EXPECT_LT(time.at("ratio_high").get<double>(), 0.85);
    EXPECT_EQ(time.at("change"), "better");
    // Both medians of twenty: 1.00095 times the fastest.
    EXPECT_NEAR(time.at("a").get<double>(), 100.095, 1e-9);
    EXPECT_NEAR(time.at("b").get<double>(), 80.076, 1e-9);
}

// What has to stay the same is worse whichever way it goes.
TEST(CompareJson, WhatShallBeEqualIsWorseBothWays) {
    const std::string rules =
        std::string(rules_text) +
        "[[rule]]\nlayer = \"accuracy\"\nrows = \"gl/*/accuracy/*\"\ncounters = "
        "\"saturations\"\nbetter = \"equal\"\nabsolute = 0\nlevel = \"fail\"\nreason = \"because\"\n";
    const auto change_of = [&](double before, double after) {
        const auto with = [](double saturations) {
            Results made = run(1e-3, 50.0, 100.0, "GNU 12.2.0", "own");
            made.rows.front()["saturations"] = saturations;
            return made;
        };
        const Json json =
            Json::parse(to_json(compare(with(before), with(after), parse_rules(rules, "rules"), {"*"}, {"*"})));
        for (const Json& pair : json.at("pairs")) {
            if (pair.at("counter") == "saturations") {
                return pair.value("change", "none");
            }
        }
        return std::string("not compared");
    };
    EXPECT_EQ(change_of(2.0, 3.0), "worse");
    EXPECT_EQ(change_of(3.0, 2.0), "worse");
    EXPECT_EQ(change_of(3.0, 3.0), "none");
}

// Of single times nobody judges; what counts instructions does, though it be called the same.
TEST(CompareJson, OfTimesOnlyThoseOfTheProcessorArePaired) {
    const auto with = [](double value) {
        Results made = run(1e-3, 50.0, 100.0, "GNU 12.2.0", "own");
        Json count = bench::make_row("gl/a/order:0.5/taps:50/m7:count", 32);
        count["instructions_per_sample"] = value;
        made.rows.push_back(count);
        for (Json& row : made.rows) {
            row["ns_per_sample"] = value;
        }
        return made;
    };
    const Json json =
        Json::parse(to_json(compare(with(300.0), with(330.0), parse_rules(rules_text, "rules"), {"*"}, {"*"})));
    std::size_t counted = 0;
    for (const Json& pair : json.at("pairs")) {
        const bool host = pair.at("row").get<std::string>().ends_with("/host");
        EXPECT_EQ(host, pair.at("counter") == "cpu_time") << pair;
        counted += pair.at("counter") == "instructions_per_sample" ? 1 : 0;
    }
    EXPECT_EQ(counted, 1U);
}

// What the terminal shows: the conditions that differ, a line for each counter, the largest changes first, and what one
// run alone has.
TEST(CompareTable, SumsEachCounterAndNamesTheLargestChanges) {
    Comparison comparison;
    comparison.differences = {{"seed", "1", "2", Effect::incomparable}, {"cpu", "one", "two", Effect::advisory}};
    const auto add = [&](const char* row, const char* counter, double a, double b, int better) {
        Pair pair;
        pair.row = row;
        pair.counter = counter;
        pair.a = a;
        pair.b = b;
        pair.log_ratio = pair.low = pair.high = std::log(b / a);
        pair.better = better;
        comparison.pairs.push_back(pair);
    };
    add("one", "bytes", 8.0, 16.0, -1);
    add("two", "bytes", 16.0, 2.0, 1);
    add("three", "bytes", 5.0, 5.0, 0);
    add("four", "cycles", 10.0, 40.0, -1);
    comparison.pairs.back().to_anchor = true;
    comparison.pairs.back().low = std::log(3.0);
    comparison.pairs.back().high = std::log(5.0);
    comparison.only_a = {"gone", "gone too"};
    comparison.wrong = {"bad"};
    // Of 2, 1/8 and 1 the mean is 4^(-1/3) = 0.63, the deviation 2^sqrt(10/3 - 4/9) = 3.248.
    const std::string whole =
        "  seed: 1 in A, 2 in B: not comparable\n"
        "  cpu: one in A, two in B\n"
        "\n  counter                       rows  better   worse  geometric mean geometric sd\n"
        "  bytes                            3       1       1           x0.63       x3.248\n"
        "  cycles                           1       0       1              x4           x1\n"
        "\n  largest changes, B over A (2 of 3)\n"
        "  two bytes: 16 -> 2, x0.125 better\n"
        "  four cycles: 10 -> 40, x4 (x3 to x5 of the anchor) worse\n"
        "\n  2 rows only in A: gone, ...\n"
        "\n  1 rows wrong in A or B, not compared: bad\n";
    EXPECT_EQ(to_table(comparison, 2), whole);
    EXPECT_NE(to_table(comparison, 3).find("(3 of 3)"), std::string::npos);
    EXPECT_NE(to_table(comparison, 4).find("(3 of 3)"), std::string::npos);
    EXPECT_NE(to_table(comparison, 4).find("one bytes: 8 -> 16, x2 worse\n"), std::string::npos);
    EXPECT_EQ(to_table(Comparison{}, 9).find("largest"), std::string::npos);
}

// A run of the host times of kernels, repetition by repetition.
Results run_of_times(const std::map<std::string, std::vector<double>>& kernels) {
    Results made = run(1e-3, 50.0, 100.0, "GNU 12.2.0", "own");
    made.rows.clear();
    for (const auto& [kernel, times] : kernels) {
        for (std::size_t i = 0; i < times.size(); ++i) {
            Json host = bench::make_row("gl/" + kernel + "/order:0.5/taps:50/host", 100);
            host["repetition_index"] = i;
            host["cpu_time"] = times[i];
            made.rows.push_back(host);
        }
    }
    return made;
}

Pair pair_of_times(const std::map<std::string, std::vector<double>>& a,
                   const std::map<std::string, std::vector<double>>& b, const std::string& kernel = "a") {
    for (const Pair& pair :
         compare(run_of_times(a), run_of_times(b), parse_rules(rules_text, "rules"), {"*"}, {"*"}).pairs) {
        if (pair.row == "gl/" + kernel + "/order:0.5/taps:50/host") {
            return pair;
        }
    }
    ADD_FAILURE() << kernel;
    return {};
}

// The middle of an odd number of repetitions, the mean of the middle two of an even one.
TEST(CompareTimes, AreMediansOfTheirRepetitions) {
    const Pair odd = pair_of_times({{"a", {30.0, 10.0, 24.0}}}, {{"a", {12.0}}});
    EXPECT_EQ(odd.a, 24.0);
    EXPECT_EQ(odd.b, 12.0);
    EXPECT_NEAR(odd.log_ratio, std::log(0.5), 1e-15);
    EXPECT_EQ(odd.better, 0);  // nobody judges single times
    const Pair even = pair_of_times({{"a", {50.0, 10.0, 30.0, 20.0}}}, {{"a", {6.0, 2.0}}});
    EXPECT_EQ(even.a, 25.0);
    EXPECT_EQ(even.b, 4.0);
}

// Twenty repetitions of the kernel and of the anchor in both runs, each longer than nothing.
TEST(CompareTimes, AreHeldToTheAnchorWhereEnoughWereRepeated) {
    using Times = std::vector<double>;
    const auto is_held = [](const Times& a, const Times& anchor_a, const Times& b, const Times& anchor_b) {
        return pair_of_times({{"a", a}, {"anchor", anchor_a}}, {{"a", b}, {"anchor", anchor_b}}).to_anchor;
    };
    const Times enough(20, 100.0);
    const Times few(19, 100.0);
    Times nothing = enough;
    nothing[4] = 0.0;
    EXPECT_TRUE(is_held(enough, enough, enough, enough));
    for (const Times& other : {few, nothing}) {
        EXPECT_FALSE(is_held(other, enough, enough, enough));
        EXPECT_FALSE(is_held(enough, other, enough, enough));
        EXPECT_FALSE(is_held(enough, enough, other, enough));
        EXPECT_FALSE(is_held(enough, enough, enough, other));
    }
    EXPECT_FALSE(pair_of_times({{"a", enough}}, {{"a", enough}, {"anchor", enough}}).to_anchor);
    EXPECT_FALSE(pair_of_times({{"a", enough}, {"anchor", enough}}, {{"a", enough}}).to_anchor);
    // An anchor to itself would never change.
    EXPECT_FALSE(pair_of_times({{"anchor", enough}}, {{"anchor", enough}}, "anchor").to_anchor);
}

// The interval decides, and one that ends at no change at all decides nothing.
TEST(CompareTimes, AreBetterOrWorseWhereTheIntervalLeavesOneOut) {
    const std::vector<double> anchor(20, 10.0);
    for (const auto& [now, better] : {std::pair(90.0, 1), std::pair(100.0, 0), std::pair(110.0, -1)}) {
        const Pair pair = pair_of_times({{"a", std::vector<double>(20, 100.0)}, {"anchor", anchor}},
                                        {{"a", std::vector<double>(20, now)}, {"anchor", anchor}});
        EXPECT_EQ(pair.better, better);
        EXPECT_NEAR(pair.log_ratio, std::log(now / 100.0), 1e-12);
        EXPECT_NEAR(pair.low, pair.log_ratio, 1e-12);
        EXPECT_NEAR(pair.high, pair.log_ratio, 1e-12);
    }
}

// From 0 or to 0 there is no ratio, but a better and a worse.
TEST(Compare, OfNothingThereIsNoRatio) {
    const auto pair_of_errors = [](double before, double after) {
        const Comparison found =
            compare(run(before, 50.0, 100.0, "GNU 12.2.0", "own"), run(after, 50.0, 100.0, "GNU 12.2.0", "own"),
                    parse_rules(rules_text, "rules"), {"gl/a/*"}, {"error_max"});
        EXPECT_EQ(found.pairs.size(), 1U);
        EXPECT_FALSE(Json::parse(to_json(found)).at("pairs").at(0).contains("ratio"));
        return found.pairs.at(0);
    };
    const Pair from = pair_of_errors(0.0, 3.0);
    EXPECT_EQ(from.log_ratio, 0.0);
    EXPECT_EQ(from.low, 0.0);
    EXPECT_EQ(from.high, 0.0);
    EXPECT_EQ(from.better, -1);
    const Pair to = pair_of_errors(3.0, 0.0);
    EXPECT_EQ(to.log_ratio, 0.0);
    EXPECT_EQ(to.better, 1);
}

// A row that is wrong in one of them is not compared; globs choose rows and counters.
TEST(Compare, ComparesWhatIsRightInBothAndAskedFor) {
    const Rules rules = parse_rules(rules_text, "rules");
    const Results good = run(1e-3, 50.0, 100.0, "GNU 12.2.0", "only_here");
    Results bad = run(1e-3, 50.0, 100.0, "GNU 12.2.0", "only_there");
    bench::mark_error(bad.rows.front(), "wrong");
    const auto name = bad.rows.front().at("name").get<std::string>();
    for (const bool first : {true, false}) {
        const Comparison found = compare(first ? bad : good, first ? good : bad, rules, {"gl/a/*"}, {"*"});
        EXPECT_EQ(found.wrong, std::vector<std::string>{name}) << first;
        EXPECT_TRUE(found.only_a.empty()) << first;
        EXPECT_TRUE(found.only_b.empty()) << first;
        for (const Pair& pair : found.pairs) {
            EXPECT_EQ(pair.row, "gl/a/order:0.5/taps:50/host") << first;
        }
    }
    const Comparison errors = compare(good, good, rules, {"*"}, {"error_*"});
    ASSERT_EQ(errors.pairs.size(), 1U);
    EXPECT_EQ(errors.pairs[0].counter, "error_max");
    EXPECT_EQ(errors.pairs[0].better, 0);
}

TEST(Compare, WhatIsNoNumberInOneOfThemIsNotCompared) {
    const Rules rules = parse_rules(rules_text, "rules");
    const Results good = run(1e-3, 50.0, 100.0, "GNU 12.2.0", "only_here");
    Results text = good;
    text.rows.front()["error_max"] = "small";
    EXPECT_TRUE(compare(good, text, rules, {"*"}, {"error_*"}).pairs.empty());
    EXPECT_TRUE(compare(text, good, rules, {"*"}, {"error_*"}).pairs.empty());
    text.rows.front().erase("error_max");
    EXPECT_TRUE(compare(good, text, rules, {"*"}, {"error_*"}).pairs.empty());
}

}  // namespace
