// The gate where its decisions turn: at the limits of its rules, of its witnesses and of repetitions.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/failure.hpp"
#include "bench/gate/baseline.hpp"
#include "bench/gate/gate.hpp"
#include "bench/gate/host_time.hpp"
#include "tests/bench/gate_rig.hpp"
#include "tests/refusal.hpp"

namespace {

using namespace test;
using glsum::Exit;

constexpr char anchor_time_row[] = "gl/peer_std_f32/order:0.5/taps:50/host";

// A run whose times do not scatter: kernel a's as given, all others 100 ns.
Results steady_run(double time_of_a) {
    Results made = run();
    for (Json& row : made.rows) {
        if (row.contains("cpu_time")) {
            row["cpu_time"] = row["name"] == time_row ? time_of_a : 100.0;
        }
    }
    return made;
}

Rules rules_of_times(double relative) {
    Rules of_times = rules();
    of_times.back().relative = relative;
    return of_times;
}

// What is allowed exactly is allowed, and no improvement: only beyond it is a time another one.
TEST(GateEdges, ATimeMustBeBeyondWhatIsAllowed) {
    const auto change_to = [](double time) {
        const std::vector<double> hundred(40, 100.0);
        return time_change({hundred, hundred}, {std::vector<double>(40, time), hundred}, 0.99);
    };
    const double slower = change_to(125.0).low;
    EXPECT_NEAR(slower, 0.25, 1e-12);
    EXPECT_TRUE(judge(steady_run(100.0), steady_run(125.0), rules_of_times(slower)).findings.empty());
    const Verdict failed = judge(steady_run(100.0), steady_run(125.0), rules_of_times(0.249));
    ASSERT_EQ(failed.findings.size(), 1U);
    EXPECT_EQ(failed.findings[0].level, Level::fail);
    EXPECT_EQ(failed.findings[0].what, "+25.0 % (+25.0 to +25.0 %) of the time of peer_std_f32");
    const double faster = -change_to(75.0).high;
    EXPECT_NEAR(faster, 0.25, 1e-12);
    EXPECT_TRUE(judge(steady_run(100.0), steady_run(75.0), rules_of_times(faster)).findings.empty());
    const Verdict better = judge(steady_run(100.0), steady_run(75.0), rules_of_times(0.249));
    ASSERT_EQ(better.findings.size(), 1U);
    EXPECT_EQ(better.findings[0].level, Level::improvement);
    EXPECT_EQ(better.findings[0].what, "-25.0 % (-25.0 to -25.0 %) of the time of peer_std_f32");
}

TEST(GateEdges, ARuleOfTimesThatOnlyWarnsWarns) {
    Rules warning = rules();
    warning.back().fails = false;
    const Verdict verdict = judge(steady_run(100.0), steady_run(200.0), warning);
    EXPECT_EQ(verdict.status, Exit::good);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].level, Level::warn);
    EXPECT_EQ(verdict.count(Layer::host_time).warned, 1U);
}

// Twenty repetitions, each longer than nothing, of the kernel and of the anchor.
TEST(GateEdges, TwentyRepetitionsAreEnough) {
    const auto with = [](int repetitions) {
        Results made = run();
        std::erase_if(made.rows, [&](const Json& row) { return row["repetition_index"].get<int>() >= repetitions; });
        return made;
    };
    EXPECT_EQ(judge(run(), with(20), rules()).count(Layer::host_time).compared, 2U);
    EXPECT_EQ(judge(run(), with(19), rules()).count(Layer::host_time).not_judged, 2U);
    EXPECT_EQ(judge(with(19), run(), rules()).count(Layer::host_time).not_judged, 2U);
    Results stopped = run();
    for (Json& row : stopped.rows) {
        if (row["name"] == time_row && row["repetition_index"] == 3) {
            row["cpu_time"] = 0.0;
        }
    }
    const Verdict verdict = judge(run(), stopped, rules());
    EXPECT_EQ(verdict.count(Layer::host_time).not_judged, 1U);
    EXPECT_EQ(verdict.count(Layer::host_time).compared, 1U);
}

TEST(GateEdges, AWrongAnchorIsNone) {
    Results current = run();
    change(current, anchor_time_row, [](Json& row) { bench::mark_error(row, "other bits"); });
    const Verdict verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.count(Layer::host_time).not_judged, 2U);
    EXPECT_EQ(verdict.not_judged, "2 host times, no row of the anchor");
}

