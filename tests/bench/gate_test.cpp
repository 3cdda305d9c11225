// The gate: each kind of change is found, named by its layer, and told from the others; and what is no change is
// passed.
#include "bench/gate/gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "base/failure.hpp"
#include "bench/gate/baseline.hpp"
#include "bench/gate/outputs.hpp"

namespace {

using namespace bench::gate;
using bench::Json;
using bench::Results;
using glsum::Exit;
using testing::HasSubstr;
using testing::Not;

const Rules& rules() {
    static const Rules rules = parse_rules(R"(
[[rule]]
layer = "accuracy"
rows = "gl/*/accuracy/*"
counters = "error_max"
better = "lower"
relative = 0.001
level = "fail"
reason = "exact"
[[rule]]
layer = "accuracy"
rows = "gl/*/accuracy/*"
counters = "effective_taps"
better = "higher"
absolute = 0
level = "warn"
reason = "memory"
[[rule]]
layer = "instructions_and_bytes"
rows = "gl/*/m7:*"
counters = ["instructions_per_sample", "*_bytes"]
better = "lower"
absolute = 0
level = "fail"
reason = "exact"
[[rule]]
layer = "instructions_and_bytes"
rows = "gl/*/m7:*"
counters = "loads_per_sample"
better = "lower"
relative = 0.5
level = "fail"
reason = "far too many"
[[rule]]
layer = "instructions_and_bytes"
rows = "gl/*/m7:*"
counters = "loads_per_sample"
better = "lower"
relative = 0.1
level = "warn"
reason = "many"
[[rule]]
layer = "model_cycles"
rows = "gl/*/m7:*"
counters = "model_cycles_per_sample"
better = "lower"
absolute = 0
level = "fail"
reason = "exact"
[[rule]]
layer = "host_time"
rows = "gl/*/host"
counters = "cpu_time"
better = "lower"
relative = 0.05
anchor = "peer_std_f32"
level = "fail"
reason = "ratio"
)",
                                           "rules");
    return rules;
}

constexpr char accuracy_row[] = "gl/a/order:0.5/taps:50/accuracy/signal:step";
constexpr char count_row[] = "gl/a/order:0.5/taps:50/m7:count";
constexpr char model_row[] = "gl/a/order:0.5/taps:50/m7:stm32f746-itcm";
constexpr char time_row[] = "gl/a/order:0.5/taps:50/host";

Results run() {
    Results run;
    run.context = {{"compiler", "GNU 12.2.0"},
                   {"flags", "-O3"},
                   {"contraction", "off"},
                   {"n_samples", 1000},
                   {"seed", 2020},
                   {"target_compiler", "GNU 12.2.1"},
                   {"core_file", "f746"},
                   {"core_file_sha256", "1"},
                   {"cpu", "one"},
                   {"commit", "c0ffee"}};
    for (const std::string kernel : {"a", "b"}) {
        const std::string line = "gl/" + kernel + "/order:0.5/taps:50/";
        Json accuracy = bench::make_row(line + "accuracy/signal:step", 1000);
        accuracy["error_max"] = 1e-5;
        accuracy["effective_taps"] = 50;
        Json count = bench::make_row(line + "m7:count", 32);
        count["instructions_per_sample"] = 315;
        count["loads_per_sample"] = 100;
        count["code_bytes"] = 400;
        Json model = bench::make_row(line + "m7:stm32f746-itcm", 32);
        model["model_cycles_per_sample"] = 500.25;
        for (const Json& row : {accuracy, count, model}) {
            run.rows.push_back(row);
        }
    }
    for (const auto& [kernel, ns] : {std::pair("a", 100.0), std::pair("b", 50.0), std::pair("peer_std_f32", 20.0)}) {
        for (int i = 0; i < 40; ++i) {
            Json time = bench::make_row(std::string("gl/") + kernel + "/order:0.5/taps:50/host", 1000);
            time["repetition_index"] = i;
            time["cpu_time"] = ns * (1.0 + 0.0001 * (i * 17 % 40));
            run.rows.push_back(time);
        }
    }
    return run;
}

void change(Results& results, const std::string& name, const std::function<void(Json&)>& how) {
    bool found = false;
    for (Json& row : results.rows) {
        if (row["name"] == name) {
            how(row);
            found = true;
        }
    }
    ASSERT_TRUE(found) << name;
}

void scale(Results& results, const std::string& name, const std::string& counter, double factor) {
    change(results, name, [&](Json& row) { row[counter] = row[counter].get<double>() * factor; });
}

void drop(Results& results, const std::function<bool(const std::string&)>& which) {
    std::erase_if(results.rows, [&](const Json& row) { return which(row["name"].get<std::string>()); });
}

