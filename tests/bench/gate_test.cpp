// The gate: each kind of change is found, named by its layer, and told from the others; and what is no change is
// passed.
#include "bench/gate/gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"
#include "bench/gate/baseline.hpp"
#include "bench/gate/outputs.hpp"
#include "tests/bench/gate_rig.hpp"

namespace {

using namespace test;
using glsum::Exit;
using testing::HasSubstr;

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

// Of two rules the closer one decides: a tenth, of 80 loads 8, is nothing in either direction; more is.
TEST(Gate, WhatTheRulesAllowIsNoImprovementEither) {
    const auto found = [](double now) {
        Results before = run();
        Results after = run();
        change(before, count_row, [](Json& row) { row["loads_per_sample"] = 80.0; });
        change(after, count_row, [&](Json& row) { row["loads_per_sample"] = now; });
        std::vector<Level> levels;
        for (const Finding& finding : judge(before, after, rules()).findings) {
            levels.push_back(finding.level);
        }
        return levels;
    };
    EXPECT_EQ(found(72.0), std::vector<Level>{});
    EXPECT_EQ(found(71.9), std::vector{Level::improvement});
    EXPECT_EQ(found(88.0), std::vector<Level>{});
    EXPECT_EQ(found(88.1), std::vector{Level::warn});
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

}  // namespace