// Each reason why times are not judged is told, with how many it holds for.
TEST(GateEdges, EachReasonNotToJudgeIsTold) {
    const auto at_another_length = [](Results made) {
        change(made, time_row, [](Json& row) { row["name"] = row["run_name"] = "gl/a/order:0.5/taps:60/host"; });
        return made;
    };
    Results current = at_another_length(run());
    std::erase_if(current.rows, [](const Json& row) {
        return row["name"] == "gl/b/order:0.5/taps:50/host" && row["repetition_index"].get<int>() >= 10;
    });
    EXPECT_EQ(judge(at_another_length(run()), current, rules()).not_judged,
              "1 host times, fewer than 20 repetitions; measure with bench --repetitions; "
              "1 host times, no row of the anchor");
}

// That is told, unless it was never meant to have any.
TEST(GateEdges, ABaselineWithoutTimesJudgesNone) {
    Results without = run();
    drop(without, [](const std::string& name) { return name.ends_with("/host"); });
    EXPECT_EQ(judge(without, run(), rules()).not_judged, "host times, of which the baseline has none");
    EXPECT_EQ(judge(without, without, rules()).not_judged, "");
    without.context["baseline_rows"] = Json::array({"*/m7:*", "*/accuracy/*"});
    EXPECT_EQ(judge(without, run(), rules()).not_judged, "");
}

// A run beside code that is not ours: its kernels, where they stand and how much slower they are than kernel a was.
Results beside_witnesses(const std::vector<std::pair<std::string, double>>& witnesses, double time_of_a) {
    Results made = steady_run(time_of_a);
    for (const auto& [name, slower] : witnesses) {
        for (int i = 0; i < 40; ++i) {
            Json row = bench::make_row(name, 1000);
            row["repetition_index"] = i;
            row["cpu_time"] = 100.0 * slower;
            made.rows.push_back(row);
        }
    }
    return made;
}

// Half of what is allowed to kernels, 2.5 % of 5 %, is what a witness may move.
TEST(GateEdges, AWitnessMayMoveByHalfOfWhatIsAllowed) {
    Rules with_witness = rules();
    with_witness.back().witnesses = {"peer_*"};
    const std::string one = "gl/peer_one_f32/order:0.5/taps:50/host";
    const std::string two = "gl/peer_two_f32/order:0.5/taps:50/host";
    const auto judged = [&](double slower) {
        return judge(beside_witnesses({{one, 1.0}}, 100.0), beside_witnesses({{one, slower}}, 110.0), with_witness);
    };
    EXPECT_EQ(judged(1.0249).status, Exit::check_failed);
    EXPECT_EQ(judged(1.0 / 1.0249).status, Exit::check_failed);
    EXPECT_EQ(judged(1.0251).status, Exit::good);
    EXPECT_EQ(judged(1.0 / 1.0251).status, Exit::good);
    // The one that moved most is named.
    for (const auto& [of_one, of_two] : {std::pair(1.3, 1.1), std::pair(1.1, 1.3)}) {
        const Verdict verdict = judge(beside_witnesses({{one, 1.0}, {two, 1.0}}, 100.0),
                                      beside_witnesses({{one, of_one}, {two, of_two}}, 110.0), with_witness);
        EXPECT_EQ(verdict.not_judged,
                  std::string("2 host times, ") + (of_one > of_two ? "peer_one_f32" : "peer_two_f32") +
                      ", whose code is not ours, moved by 30 % against peer_std_f32: one of the runs shared its core");
    }
    // One of another length says nothing of this one.
    const std::string longer = "gl/peer_one_f32/order:0.5/taps:100/host";
    EXPECT_EQ(
        judge(beside_witnesses({{longer, 1.0}}, 100.0), beside_witnesses({{longer, 1.3}}, 110.0), with_witness).status,
        Exit::check_failed);
}

// What was and what is, in numbers and as a share, where there is one.
TEST(GateEdges, AChangeIsToldInNumbersAndAsAShare) {
    const auto what_of = [](double then, double now) {
        Results before = run();
        Results after = run();
        change(before, count_row, [&](Json& row) { row["code_bytes"] = then; });
        change(after, count_row, [&](Json& row) { row["code_bytes"] = now; });
        const Verdict verdict = judge(before, after, rules());
        EXPECT_EQ(verdict.findings.size(), 1U);
        return verdict.findings.at(0);
    };
    EXPECT_EQ(what_of(400.0, 450.0).what, "400 -> 450 (+12.5 %)");
    EXPECT_EQ(what_of(400.0, 300.0).what, "400 -> 300 (-25 %)");
    EXPECT_EQ(what_of(8.0, 456.0).what, "8 -> 456 (+5600 %)");
    const Finding from_nothing = what_of(0.0, 8.0);
    EXPECT_EQ(from_nothing.what, "0 -> 8");
    EXPECT_FALSE(from_nothing.change);
    EXPECT_EQ(from_nothing.level, Level::fail);
}