const Finding* find(const Verdict& verdict, Level level) {
    for (const Finding& finding : verdict.findings) {
        if (finding.level == level) {
            return &finding;
        }
    }
    return nullptr;
}

TEST(Gate, PassesWhatIsTheSame) {
    const Verdict verdict = judge(run(), run(), rules());
    EXPECT_EQ(verdict.status, Exit::good);
    EXPECT_TRUE(verdict.findings.empty()) << to_table(verdict, false);
    EXPECT_EQ(verdict.count(Layer::rows).compared, 9u);
    EXPECT_EQ(verdict.count(Layer::answer).compared, 9u);
    EXPECT_EQ(verdict.count(Layer::accuracy).compared, 4u);
    EXPECT_EQ(verdict.count(Layer::instructions_and_bytes).compared, 6u);
    EXPECT_EQ(verdict.count(Layer::model_cycles).compared, 2u);
    EXPECT_EQ(verdict.count(Layer::host_time).compared, 2u);
}

// The counter that gets worse, by how much, and where that is found.
struct Regression {
    const char* row;
    const char* counter;
    double factor;
    Layer layer;
    Level level;
};

TEST(Gate, FindsWhatGetsWorse) {
    for (const Regression& test :
         {Regression{accuracy_row, "error_max", 1.01, Layer::accuracy, Level::fail},
          Regression{accuracy_row, "effective_taps", 0.98, Layer::accuracy, Level::warn},
          Regression{count_row, "instructions_per_sample", 316.0 / 315.0, Layer::instructions_and_bytes, Level::fail},
          Regression{count_row, "code_bytes", 1.01, Layer::instructions_and_bytes, Level::fail},
          Regression{count_row, "loads_per_sample", 1.2, Layer::instructions_and_bytes, Level::warn},
          Regression{count_row, "loads_per_sample", 1.6, Layer::instructions_and_bytes, Level::fail},
          Regression{model_row, "model_cycles_per_sample", 1.0005, Layer::model_cycles, Level::fail},
          Regression{time_row, "cpu_time", 1.1, Layer::host_time, Level::fail}}) {
        Results current = run();
        scale(current, test.row, test.counter, test.factor);
        const Verdict verdict = judge(run(), current, rules());
        EXPECT_EQ(verdict.status, test.level == Level::fail ? Exit::check_failed : Exit::good) << test.counter;
        ASSERT_EQ(verdict.findings.size(), 1u) << test.counter << to_table(verdict, false);
        const Finding& finding = verdict.findings.front();
        EXPECT_EQ(finding.level, test.level) << test.counter;
        EXPECT_EQ(finding.layer, test.layer);
        EXPECT_EQ(finding.row, test.row);
        EXPECT_EQ(finding.counter, test.counter);
        EXPECT_NEAR(finding.change.value(), test.factor - 1.0, 1e-9);
        EXPECT_FALSE(finding.reason.empty());
        const LayerCount& count = verdict.count(test.layer);
        EXPECT_EQ(count.failed, test.level == Level::fail ? 1u : 0u) << test.counter;
        EXPECT_EQ(count.warned, test.level == Level::warn ? 1u : 0u) << test.counter;
        EXPECT_EQ(count.better, 0u) << test.counter;
        if (test.layer != Layer::host_time) {
            EXPECT_NEAR(finding.current.value() / finding.baseline.value(), test.factor, 1e-9) << test.counter;
        } else {
            EXPECT_LE(finding.change_low.value(), finding.change.value());
            EXPECT_GE(finding.change_high.value(), finding.change.value());
        }
        // The other way round it is an improvement, and no reason to fail.
        const Verdict back = judge(current, run(), rules());
        EXPECT_EQ(back.status, Exit::good);
        ASSERT_EQ(back.findings.size(), 1u) << test.counter << to_table(back, false);
        EXPECT_EQ(back.findings.front().level, Level::improvement) << test.counter;
        EXPECT_EQ(back.count(test.layer).better, 1u) << test.counter;
        EXPECT_EQ(back.count(test.layer).failed + back.count(test.layer).warned, 0u) << test.counter;
    }
}

TEST(Gate, AllowsWhatTheRulesAllow) {
    Results current = run();
    scale(current, accuracy_row, "error_max", 1.0009);
    scale(current, count_row, "loads_per_sample", 1.05);
    scale(current, time_row, "cpu_time", 1.03);
    for (Json& row : current.rows) {
        row["iterations"] = 7;
        row["real_time"] = 1e9;  // nobody's rule
    }
    EXPECT_TRUE(judge(run(), current, rules()).findings.empty());
}

