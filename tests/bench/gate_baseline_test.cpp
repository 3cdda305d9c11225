// Baselines that are made anew, and outputs that stay within their format.
#include "bench/gate/gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/gate/baseline.hpp"
#include "bench/gate/outputs.hpp"
#include "tests/bench/gate_rig.hpp"

namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

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

// What the history says of a change: each layer by its name, what got worse before what got better, and new rows.
TEST(GateBaseline, TheHistorySaysWhatChangedLayerByLayer) {
    Results baseline = run();
    drop(baseline, [](const std::string& name) { return name.ends_with("/host"); });
    const auto changes = [&](const Results& current) { return summary_of_changes(judge(baseline, current, rules())); };
    Results current = baseline;
    EXPECT_EQ(changes(current), "nothing");
    scale(current, accuracy_row, "effective_taps", 0.5);  // which only warns
    EXPECT_EQ(changes(current), "1 worse: accuracy");
    scale(current, accuracy_row, "error_max", 2.0);
    EXPECT_EQ(changes(current), "2 worse: accuracy");
    scale(current, "gl/b/order:0.5/taps:50/m7:count", "instructions_per_sample", 0.5);
    EXPECT_EQ(changes(current), "2 worse: accuracy, 1 better: instructions_and_bytes");
    scale(current, "gl/b/order:0.5/taps:50/m7:count", "code_bytes", 0.5);
    scale(current, count_row, "instructions_per_sample", 2.0);
    current.rows.push_back(bench::make_row("gl/c/order:0.5/taps:50/m7:count", 32));
    EXPECT_EQ(changes(current),
              "2 worse: accuracy, 1 worse: instructions_and_bytes, 2 better: instructions_and_bytes, 1 new");
    current.context["qemu_version"] = "7.2";  // what else differs comes first
    EXPECT_EQ(changes(current).find("qemu_version (absent) -> 7.2, 2 worse: accuracy, "), 0U) << changes(current);
    // A row that is there no more got no worse: it is lost.
    current = baseline;
    drop(current, [](const std::string& name) { return name == model_row; });
    EXPECT_EQ(changes(current), "1 lost: rows");
    // Of another compiler no value says anything.
    current.context["compiler"] = "Clang 14.0.6";
    EXPECT_EQ(changes(current), "compiler GNU 12.2.0 -> Clang 14.0.6; values not compared");
}

// Under version control: a difference names the rows that differ, and what was written is read as any result file.
TEST(GateBaseline, IsWrittenWithARowALine) {
    const base::Scratch folder;
    const std::filesystem::path path = folder.file("baseline.json");
    const Results baseline = make_baseline(run(), {"*/m7:*"}, Json::object(), "first", "nothing");
    ASSERT_EQ(baseline.rows.size(), 4U);
    write_baseline(path, baseline);
    std::vector<std::string> lines;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    ASSERT_GT(lines.size(), 6U);
    for (std::size_t i = 0; i < 4; ++i) {
        std::string line = lines[lines.size() - 6 + i];
        if (i < 3) {
            EXPECT_EQ(line.back(), ',');
            line.pop_back();
        }
        EXPECT_EQ(Json::parse(line, nullptr, false), baseline.rows[i]) << line;
    }
    const Results again = bench::read_results(path);
    EXPECT_EQ(again.context, baseline.context);
    EXPECT_EQ(again.rows, baseline.rows);
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
