// What two runs have in common: conditions, processors, and targets that only one of them has.
#include "bench/gate/gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/failure.hpp"
#include "bench/gate/baseline.hpp"
#include "bench/gate/outputs.hpp"
#include "tests/bench/gate_rig.hpp"

namespace {

using namespace test;
using glsum::Exit;
using testing::HasSubstr;
using testing::Not;

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

// What became faster is an improvement, by how much and how surely; what may have become slower or may not, a note.
TEST(Gate, SaysWhichTimesGotBetterAndWhichCannotBeTold) {
    Results current = run();
    scale(current, time_row, "cpu_time", 0.8);
    Verdict verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.status, Exit::good);
    EXPECT_EQ(verdict.count(Layer::host_time).compared, 2u);
    ASSERT_EQ(verdict.findings.size(), 1u);
    const Finding& better = verdict.findings.front();
    EXPECT_EQ(better.level, Level::improvement);
    EXPECT_EQ(better.layer, Layer::host_time);
    EXPECT_EQ(better.row, time_row);
    EXPECT_EQ(better.counter, "cpu_time");
    EXPECT_EQ(better.reason, "ratio");
    EXPECT_NEAR(better.change.value(), -0.2, 1e-3);
    EXPECT_LE(better.change_low.value(), better.change.value());
    EXPECT_GE(better.change_high.value(), better.change.value());
    EXPECT_THAT(better.what, testing::StartsWith("-20.0 % ("));
    EXPECT_THAT(better.what, testing::EndsWith(" %) of the time of peer_std_f32"));
    // One repetition as fast as before, and all others a tenth slower: the fastest may be either.
    current = run();
    for (Json& row : current.rows) {
        if (row["name"] == time_row && row["repetition_index"] != 0) {
            row["cpu_time"] = 1.1 * row["cpu_time"].get<double>();
        }
    }
    verdict = judge(run(), current, rules());
    EXPECT_EQ(verdict.status, Exit::good);
    ASSERT_EQ(verdict.findings.size(), 1u);
    EXPECT_EQ(verdict.findings.front().level, Level::note);
    EXPECT_EQ(verdict.findings.front().row, time_row);
    EXPECT_THAT(verdict.findings.front().what,
                testing::EndsWith("; whether it is beyond 5 % cannot be told; more --repetitions can"));
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

}  // namespace