TEST(Gate, TellsALostKernelFromALostRowAndALostCounter) {
    Results current = run();
    drop(current, [](const std::string& name) { return name.starts_with("gl/a/"); });
    Verdict verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.status, Exit::check_failed);
    ASSERT_EQ(verdict.with(Level::fail), 1u);
    EXPECT_EQ(verdict.headline(), "rows: gl/a/*: the kernel is lost: all 4 of its rows are missing");

    current = run();
    drop(current, [](const std::string& name) { return name == count_row; });
    verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.status, Exit::check_failed);
    EXPECT_EQ(verdict.headline(), std::string("rows: ") + count_row + ": the row is missing");

    current = run();
    change(current, count_row, [](Json& row) { row.erase("instructions_per_sample"); });
    verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.status, Exit::check_failed);
    EXPECT_THAT(verdict.headline(), HasSubstr("instructions_per_sample: the counter is missing"));

    current.rows.clear();
    EXPECT_EQ(judge(run(), current, rules()).status, Exit::check_failed);
}

TEST(Gate, ReportsNewRowsAndPasses) {
    Results baseline = run();
    drop(baseline, [](const std::string& name) { return name.starts_with("gl/b/") || name == model_row; });
    const Verdict verdict = judge(baseline, run(), rules());
    EXPECT_EQ(verdict.status, Exit::good);
    ASSERT_EQ(verdict.findings.size(), 2u);
    EXPECT_EQ(verdict.findings[0].row, model_row);
    EXPECT_EQ(verdict.findings[1].row, "gl/b/*");
    EXPECT_THAT(verdict.findings[1].what, HasSubstr("4 rows"));
}

TEST(Gate, NamesTheEarliestLayerFirst) {
    Results current = run();
    scale(current, time_row, "cpu_time", 2.0);
    scale(current, model_row, "model_cycles_per_sample", 2.0);
    scale(current, count_row, "instructions_per_sample", 2.0);
    scale(current, accuracy_row, "error_max", 2.0);
    const Verdict verdict = judge(run(), current, rules());
    ASSERT_EQ(verdict.findings.size(), 4u);
    EXPECT_THAT(verdict.headline(), HasSubstr("accuracy: "));
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_LT(verdict.findings[i - 1].layer, verdict.findings[i].layer);
    }
}

TEST(Gate, AWrongAnswerMakesTheLaterLayersOfItsKernelMoot) {
    Results current = run();
    change(current, count_row, [](Json& row) { bench::mark_error(row, "other bits"); });
    scale(current, accuracy_row, "error_max", 2.0);
    scale(current, model_row, "model_cycles_per_sample", 2.0);
    scale(current, "gl/b/order:0.5/taps:50/m7:count", "instructions_per_sample", 2.0);
    const Verdict verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.status, Exit::check_failed);
    EXPECT_EQ(verdict.headline(), std::string("right_answer: ") + count_row + ": other bits");
    EXPECT_EQ(verdict.with(Level::fail), 2u) << to_table(verdict, false);  // that, and the other kernel's instructions
    EXPECT_EQ(verdict.count(Layer::accuracy).moot, 2u);
    EXPECT_EQ(verdict.count(Layer::model_cycles).moot, 1u);
    EXPECT_EQ(verdict.count(Layer::host_time).moot, 1u);
    // One repetition suffices, and Google Benchmark's newer word.
    current = run();
    for (Json& row : current.rows) {
        if (row["name"] == time_row && row["repetition_index"] == 7) {
            row["skipped"] = "ERROR";
        }
    }
    EXPECT_THAT(judge(run(), current, rules()).headline(), HasSubstr("right_answer: gl/a/order:0.5/taps:50/host"));
}

TEST(Gate, OtherConditionsAreNotComparable) {
    for (const char* field :
         {"compiler", "flags", "contraction", "n_samples", "seed", "weights", "target_compiler", "target_flags",
          "target_count_order", "placement", "core_file", "core_file_sha256", "schema"}) {
        Results current = run();
        current.context[field] = "another";
        scale(current, accuracy_row, "error_max", 2.0);
        const Verdict verdict = judge(run(), current, rules());
        EXPECT_EQ(verdict.status, Exit::not_comparable) << field;
        EXPECT_THAT(verdict.headline(), HasSubstr(std::string(field) + ": "));
        EXPECT_THAT(verdict.headline(), HasSubstr(" in the baseline, another now"));
        EXPECT_TRUE(verdict.findings.empty());
    }
    Results current = run();
    current.context["weights"] = "gl";  // what files are of that do not say
    EXPECT_EQ(judge(run(), current, rules()).status, Exit::good);
    EXPECT_EQ(judge(current, run(), rules()).status, Exit::good);
    current.context["weights"] = "bdf2";
    EXPECT_EQ(judge(run(), current, rules()).headline(), "weights: gl in the baseline, bdf2 now");
    current = run();
    current.context.erase("compiler");
    EXPECT_EQ(judge(run(), current, rules()).headline(), "compiler: GNU 12.2.0 in the baseline, (absent) now");
}