// A counter of a rule that only warns, and that is there no more.
TEST(GateEdges, AMissingCounterIsAsBadAsItsRuleSays) {
    Results current = run();
    change(current, accuracy_row, [](Json& row) { row.erase("effective_taps"); });
    const Verdict verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.status, Exit::good);
    ASSERT_EQ(verdict.findings.size(), 1U);
    EXPECT_EQ(verdict.findings[0].level, Level::warn);
    EXPECT_EQ(verdict.findings[0].what, "the counter is missing; 50 in the baseline");
    EXPECT_EQ(verdict.findings[0].reason, "memory");
    EXPECT_FALSE(verdict.findings[0].current);
    EXPECT_EQ(verdict.count(Layer::accuracy).compared, 4U);
}

// Of two rules that fail the first that speaks of the counter decides.
TEST(GateEdges, TheFirstRuleOfALevelDecides) {
    Rules twice = rules();
    Rule lenient = twice[2];
    lenient.counters = {"code_bytes"};
    lenient.relative = 0.5;
    twice.insert(twice.begin() + 2, lenient);
    Results current = run();
    scale(current, count_row, "code_bytes", 1.25);
    EXPECT_TRUE(judge(run(), current, twice).findings.empty());
    EXPECT_EQ(judge(run(), current, rules()).status, Exit::check_failed);
}

// What was wrong before is no value to compare with.
TEST(GateEdges, ValuesOfARowThatWasWrongAreNotCompared) {
    Results wrong = run();
    change(wrong, count_row, [](Json& row) { bench::mark_error(row, "other bits"); });
    const Verdict verdict = judge(wrong, run(), rules());
    EXPECT_EQ(verdict.count(Layer::instructions_and_bytes).compared, 3U);
    EXPECT_EQ(verdict.count(Layer::instructions_and_bytes).moot, 0U);
    EXPECT_EQ(verdict.count(Layer::answer).compared, 9U);
}

// By layer, failures first; else as the baseline has them.
TEST(GateEdges, FindingsStandByLayerThenByLevelThenInOrder) {
    Results current = run();
    const std::string accuracy_of_b = "gl/b/order:0.5/taps:50/accuracy/signal:step";
    const std::string count_of_b = "gl/b/order:0.5/taps:50/m7:count";
    scale(current, accuracy_row, "effective_taps", 0.5);
    scale(current, accuracy_of_b, "error_max", 2.0);
    scale(current, count_row, "code_bytes", 2.0);
    scale(current, count_of_b, "code_bytes", 2.0);
    std::vector<std::pair<Level, std::string>> found;
    for (const Finding& finding : judge(run(), current, rules()).findings) {
        found.emplace_back(finding.level, finding.row);
    }
    const std::vector<std::pair<Level, std::string>> expected = {
        {Level::fail, accuracy_of_b}, {Level::warn, accuracy_row}, {Level::fail, count_row}, {Level::fail, count_of_b}};
    EXPECT_EQ(found, expected);
}

// A row of another program is no kernel: it is lost, or new, by its own name.
TEST(GateEdges, ARowOfAnotherProgramIsLostOrNewByItsName) {
    Results more = run();
    more.rows.push_back(bench::make_row("BM_other/8", 1));
    const Verdict lost = judge(more, run(), rules());
    EXPECT_EQ(lost.status, Exit::check_failed);
    EXPECT_EQ(lost.headline(), "rows: BM_other/8: the row is missing");
    EXPECT_EQ(lost.count(Layer::rows).compared, 10U);
    EXPECT_EQ(lost.count(Layer::rows).failed, 1U);
    const Verdict added = judge(run(), more, rules());
    EXPECT_EQ(added.status, Exit::good);
    ASSERT_EQ(added.findings.size(), 1U);
    EXPECT_EQ(added.findings[0].row, "BM_other/8");
    EXPECT_EQ(added.findings[0].what, "a new row, not in the baseline");
    // Where no rule speaks, a lost row fails all the same.
    Results alone;
    alone.rows.push_back(bench::make_row("BM_other/8", 1));
    EXPECT_EQ(judge(alone, {}, rules()).status, Exit::check_failed);
}

