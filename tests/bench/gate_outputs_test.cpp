// A verdict in each of its writings, from one that is made by hand: nothing is lost, nothing is added.
#include "bench/gate/outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "bench/gate/group.hpp"
#include "bench/rows/row.hpp"

namespace {

using namespace bench::gate;
using bench::Json;
using testing::HasSubstr;
using testing::Not;

Finding finding(Level level, Layer layer, const char* row, const char* counter, const char* what, const char* reason) {
    Finding made;
    made.level = level;
    made.layer = layer;
    made.row = row;
    made.counter = counter;
    made.what = what;
    made.reason = reason;
    return made;
}

Verdict verdict() {
    Verdict made;
    made.status = glsum::Exit::check_failed;
    made.baseline_name = "old.json";
    made.current_name = "new.json";
    made.not_judged = "64 host times";
    made.differences = {{"cpu", "one", "two", Effect::advisory}, {"commit", "a", "b", Effect::note}};
    made.rows = {"gl/a/m7", "gl/b/m7", "gl/c/m7"};
    made.count(Layer::rows) = {1, 0, 0, 0, 0, 0};
    made.count(Layer::accuracy) = {9, 0, 2, 0, 0, 0};
    made.count(Layer::instructions_and_bytes) = {7, 1, 1, 1, 2, 0};
    made.count(Layer::host_time) = {0, 0, 0, 0, 0, 64};
    Finding failed =
        finding(Level::fail, Layer::instructions_and_bytes, "gl/a/m7", "code_bytes", "400 -> 500", "exact");
    failed.baseline = 400.0;
    failed.current = 500.0;
    failed.change = 0.25;
    Finding better = finding(Level::improvement, Layer::host_time, "gl/b/m7", "cpu_time", "faster", "ratio");
    better.change_low = -0.5;
    better.change_high = -0.25;
    made.findings = {finding(Level::note, Layer::rows, "gl/d/*", "", "a new kernel", ""), failed,
                     finding(Level::warn, Layer::accuracy, "gl/b/m7", "error_max", "worse", "exact_ly"), better};
    return made;
}

TEST(GateOutputs, JsonHoldsEverything) {
    EXPECT_EQ(Json::parse(to_json(verdict())), Json::parse(R"({
        "schema": "glsum-gate-1", "verdict": "fail", "exit_status": 1,
        "headline": "instructions_and_bytes: gl/a/m7 code_bytes: 400 -> 500",
        "baseline": "old.json", "current": "new.json", "not_judged": "64 host times",
        "conditions": [{"field": "cpu", "baseline": "one", "current": "two", "effect": "advisory"},
                       {"field": "commit", "baseline": "a", "current": "b", "effect": "note"}],
        "rows": 3,
        "layers": [
            {"layer": "rows", "compared": 1, "failed": 0, "warned": 0, "better": 0, "moot": 0, "not_judged": 0},
            {"layer": "right_answer", "compared": 0, "failed": 0, "warned": 0, "better": 0, "moot": 0, "not_judged": 0},
            {"layer": "accuracy", "compared": 9, "failed": 0, "warned": 2, "better": 0, "moot": 0, "not_judged": 0},
            {"layer": "instructions_and_bytes", "compared": 7, "failed": 1, "warned": 1, "better": 1, "moot": 2,
             "not_judged": 0},
            {"layer": "model_cycles", "compared": 0, "failed": 0, "warned": 0, "better": 0, "moot": 0, "not_judged": 0},
            {"layer": "host_time", "compared": 0, "failed": 0, "warned": 0, "better": 0, "moot": 0, "not_judged": 64}],
        "findings": [
            {"level": "note", "layer": "rows", "row": "gl/d/*", "what": "a new kernel"},
            {"level": "fail", "layer": "instructions_and_bytes", "row": "gl/a/m7", "counter": "code_bytes",
             "baseline": 400.0, "current": 500.0, "change": 0.25, "what": "400 -> 500", "reason": "exact"},
            {"level": "warn", "layer": "accuracy", "row": "gl/b/m7", "counter": "error_max", "what": "worse",
             "reason": "exact_ly"},
            {"level": "improvement", "layer": "host_time", "row": "gl/b/m7", "counter": "cpu_time", "change_low": -0.5,
             "change_high": -0.25, "what": "faster", "reason": "ratio"}]
    })"));
    // Two blanks a level, one line at the end.
    EXPECT_TRUE(to_json(verdict()).starts_with("{\n  \"schema\""));
    EXPECT_TRUE(to_json(verdict()).ends_with("}\n"));
}

// A case for each row that was looked at, for the conditions, and for what has no row of its own.
TEST(GateOutputs, JUnitHasACaseForEachRow) {
    Verdict failed = verdict();
    failed.findings[1].what = "one\ttwo\rthree";
    EXPECT_EQ(to_junit(failed),
              "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<testsuites tests=\"5\" failures=\"1\">\n"
              "  <testsuite name=\"glsum gate\" tests=\"5\" failures=\"1\" errors=\"0\" skipped=\"0\">\n"
              "    <testcase classname=\"glsum.gate\" name=\"conditions\">\n"
              "      <system-out>cpu: one in the baseline, two now&#10;commit: a in the baseline, b now&#10;"
              "not judged: 64 host times&#10;</system-out>\n"
              "    </testcase>\n"
              "    <testcase classname=\"glsum.gate\" name=\"gl/a/m7\">\n"
              "      <failure message=\"instructions_and_bytes: code_bytes: one&#9;two&#13;three (exact)\">"
              "instructions_and_bytes: code_bytes: one&#9;two&#13;three (exact)&#10;</failure>\n"
              "    </testcase>\n"
              "    <testcase classname=\"glsum.gate\" name=\"gl/b/m7\">\n"
              "      <system-out>accuracy: error_max: worse (exact_ly)&#10;host_time: cpu_time: faster (ratio)&#10;"
              "</system-out>\n"
              "    </testcase>\n"
              "    <testcase classname=\"glsum.gate\" name=\"gl/c/m7\"/>\n"
              "    <testcase classname=\"glsum.gate\" name=\"gl/d/*\">\n"
              "      <system-out>rows: a new kernel&#10;</system-out>\n"
              "    </testcase>\n"
              "  </testsuite>\n"
              "</testsuites>\n");
    // What cannot be compared has judged no row, and its conditions fail.
    Verdict other = verdict();
    other.status = glsum::Exit::not_comparable;
    other.findings.clear();
    other.differences[0].effect = Effect::incomparable;
    EXPECT_THAT(to_junit(other), HasSubstr("<testsuites tests=\"1\" failures=\"1\">"));
    EXPECT_THAT(to_junit(other), HasSubstr("<failure message=\"cpu: one in the baseline, two now\">"));
    EXPECT_THAT(to_json(other), HasSubstr("\"effect\": \"incomparable\""));
    Verdict refused;
    refused.status = glsum::Exit::bad_input;
    refused.refusal = "no file";
    EXPECT_THAT(to_junit(refused), HasSubstr("<failure message=\"no file\">"));
}

TEST(GateOutputs, TheTableHasEveryLayerAndTheWorstFirst) {
    EXPECT_EQ(to_table(verdict(), false),
              "gate: new.json against old.json; not judged: 64 host times\n"
              "  cpu: one in the baseline, two now: host times only warn\n"
              "  commit: a in the baseline, b now: for your information\n"
              "\n"
              "  layer                     compared    fail    warn  better    moot  not judged\n"
              "  rows                             1       0       0       0       0           0  ok\n"
              "  right_answer                     0       0       0       0       0           0  -\n"
              "  accuracy                         9       0       2       0       0           0  warn\n"
              "  instructions_and_bytes           7       1       1       1       2           0  FAIL\n"
              "  model_cycles                     0       0       0       0       0           0  -\n"
              "  host_time                        0       0       0       0       0          64  -\n"
              "\nFailures (1)\n  instructions_and_bytes gl/a/m7 code_bytes: 400 -> 500\n"
              "\nWarnings (1)\n  accuracy               gl/b/m7 error_max: worse\n"
              "\nImprovements (1)\n  host_time              gl/b/m7 cpu_time: faster\n"
              "\nNotes (1)\n  rows                   gl/d/*: a new kernel\n"
              "\nfail: instructions_and_bytes: gl/a/m7 code_bytes: 400 -> 500\n");
    // Colours are around the words and change none of them; only a layer that failed has one.
    std::string coloured = to_table(verdict(), true);
    EXPECT_THAT(coloured, HasSubstr("\033[31m  instructions_and_bytes"));
    EXPECT_THAT(coloured, Not(HasSubstr("m  accuracy                         9")));
    EXPECT_THAT(coloured, HasSubstr("\033[31mFailures (1)\033[0m"));
    EXPECT_THAT(coloured, HasSubstr("\033[33mWarnings (1)\033[0m"));
    EXPECT_THAT(coloured, HasSubstr("\033[32mImprovements (1)\033[0m"));
    EXPECT_THAT(coloured, HasSubstr("\033[2mNotes (1)\033[0m"));
    EXPECT_THAT(coloured, HasSubstr("\033[31m\nfail: "));
    for (std::size_t at; (at = coloured.find('\033')) != std::string::npos;) {
        coloured.erase(at, coloured.find('m', at) - at + 1);
    }
    EXPECT_EQ(coloured, to_table(verdict(), false));
    Verdict good = verdict();
    good.status = glsum::Exit::good;
    good.findings.clear();
    EXPECT_THAT(to_table(good, true), HasSubstr("\033[32m\npass: 17 values of 3 rows"));
    // Without a judgement there are no layers.
    Verdict other = verdict();
    other.status = glsum::Exit::not_comparable;
    other.differences[0].effect = Effect::incomparable;
    EXPECT_THAT(to_table(other, false), Not(HasSubstr("compared")));
    EXPECT_THAT(to_table(other, false), HasSubstr("two now: not comparable\n"));
    EXPECT_THAT(to_markdown(other), Not(HasSubstr("compared")));
    Verdict refused = verdict();
    refused.status = glsum::Exit::bad_input;
    refused.refusal = "no file";
    EXPECT_THAT(to_table(refused, false), Not(HasSubstr("compared")));
    EXPECT_THAT(to_markdown(refused), Not(HasSubstr("compared")));
}

TEST(GateOutputs, MarkdownHasTheSame) {
    EXPECT_EQ(
        to_markdown(verdict()),
        "## ❌ glsum gate: fail\n\ninstructions\\_and\\_bytes: gl/a/m7 code\\_bytes: 400 -> 500\n\n"
        "`new.json` against `old.json`; not judged: 64 host times\n"
        "\n| condition | baseline | now | effect |\n|---|---|---|---|\n"
        "| cpu | one | two | host times only warn |\n| commit | a | b | for your information |\n"
        "\n| layer | compared | fail | warn | better | |\n|---|--:|--:|--:|--:|---|\n"
        "| rows | 1 | 0 | 0 | 0 | ok |\n| right\\_answer | 0 | 0 | 0 | 0 | - |\n| accuracy | 9 | 0 | 2 | 0 | warn |\n"
        "| instructions\\_and\\_bytes | 7 | 1 | 1 | 1 | FAIL |\n| model\\_cycles | 0 | 0 | 0 | 0 | - |\n"
        "| host\\_time | 0 | 0 | 0 | 0 | - |\n"
        "\n<details open><summary>Failures (1)</summary>\n\n| layer | row | counter | change | why "
        "|\n|---|---|---|---|---|\n"
        "| instructions\\_and\\_bytes | gl/a/m7 | code\\_bytes | 400 -> 500 | exact |\n\n</details>\n"
        "\n<details><summary>Warnings (1)</summary>\n\n| layer | row | counter | change | why "
        "|\n|---|---|---|---|---|\n"
        "| accuracy | gl/b/m7 | error\\_max | worse | exact\\_ly |\n\n</details>\n"
        "\n<details><summary>Improvements (1)</summary>\n\n| layer | row | counter | change | why "
        "|\n|---|---|---|---|---|\n"
        "| host\\_time | gl/b/m7 | cpu\\_time | faster | ratio |\n\n</details>\n"
        "\n<details><summary>Notes (1)</summary>\n\n| layer | row | counter | change | why |\n|---|---|---|---|---|\n"
        "| rows | gl/d/\\* |  | a new kernel |  |\n\n</details>\n");
    Verdict hostile = verdict();
    hostile.findings[1].what = "a|b\\c*d_e`f<g[h\ni";
    EXPECT_THAT(to_markdown(hostile), HasSubstr("a\\|b\\\\c\\*d\\_e\\`f\\<g\\[h i"));
    Verdict good;
    EXPECT_TRUE(to_markdown(good).starts_with("## ✅ glsum gate: pass\n"));
    EXPECT_THAT(to_markdown(good), Not(HasSubstr("| condition |")));
}

TEST(GateOutputs, AnnotationsAreOfFailuresAndWarnings) {
    EXPECT_EQ(to_annotations(verdict()),
              "::error title=glsum gate%3A instructions_and_bytes::gl/a/m7 code_bytes: 400 -> 500\n"
              "::warning title=glsum gate%3A accuracy::gl/b/m7 error_max: worse\n");
    Verdict other = verdict();
    other.status = glsum::Exit::not_comparable;
    other.differences[0] = {"cpu", "a,\rb", "two", Effect::incomparable};
    EXPECT_EQ(to_annotations(other),
              "::error title=glsum gate%3A not comparable::cpu: a,%0Db in the baseline, two now\n");
    EXPECT_EQ(to_annotations(Verdict{}), "");
    // Exactly ten are all shown, and none more is promised.
    const auto of_kernels = [](std::size_t count) {
        Verdict made = verdict();
        const Finding one = made.findings[1];
        made.findings.assign(count, one);
        for (std::size_t i = 0; i < count; ++i) {
            made.findings[i].row = "gl/k" + std::to_string(i) + "/order:0.5/taps:50/m7:count";
        }
        return made;
    };
    EXPECT_THAT(to_annotations(of_kernels(10)), Not(HasSubstr("more")));
    const std::string eleven = to_annotations(of_kernels(11));
    EXPECT_EQ(std::count(eleven.begin(), eleven.end(), '\n'), 10);
    EXPECT_THAT(eleven, HasSubstr("%0Aand 1 more\n"));
    // The table shows twenty, Markdown a hundred.
    EXPECT_THAT(to_table(of_kernels(20), false), Not(HasSubstr("more")));
    EXPECT_THAT(to_table(of_kernels(21), false), HasSubstr("  ... and 1 more; --json has them all\n"));
    EXPECT_THAT(to_markdown(of_kernels(100)), Not(HasSubstr("more")));
    EXPECT_THAT(to_markdown(of_kernels(101)), HasSubstr("\n... and 1 more\n"));
}

// What a kernel changed in a counter is one line, at however many lengths; its annotation stands at its line of the
// registry.
TEST(GateOutputs, AKernelIsOneLine) {
    Verdict made = verdict();
    made.findings.clear();
    for (const auto& [taps, change] : {std::pair("50", 0.02), std::pair("100", 0.031), std::pair("600", 0.025)}) {
        made.findings.push_back(finding(Level::fail, Layer::model_cycles,
                                        ("gl/ring_plain_f32/order:0.5/taps:" + std::string(taps) + "/m7:one").c_str(),
                                        "model_cycles_per_sample", "more", "moved"));
        made.findings.back().change = change;
    }
    Finding other = made.findings[0];
    other.row = "gl/ring_plain_f32/order:0.5/taps:50/m7:two";  // another core
    made.findings.push_back(other);
    other.counter = "code_bytes";
    made.findings.push_back(other);
    made.findings.push_back(finding(Level::fail, Layer::rows, "gl/lost_one_f32/*", "", "lost", ""));
    const std::string table = to_table(made, false);
    EXPECT_THAT(
        table,
        HasSubstr("Failures (6 in 4 lines)\n"
                  "  model_cycles           ring_plain_f32 m7:one model_cycles_per_sample: +2 % to +3.1 % in 3 rows\n"
                  "  model_cycles           gl/ring_plain_f32/order:0.5/taps:50/m7:two model_cycles_per_sample: more\n"
                  "  model_cycles           gl/ring_plain_f32/order:0.5/taps:50/m7:two code_bytes: more\n"
                  "  rows                   gl/lost_one_f32/*: lost\n"));
    EXPECT_THAT(
        to_markdown(made),
        HasSubstr("| ring\\_plain\\_f32 m7:one | model\\_cycles\\_per\\_sample | +2 % to +3.1 % in 3 rows | moved |"));
    made.findings[1].change.reset();  // a counter that was 0
    EXPECT_THAT(to_table(made, false),
                HasSubstr("in 3 rows, the first gl/ring_plain_f32/order:0.5/taps:50/m7:one: more\n"));
    made.findings[1].change = -2.5;
    EXPECT_THAT(to_table(made, false), HasSubstr(": -250 % to +2.5 % in 3 rows\n"));

    const Place place = place_of("gl/ring_plain_f32/order:0.5/taps:50/m7:one");
    EXPECT_EQ(place.file, "kernels/glsum/registry.def");
    std::ifstream registry(std::filesystem::path(TEST_PROJECT) / place.file);
    std::string line;
    for (int i = 0; i < place.line; ++i) {
        ASSERT_TRUE(std::getline(registry, line));
    }
    EXPECT_TRUE(line.starts_with("GLSUM_KERNEL(ring_plain_f32,")) << line;
    EXPECT_GT(place_of("gl/mirror_simd_f32/*").line, 0);
    EXPECT_EQ(place_of("gl/lost_one_f32/*").file, "");
    EXPECT_EQ(place_of("BM_other/8").file, "");
    EXPECT_THAT(to_annotations(made),
                HasSubstr("::error file=kernels/glsum/registry.def,line=" + std::to_string(place.line) +
                          ",title=glsum gate%3A model_cycles::ring_plain_f32 m7:one"));
    EXPECT_THAT(to_annotations(made), HasSubstr("::error title=glsum gate%3A rows::gl/lost_one_f32/*: lost\n"));
}

// Of several rows the least and the most, once where they read the same; from a hundred per cent on in whole ones.
TEST(GateOutputs, SeveralRowsAreToldByTheirLeastAndTheirMost) {
    const auto told = [](const std::vector<double>& changes) {
        Verdict made;
        for (std::size_t i = 0; i < changes.size(); ++i) {
            const std::string row = "gl/ring_plain_f32/order:0.5/taps:" + std::to_string(50 + i) + "/m7:one";
            made.findings.push_back(
                finding(Level::fail, Layer::model_cycles, row.c_str(), "model_cycles_per_sample", "more", "moved"));
            made.findings.back().change = changes[i];
        }
        return groups_of(made, Level::fail).at(0).what();
    };
    EXPECT_EQ(told({0.0234, 0.0231}), "+2.3 % in 2 rows");
    EXPECT_EQ(told({0.25, -0.13, 0.5}), "-13 % to +50 % in 3 rows");
    for (const double hundred : {0.995, 0.9994, 1.004}) {
        EXPECT_EQ(told({hundred, 0.98}), "+98 % to +100 % in 2 rows") << hundred;
        EXPECT_EQ(told({-hundred, -0.98}), "-100 % to -98 % in 2 rows") << hundred;
    }
    EXPECT_EQ(told({0.9949, -0.9949}), "-99 % to +99 % in 2 rows");
    EXPECT_EQ(told({12.34, 0.0}), "+0 % to +1234 % in 2 rows");
}

// Of control characters XML has three; the last of them is just before the blank.
TEST(GateOutputs, JUnitHasNoControlCharacters) {
    Verdict made = verdict();
    made.findings[1].what =
        "a\x01"
        "b\x1f"
        "c d";
    EXPECT_THAT(to_junit(made), HasSubstr("code_bytes: a?b?c d (exact)"));
}

}  // namespace