TEST(Gate, OfCoresThatOnlyOneRunModelledTheFileDoesNotMatter) {
    Results baseline = run();
    Results current = run();
    baseline.context["core_file"] = "f746 sha256:1, h747 sha256:2";
    current.context["core_file"] = "m7-ideal sha256:3, f746 sha256:1";
    EXPECT_EQ(judge(baseline, current, rules()).status, Exit::good);
    current.context["core_file"] = "m7-ideal sha256:3, f746 sha256:9";
    const Verdict verdict = judge(baseline, current, rules());
    EXPECT_EQ(verdict.status, Exit::not_comparable);
    EXPECT_EQ(verdict.headline(), "core_file: f746 sha256:1 in the baseline, f746 sha256:9 now");
    current.context["core_file"] = "none";
    EXPECT_EQ(judge(baseline, current, rules()).status, Exit::not_comparable);
    baseline.context["core_file"] = "a-core sha256:1, f746 sha256:2";  // told apart by their whole names
    current.context["core_file"] = "b-core sha256:9, f746 sha256:2";
    EXPECT_EQ(judge(baseline, current, rules()).status, Exit::good);
}

// A run of the same kernels on the M4 beside the M7, or alone, as `bench --targets` writes it.
Results run_on(const std::vector<std::string>& targets) {
    Results results = run();
    const auto wanted = [&](const std::string& target) {
        return std::find(targets.begin(), targets.end(), target) != targets.end();
    };
    std::vector<Json> of_m4;
    for (const Json& row : results.rows) {
        std::string name = row["name"];
        if (const std::size_t at = name.find("/m7:"); at != name.npos) {
            name.replace(at, 4, "/m4:");
            const std::size_t core = name.find("stm32f746-itcm");
            name = core == name.npos ? name : name.substr(0, core) + "cortex-m4-zerowait";
            Json other = row;
            other["name"] = other["run_name"] = name;
            of_m4.push_back(other);
        }
    }
    results.rows.insert(results.rows.end(), of_m4.begin(), of_m4.end());
    drop(results, [&](const std::string& name) {
        return (name.find("/m7:") != name.npos && !wanted("m7")) || (name.find("/m4:") != name.npos && !wanted("m4")) ||
               (name.ends_with("/host") && !wanted("host"));
    });
    std::string cores;
    for (const auto& [target, flags, core] : {std::tuple("m7", "-mcpu=cortex-m7", "stm32f746-itcm sha256:7"),
                                              std::tuple("m4", "-mcpu=cortex-m4", "cortex-m4-zerowait sha256:4")}) {
        if (wanted(target)) {
            const std::string whose = cores.empty() ? "" : std::string(target) + "_";
            results.context[whose + "target_compiler"] = "GNU 12.2.1";
            results.context[whose + "target_flags"] = flags;
            cores += std::string(cores.empty() ? "" : ", ") + core;
        }
    }
    results.context["core_file"] = cores.empty() ? "none" : cores;
    results.context.erase("core_file_sha256");
    results.context["sweep"] = {{"targets", targets}};
    return results;
}

Rules rules_of_both() {
    Rules both = rules();
    for (Rule& rule : both) {
        for (std::string& glob : rule.rows) {
            glob = glob == "gl/*/m7:*" ? "gl/*/m*:*" : glob;
        }
    }
    return both;
}

constexpr char m4_count_row[] = "gl/a/order:0.5/taps:50/m4:count";