TEST(GateEdges, ASelectionIsTheGlobsOfItsBaseline) {
    EXPECT_EQ(selection_of(Json::object()), std::vector<std::string>{"*"});
    EXPECT_EQ(selection_of(Json::parse(R"({"baseline_rows": ["a*", 3, "b"]})")), (std::vector<std::string>{"a*", "b"}));
    EXPECT_TRUE(selection_of(Json::parse(R"({"baseline_rows": []})")).empty());
}

// Of a host's row what tells repetitions and their times, of others every counter; of a context what is a condition.
TEST(BaselineEdges, KeepsWhatIsComparedAndNoMore) {
    Results current = run();
    change(current, time_row, [](Json& row) {
        row["real_time"] = 1.5;
        row["cycles_per_sample"] = 7.0;
    });
    const std::vector<std::string> left_out = {"host_name",   "executable",          "num_cpus",
                                               "mhz_per_cpu", "cpu_scaling_enabled", "caches",
                                               "load_avg",    "elf_sha256",          "m4_elf_sha256"};
    for (const std::string& field : left_out) {
        current.context[field] = "of this machine";
    }
    const Results baseline = make_baseline(current, {time_row, count_row}, Json::object(), "why", "what");
    ASSERT_EQ(baseline.rows.size(), 41U);  // forty repetitions before the one of the target
    EXPECT_EQ(baseline.rows[0].at("name"), time_row);
    EXPECT_EQ(baseline.rows[0].at("repetition_index"), 0);
    EXPECT_EQ(baseline.rows[39].at("repetition_index"), 39);
    EXPECT_EQ(baseline.rows[0].at("real_time"), 1.5);
    EXPECT_EQ(baseline.rows[0].at("cpu_time"), 100.0);
    EXPECT_EQ(baseline.rows[0].at("run_type"), "iteration");
    EXPECT_EQ(baseline.rows[0].at("iterations"), 1000);
    EXPECT_FALSE(baseline.rows[0].contains("cycles_per_sample"));
    EXPECT_FALSE(baseline.rows[0].contains("run_name"));
    EXPECT_EQ(baseline.rows[40].at("name"), count_row);
    EXPECT_EQ(baseline.rows[40].at("instructions_per_sample"), 315);
    EXPECT_EQ(baseline.rows[40].at("loads_per_sample"), 100);
    EXPECT_EQ(baseline.rows[40].at("code_bytes"), 400);
    EXPECT_FALSE(baseline.rows[40].contains("run_type"));
    for (const std::string& field : left_out) {
        EXPECT_FALSE(baseline.context.contains(field)) << field;
    }
    EXPECT_EQ(baseline.context.at("cpu"), "one");
    EXPECT_EQ(baseline.context.at("baseline_rows"), Json::array({time_row, count_row}));
}

TEST(BaselineEdges, ItsHistoryBeginsWithWhyItWasMade) {
    Results current = run();
    current.context.erase("commit");
    const Results baseline = make_baseline(current, {count_row}, Json::object(), "why", "what");
    ASSERT_EQ(baseline.context.at("history").size(), 1U);
    const Json& first = baseline.context.at("history")[0];
    EXPECT_EQ(first.at("commit"), "unknown");
    EXPECT_EQ(first.at("reason"), "why");
    EXPECT_EQ(first.at("changed"), "what");
    const auto date = first.at("date").get<std::string>();  // 2026-01-31
    ASSERT_EQ(date.size(), 10U);
    EXPECT_EQ(date[4], '-');
    EXPECT_EQ(date[7], '-');
}

TEST(BaselineEdges, ARefusalSaysHowManyRowsAreWrong) {
    Results wrong = run();
    change(wrong, count_row, [](Json& row) { bench::mark_error(row, "other bits"); });
    change(wrong, time_row, [](Json& row) { bench::mark_error(row, "other bits"); });
    EXPECT_EQ(
        refusal(Exit::check_failed, [&] { (void)make_baseline(wrong, {"gl/a/*"}, Json::object(), "why", "what"); }),
        "2 of 4 rows are wrong: such a run is no baseline");
    EXPECT_EQ(refusal(Exit::bad_input,
                      [&] {
                          (void)make_baseline(wrong, {"no", "none"}, Json::object(), "why", "what");
                      }),
              "no row matches no, none: a baseline must hold some");
}

}  // namespace