TEST(Gate, OfTwoRunsTheTargetsThatBothHaveAreJudged) {
    const std::vector<std::vector<std::string>> runs{{"m7"}, {"m4"}, {"host"}, {"m7", "m4"}, {"host", "m7", "m4"}};
    for (const std::vector<std::string>& before : runs) {
        for (const std::vector<std::string>& after : runs) {
            const auto both_have = [&](const char* target) {
                return std::find(before.begin(), before.end(), target) != before.end() &&
                       std::find(after.begin(), after.end(), target) != after.end();
            };
            const std::string which = testing::PrintToString(before) + " against " + testing::PrintToString(after);
            const Verdict same = judge(run_on(before), run_on(after), rules_of_both());
            EXPECT_EQ(same.status, Exit::good) << which << to_table(same, false);
            EXPECT_GE(same.count(Layer::accuracy).compared, 4u) << which;  // every run has it
            EXPECT_TRUE(same.findings.empty()) << which;
            EXPECT_EQ(same.not_judged.empty(), before == after) << which << same.not_judged;
            for (const auto& [target, row] :
                 {std::pair("m7", std::string(count_row)), std::pair("m4", std::string(m4_count_row))}) {
                if (both_have(target)) {
                    Results worse = run_on(after);
                    scale(worse, row, "instructions_per_sample", 316.0 / 315.0);
                    const Verdict verdict = judge(run_on(before), worse, rules_of_both());
                    EXPECT_EQ(verdict.status, Exit::check_failed) << which;
                    EXPECT_THAT(verdict.headline(), HasSubstr(row)) << which;
                }
            }
        }
    }
}

TEST(Gate, SaysFirstWhichTargetsWereNotJudged) {
    const auto first_line = [](const std::vector<std::string>& before, const std::vector<std::string>& after) {
        const std::string table = to_table(judge(run_on(before), run_on(after), rules_of_both()), false);
        return table.substr(0, table.find('\n'));
    };
    EXPECT_THAT(first_line({"m7"}, {"m7", "m4"}),
                testing::EndsWith("; not judged: 4 rows of m4, of which the baseline has none"));
    EXPECT_THAT(first_line({"m7", "m4"}, {"m4"}),
                testing::EndsWith("; not judged: 4 rows of m7, which this run was not asked for"));
    EXPECT_THAT(first_line({"host", "m7"}, {"m7", "m4"}),
                testing::EndsWith("; not judged: 4 rows of m4, of which the baseline has none; "
                                  "3 rows of host, which this run was not asked for"));
    Results of_targets = run_on({"m7", "m4"});
    drop(of_targets, [](const std::string& name) { return name.find("/accuracy/") != name.npos; });
    const Verdict none = judge(of_targets, run_on({"host"}), rules_of_both());
    EXPECT_EQ(none.status, Exit::not_comparable);
    EXPECT_EQ(none.headline(), "targets: m4, m7 in the baseline, host now");
    EXPECT_THAT(to_table(none, false), Not(HasSubstr("not judged")));
    const Verdict verdict = judge(run_on({"m7"}), run_on({"m7", "m4"}), rules_of_both());
    EXPECT_THAT(to_markdown(verdict), HasSubstr("not judged: 4 rows of m4"));
    EXPECT_THAT(to_junit(verdict), HasSubstr("not judged: 4 rows of m4"));
    EXPECT_THAT(to_junit(verdict), Not(HasSubstr("/m4:")));
}

TEST(Gate, RowsOfATargetThatWasAskedForAreLost) {
    Results current = run_on({"m7", "m4"});
    drop(current, [](const std::string& name) { return name.find("/m4:") != name.npos; });
    EXPECT_EQ(judge(run_on({"m7", "m4"}), current, rules_of_both()).with(Level::fail), 4u);
    current.context.erase("sweep");  // a file that does not say what it was asked for
    EXPECT_EQ(judge(run_on({"m7", "m4"}), current, rules_of_both()).with(Level::fail), 4u);
    current.context["sweep"] = {{"targets", {"m7"}}};
    EXPECT_EQ(judge(run_on({"m7", "m4"}), current, rules_of_both()).status, Exit::good);
    // Accuracy is of every run, whatever targets it was asked for.
    drop(current, [](const std::string& name) { return name.find("/accuracy/") != name.npos; });
    EXPECT_EQ(judge(run_on({"m7"}), current, rules_of_both()).with(Level::fail), 2u);
}

TEST(Gate, WhatBelongsToATargetIsComparedForThatTarget) {
    const auto headline = [](const std::vector<std::string>& before, const std::vector<std::string>& after,
                             const std::string& key, const std::string& value) {
        Results current = run_on(after);
        current.context[key] = value;
        const Verdict verdict = judge(run_on(before), current, rules_of_both());
        return verdict.status == Exit::not_comparable ? verdict.headline() : verdict.word();
    };
    const std::vector<std::string> both{"m7", "m4"};
    for (const std::string field : {"target_compiler", "target_flags"}) {
        const std::string m7 = field == "target_flags" ? "-mcpu=cortex-m7" : "GNU 12.2.1";
        const std::string m4 = field == "target_flags" ? "-mcpu=cortex-m4" : "GNU 12.2.1";
        EXPECT_EQ(headline({"m7"}, both, field, "another"), field + ": " + m7 + " in the baseline, another now");
        EXPECT_EQ(headline({"m7"}, both, "m4_" + field, "another"), "pass");
        EXPECT_EQ(headline({"m4"}, both, field, "another"), "pass");
        EXPECT_EQ(headline({"m4"}, both, "m4_" + field, "another"),
                  "m4_" + field + ": " + m4 + " in the baseline, another now");
        EXPECT_EQ(headline(both, {"m4"}, field, "another"),
                  "m4_" + field + ": " + m4 + " in the baseline, another now");
    }
    const auto of_core_file = [&](const std::vector<std::string>& before, const std::string& value) {
        return headline(before, both, "core_file", value);
    };
    EXPECT_EQ(of_core_file({"m7"}, "stm32f746-itcm sha256:7, cortex-m4-zerowait sha256:9"), "pass");
    EXPECT_EQ(of_core_file({"m4"}, "stm32f746-itcm sha256:9, cortex-m4-zerowait sha256:4"), "pass");
    EXPECT_EQ(of_core_file({"m4"}, "stm32f746-itcm sha256:7, cortex-m4-zerowait sha256:9"),
              "core_file: cortex-m4-zerowait sha256:4 in the baseline, cortex-m4-zerowait sha256:9 now");
    EXPECT_EQ(of_core_file(both, "stm32f746-itcm sha256:9, cortex-m4-zerowait sha256:4"),
              "core_file: stm32f746-itcm sha256:7 in the baseline, stm32f746-itcm sha256:9 now");
    // A baseline that kept the M4's rows of a run on both.
    Results selected = run_on(both);
    selected.context["baseline_rows"] = {"gl/*/m4:*"};
    drop(selected, [](const std::string& name) { return name.find("/m4:") == name.npos; });
    Results current = run_on(both);
    current.context["core_file"] = "stm32f746-itcm sha256:9, cortex-m4-zerowait sha256:4";
    current.context["target_compiler"] = "another";
    EXPECT_EQ(judge(selected, current, rules_of_both()).status, Exit::good);
    current.context["m4_target_compiler"] = "another";
    EXPECT_EQ(judge(selected, current, rules_of_both()).status, Exit::not_comparable);
}

TEST(Gate, AWrongRowSaysWhy) {
    const auto headline = [](const std::function<void(Json&)>& how) {
        Results current = run();
        change(current, count_row, how);
        return judge(run(), current, rules()).headline();
    };
    const std::string row = std::string("right_answer: ") + count_row + ": ";
    EXPECT_EQ(headline([](Json& one) { one["error_occurred"] = true; }), row + "marked as wrong");
    EXPECT_EQ(headline([](Json& one) {
                  one["error_occurred"] = true;
                  one["error_message"] = 7;
              }),
              row + "marked as wrong");
    EXPECT_EQ(headline([](Json& one) { bench::mark_error(one, "other bits"); }), row + "other bits");
    Results good = run();
    change(good, count_row, [](Json& one) { one["error_occurred"] = false; });
    EXPECT_EQ(judge(run(), good, rules()).status, Exit::good);
    // What is right now and was wrong is an improvement.
    Results wrong = run();
    change(wrong, count_row, [](Json& one) { bench::mark_error(one, "other bits"); });
    const Verdict back = judge(wrong, run(), rules());
    EXPECT_EQ(back.status, Exit::good);
    ASSERT_EQ(back.findings.size(), 1u);
    EXPECT_EQ(back.findings[0].level, Level::improvement);
    EXPECT_EQ(back.findings[0].what, "right now; wrong in the baseline");
    EXPECT_EQ(judge(wrong, wrong, rules()).headline(), row + "other bits (in the baseline too)");
}

TEST(Gate, ConditionsOfRowsThatAreNotThereDoNotMatter) {
    const auto without_target = [](Results results) {
        drop(results, [](const std::string& name) { return name.find("/m7:") != std::string::npos; });
        return results;
    };
    Results current = without_target(run());
    current.context["target_compiler"] = current.context["core_file"] = "another";
    EXPECT_EQ(judge(without_target(run()), current, rules()).status, Exit::good);
    current = run();
    for (const char* field : {"commit", "dirty", "date", "elf_sha256", "glsum_version", "qemu_version"}) {
        current.context[field] = "another";
    }
    EXPECT_EQ(judge(run(), current, rules()).status, Exit::good);
}

TEST(Gate, OnAnotherProcessorTimesOnlyWarnAndCountsDecide) {
    for (const char* field : {"cpu", "simd", "cycle_counter", "peer_flags"}) {
        Results current = run();
        current.context[field] = "another";
        scale(current, time_row, "cpu_time", 1.5);
        Verdict verdict = judge(run(), current, rules());
        EXPECT_EQ(verdict.status, Exit::good) << field;
        ASSERT_NE(find(verdict, Level::warn), nullptr);
        EXPECT_EQ(find(verdict, Level::warn)->layer, Layer::host_time);
        scale(current, count_row, "instructions_per_sample", 1.5);
        EXPECT_EQ(judge(run(), current, rules()).status, Exit::check_failed) << field;
    }
}

TEST(Gate, JudgesTimesOnlyAgainstTheAnchor) {
    Results current = run();
    for (Json& row : current.rows) {
        if (row["name"].get<std::string>().ends_with("/host")) {
            row["cpu_time"] = 3.0 * row["cpu_time"].get<double>();  // the whole machine
        }
    }
    EXPECT_TRUE(judge(run(), current, rules()).findings.empty());
    drop(current, [](const std::string& name) { return name.find("peer_std") != std::string::npos; });
    Results baseline = run();
    drop(baseline, [](const std::string& name) { return name.find("peer_std") != std::string::npos; });
    Verdict verdict = judge(baseline, current, rules());
    EXPECT_EQ(verdict.count(Layer::host_time).not_judged, 2u);
    EXPECT_THAT(find(verdict, Level::note)->what, HasSubstr("2 rows not judged: no row of the anchor"));
    current = run();
    std::erase_if(current.rows, [](const Json& row) { return row["repetition_index"].get<int>() > 10; });
    verdict = judge(run(), current, rules());
    EXPECT_THAT(find(verdict, Level::note)->what, HasSubstr("fewer than 20 repetitions"));
}

// A neighbour on the same core slows what fills it and leaves the rest: code that is not ours tells so.
TEST(Gate, DoesNotJudgeTimesWhereAWitnessMoved) {
    Rules with_witness = rules();
    with_witness.back().witnesses = {"peer_*"};
    const auto with_peer = [](double slower) {
        Results results = run();
        Results more = run();
        std::erase_if(more.rows, [](const Json& row) { return row["name"] != time_row; });
        for (Json& row : more.rows) {
            row["name"] = row["run_name"] = "gl/peer_eigen_f32/order:0.5/taps:50/host";
            row["cpu_time"] = slower * row["cpu_time"].get<double>();
            results.rows.push_back(row);
        }
        return results;
    };
    Results current = with_peer(1.0);
    scale(current, time_row, "cpu_time", 1.1);
    EXPECT_EQ(judge(with_peer(1.0), current, with_witness).status, Exit::check_failed);
    for (const double slower : {1.3, 0.8}) {
        current = with_peer(slower);
        scale(current, time_row, "cpu_time", 1.1);
        const Verdict verdict = judge(with_peer(1.0), current, with_witness);
        EXPECT_EQ(verdict.status, Exit::good);
        EXPECT_EQ(verdict.count(Layer::host_time).not_judged, 2u);
        EXPECT_THAT(find(verdict, Level::note)->what, HasSubstr("peer_eigen_f32, whose code is not ours, moved by"));
    }
}

TEST(Gate, WithoutARuleThatSpeaksIsRefused) {
    Results other;
    other.rows.push_back(bench::make_row("something", 1));
    EXPECT_THROW((void)judge(other, other, rules()), glsum::Failure);
    EXPECT_THROW((void)judge({}, {}, rules()), glsum::Failure);
}

// Every value that a rule speaks of, one after the other: no regression slips through.
TEST(Gate, CatchesEachValueOfAllRows) {
    const Results baseline = run();
    std::size_t tried = 0;
    for (std::size_t r = 0; r < baseline.rows.size(); ++r) {
        for (const auto& [counter, factor] :
             {std::pair("error_max", 1.01), std::pair("instructions_per_sample", 316.0 / 315.0),
              std::pair("code_bytes", 1.0025), std::pair("model_cycles_per_sample", 1.002)}) {
            if (baseline.rows[r].contains(counter)) {
                Results current = baseline;
                current.rows[r][counter] = factor * current.rows[r][counter].get<double>();
                const Verdict verdict = judge(baseline, current, rules());
                EXPECT_EQ(verdict.with(Level::fail), 1u) << baseline.rows[r]["name"] << counter;
                ++tried;
            }
        }
    }
    EXPECT_EQ(tried, 8u);
}

TEST(GateBaseline, KeepsItsSelectionAndTheHistory) {
    Json previous = {{"history", Json::array({{{"reason", "first"}}})}};
    const Results baseline = make_baseline(run(), {"*/m7:*", "*/host"}, previous, "a faster loop", "2 better");
    EXPECT_EQ(baseline.rows.size(), 4u + 3u * 40u);
    EXPECT_EQ(baseline.context["history"].size(), 2u);
    EXPECT_EQ(baseline.context["history"][1]["reason"], "a faster loop");
    EXPECT_EQ(baseline.context["history"][1]["changed"], "2 better");
    EXPECT_EQ(baseline.context["history"][1]["commit"], "c0ffee");
    EXPECT_EQ(baseline.context["compiler"], "GNU 12.2.0");
    EXPECT_TRUE(std::is_sorted(baseline.rows.begin(), baseline.rows.end(), [](const Json& a, const Json& b) {
        return a["name"].get<std::string>() < b["name"].get<std::string>();
    }));
    // Rows outside the selection are no news, and the rest is as it was.
    const Verdict verdict = judge(baseline, run(), rules());
    EXPECT_TRUE(verdict.findings.empty()) << to_table(verdict, false);
    EXPECT_EQ(verdict.count(Layer::host_time).compared, 2u);
    EXPECT_EQ(verdict.count(Layer::accuracy).compared, 0u);
    EXPECT_EQ(verdict.count(Layer::instructions_and_bytes).compared, 6u);
}

TEST(GateBaseline, IsNoWrongRunAndNotEmpty) {
    Results wrong = run();
    change(wrong, count_row, [](Json& row) { bench::mark_error(row, "other bits"); });
    EXPECT_THROW((void)make_baseline(wrong, {"*"}, Json::object(), "x", "y"), glsum::Failure);
    EXPECT_NO_THROW((void)make_baseline(wrong, {"*/accuracy/*"}, Json::object(), "x", "y"));
    EXPECT_THROW((void)make_baseline(run(), {"nothing"}, Json::object(), "x", "y"), glsum::Failure);
}

TEST(GateOutputs, EscapeWhatTheirFormatsCannotHold) {
    Results current = run();
    change(current, count_row, [](Json& row) { bench::mark_error(row, "<a & \"b\"> 100 %\nnext: | line, \x01"); });
    const Verdict verdict = judge(run(), current, rules());
    const std::string xml = to_junit(verdict);
    EXPECT_THAT(xml, HasSubstr("&lt;a &amp; &quot;b&quot;&gt; 100 %&#10;next"));
    EXPECT_THAT(xml, Not(HasSubstr("\x01")));
    EXPECT_THAT(xml, HasSubstr("tests=\"10\" failures=\"1\""));
    const std::string annotations = to_annotations(verdict);
    EXPECT_THAT(annotations, HasSubstr("::error title=glsum gate%3A right_answer::gl/a"));
    EXPECT_THAT(annotations, HasSubstr("100 %25%0Anext: | line"));
    EXPECT_EQ(std::count(annotations.begin(), annotations.end(), '\n'), 1);
    EXPECT_THAT(to_markdown(verdict), HasSubstr("100 % next: \\| line"));
    const Json json = Json::parse(to_json(verdict));
    EXPECT_EQ(json["schema"], "glsum-gate-1");
    EXPECT_EQ(json["verdict"], "fail");
    EXPECT_EQ(json["exit_status"], 1);
    EXPECT_EQ(json["findings"][0]["layer"], "right_answer");
}

TEST(GateOutputs, StayShortAndSaySo) {
    Results baseline = run();
    for (int i = 0; i < 1000; ++i) {
        Json row = bench::make_row("gl/c" + std::to_string(i) + "/order:0.5/taps:50/m7:count", 32);
        row["instructions_per_sample"] = 10;
        baseline.rows.push_back(row);
    }
    Results current = baseline;
    for (Json& row : current.rows) {
        if (row.contains("instructions_per_sample")) {
            row["instructions_per_sample"] = 1000;
        }
    }
    const Verdict verdict = judge(baseline, current, rules());
    ASSERT_EQ(verdict.with(Level::fail), 1002u);
    EXPECT_THAT(to_table(verdict, false), HasSubstr("... and 982 more; --json has them all"));
    EXPECT_THAT(to_markdown(verdict), HasSubstr("... and 902 more"));
    EXPECT_LT(to_markdown(verdict).size(), 1u << 20);
    const std::string annotations = to_annotations(verdict);
    EXPECT_EQ(std::count(annotations.begin(), annotations.end(), '\n'), 10);
    EXPECT_THAT(annotations, HasSubstr("and 992 more"));
    EXPECT_EQ(Json::parse(to_json(verdict))["findings"].size(), 1002u);
}

}  // namespace
