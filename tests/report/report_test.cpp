// What a report is made of: columns, fronts, curves, differences, texts that stay texts.
#include "bench/report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "bench/report/best.hpp"
#include "bench/report/columns.hpp"
#include "bench/report/curves.hpp"
#include "bench/report/difference.hpp"
#include "bench/report/front_table.hpp"
#include "bench/rows/csv.hpp"
#include "bench/rows/front.hpp"
#include "bench/rows/key.hpp"
#include "tests/report/pretend_results.hpp"

namespace {

using namespace bench::report;
using bench::on_front;
using bench::Point;

TEST(Front, KeepsWhatNothingBeats) {
    const std::vector<Point> points = {{10, 1.0}, {20, 0.5}, {20, 0.6}, {30, 0.5}, {5, 2.0}, {40, 0.1}};
    EXPECT_EQ(on_front(points), (std::vector<bool>{true, true, false, false, true, true}));
}

TEST(Front, AnErrorOfOnePercentMoreIsTheSame) {
    EXPECT_EQ(on_front(std::vector<Point>{{10, 1.005}, {20, 1.0}}), (std::vector<bool>{true, false}));
    EXPECT_EQ(on_front(std::vector<Point>{{10, 1.02}, {20, 1.0}}), (std::vector<bool>{true, true}));
    EXPECT_EQ(on_front(std::vector<Point>{{10, 1.005}, {10, 1.0}}), (std::vector<bool>{true, true}));
}

TEST(Front, EqualPointsDoNotBeatEachOther) {
    EXPECT_EQ(on_front(std::vector<Point>{{10, 1.0}, {10, 1.0}, {10, 2.0}}), (std::vector<bool>{true, true, false}));
}

TEST(Front, WhereBytesCountTheyMustNotBeMoreEither) {
    using bench::dominates;
    EXPECT_TRUE(dominates({10, 1.0, 50}, {12, 1.0, 50}));
    EXPECT_TRUE(dominates({10, 1.0, 49}, {10, 1.0, 50}));
    EXPECT_TRUE(dominates({10, 1.005, 50}, {12, 1.0, 50}));
    EXPECT_FALSE(dominates({10, 1.0, 51}, {12, 1.0, 50}));
    EXPECT_FALSE(dominates({10, 1.0, 50}, {10, 1.005, 50}));
    EXPECT_FALSE(dominates({10, 1.0, 50}, {10, 1.0, 50}));
}

TEST(Columns, TextsAreIndicesIntoTheirDistinctValues) {
    const bench::Json column = encode_texts({"ring", "shift", "ring", "mirror"});
    EXPECT_EQ(column["values"], (bench::Json{"ring", "shift", "mirror"}));
    EXPECT_EQ(column["bits"], 6);
    EXPECT_EQ(column["at"], "ABAC");  // 0 1 0 2
    EXPECT_FALSE(encode_texts({"ring", "ring"}).contains("at"));
}

TEST(Columns, MissingNumbersAreNull) {
    const bench::Json column = encode_numbers({0.1, std::nan(""), 0.1});
    EXPECT_EQ(column["values"], (bench::Json{0.1, nullptr}));
    EXPECT_EQ(column["at"], "ABA");  // 0 1 0
}

TEST(Columns, IndicesAreLettersUpTo64ValuesAndBytesBeyond) {
    std::vector<std::string> texts;
    for (int i = 0; i < 64; ++i) {
        texts.push_back(std::to_string(i));
    }
    const bench::Json few = encode_texts(texts);
    EXPECT_EQ(few["bits"], 6);
    EXPECT_EQ(few["at"], "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/");
    texts.push_back("64");
    const bench::Json more = encode_texts(texts);
    EXPECT_EQ(more["bits"], 8);
    EXPECT_EQ(more["at"].get<std::string>().substr(0, 8), "AAECAwQF");  // 00 01 02 03 04 05
}

TEST(Columns, ManyDifferentNumbersAreFloats) {
    std::vector<double> numbers;
    for (int i = 0; i < 300; ++i) {
        numbers.push_back(i);
    }
    const std::string text = encode_numbers(numbers)["float32"];
    EXPECT_EQ(text.size(), 300U * 4U * 4U / 3U);
    EXPECT_EQ(text.substr(0, 16), "AAAAAAAAgD8AAABA");  // 0, 1, 2: 00000000 0000803f 00000040
}

TEST(Columns, ManyDifferentErrorsAreShortFloats) {
    std::vector<double> errors = {1.0, std::nan(""), 0.0, 1.0 + 0x1p-16};
    EXPECT_EQ(encode_errors(errors), encode_numbers(errors));
    for (int i = 0; i < 5000; ++i) {
        errors.push_back(1e-3 * (1.0 + 1e-4 * i));
    }
    const std::string text = encode_errors(errors)["float24"];
    EXPECT_EQ(text.size(), 5004U * 4U);
    EXPECT_EQ(text.substr(0, 16), "AIA/AMB/AAAAAYA/");  // 00803f, 00c07f, 000000, 01803f: half a unit goes up
}

TEST(Columns, OneTableForEachAspectAndMeansLeftOut) {
    std::vector<bench::Json> rows = {
        bench::make_row("gl/a_b_c/order:0.5/taps:2+7/accuracy/signal:sine5/amplitude:0.0625", 1),
        bench::make_row("gl/a_b_c/order:0.5/taps:50/host", 1), bench::make_row("drive/niopdt/a_b_c/taps:50/host", 1),
        bench::make_row("gl/a_b_c/order:0.5/taps:50/host", 1)};
    rows[3]["run_type"] = "aggregate";
    bench::mark_error(rows[1], "wrong");
    const bench::Json tables = to_tables(rows);
    ASSERT_EQ(tables.size(), 3U);
    EXPECT_EQ(tables[0]["aspect"], "accuracy");
    EXPECT_EQ(tables[0]["texts"]["signal"]["values"][0], "sine5, amplitude 0.0625");
    EXPECT_EQ(tables[0]["texts"]["taps"]["values"][0], "2+7");
    EXPECT_EQ(tables[1]["aspect"], "host");
    EXPECT_EQ(tables[1]["rows"], 1);
    EXPECT_EQ(tables[1]["texts"]["fault"]["values"][0], "wrong");
    EXPECT_EQ(tables[2]["aspect"], "other");
    EXPECT_EQ(tables[2]["texts"]["name"]["values"][0], "drive/niopdt/a_b_c/taps:50/host");
}

TEST(Columns, AnEndlessListOfStallsIsRefused) {
    bench::Json row = bench::make_row("gl/a_b_c/order:0.5/taps:50/m7:x", 1);
    for (int i = 0; i < 65; ++i) {
        row["stall_" + std::to_string(i)] = 1.0;
    }
    EXPECT_THROW((void)to_tables({row}), glsum::Failure);
}

TEST(Curves, FrontsGoOverAllLengthsOfAnOrderAndLeaveFaultsOut) {
    std::vector<bench::Json> rows;
    const auto add = [&](const std::string& kernel, const std::string& taps, double error, double instructions) {
        auto& accuracy =
            rows.emplace_back(bench::make_row("gl/" + kernel + "/order:0.5/taps:" + taps + "/accuracy/signal:step", 1));
        accuracy["error_max"] = error;
        auto& cost = rows.emplace_back(bench::make_row("gl/" + kernel + "/order:0.5/taps:" + taps + "/m7:f746", 1));
        cost["instructions_per_sample"] = instructions;
        cost["model_cycles_per_sample"] = instructions / 2;
        cost["model_cycles_low"] = instructions / 3;
    };
    add("fast", "50", 0.5, 100);
    add("slow", "50", 0.5, 200);   // beaten at its own length
    add("fast", "100", 0.6, 150);  // beaten by the shorter one
    add("wrong", "50", 0.1, 10);
    // Wrong at another signal: what it costs and errs at this one is known and does not count.
    rows.push_back(bench::make_row("gl/wrong/order:0.5/taps:50/accuracy/signal:ramp", 1));
    bench::mark_error(rows.back(), "not finite");
    const auto groups = bench::group(rows);
    const auto costs = costs_of(groups);
    ASSERT_EQ(costs.size(), 3U);
    EXPECT_EQ(costs[1].name, "model_cycles:f746");
    const auto points = curve_points(groups, costs);
    for (const auto& point : points) {
        EXPECT_EQ(point.front[0], point.entry->kernel == "fast" && point.group->taps == "50") << point.entry->kernel;
    }
    EXPECT_EQ(points[0].entry->model_cycles.at("f746").median, 50.0);
    EXPECT_FALSE(points[0].entry->model_cycles.at("f746").high);
}

TEST(Best, IsTheCheapestThatKeepsTheLimitAndTheCheapestWindow) {
    std::vector<bench::Json> rows;
    const auto add = [&](const std::string& kernel, const std::string& order, const std::string& taps, double error,
                         double instructions) {
        const std::string name = "gl/" + kernel + "/order:" + order + "/taps:" + taps;
        rows.emplace_back(bench::make_row(name + "/accuracy/signal:step", 1))["error_max"] = error;
        rows.emplace_back(bench::make_row(name + "/m7:count", 1))["instructions_per_sample"] = instructions;
    };
    add("shift_plain_f32", "0.5", "600", 5e-3, 900);
    add("ring_plain_f32", "0.5", "600", 5e-3, 600);
    add("ring_plain_f32", "0.5", "5000", 5e-5, 5000);
    add("modes_plain_f32", "0.5", "2+7", 5e-3, 60);
    add("modes_plain_f32", "0.5", "2+11", 1e-4, 90);
    add("modes_plain_f32", "0.5", "2+15", 2e-6, 20000);
    add("ring_plain_f32", "-0.5", "600", 1e-7, 650);
    bench::mark_error(rows.emplace_back(bench::make_row("gl/wrong_plain_f32/order:0.5/taps:1/accuracy/signal:step", 1)),
                      "not finite");
    const auto groups = bench::group(rows);
    const auto costs = costs_of(groups);
    const auto points = curve_points(groups, costs);
    ASSERT_EQ(deciding_cost(costs), 0U);
    std::vector<std::string> found;
    for (const Best& best : best_of(points, costs, 0)) {
        const auto text = [](const auto* point) {
            return point == nullptr ? std::string("none") : point->entry->kernel + " " + point->group->taps;
        };
        found.push_back(best.order + ": " + text(best.point) + ", " + text(best.window));
    }
    const std::vector<std::string> expected = {
        "0.5: modes_plain_f32 2+7, ring_plain_f32 600",   "0.5: modes_plain_f32 2+11, ring_plain_f32 5000",
        "0.5: modes_plain_f32 2+11, ring_plain_f32 5000", "0.5: none, none",
        "-0.5: ring_plain_f32 600, ring_plain_f32 600",   "-0.5: ring_plain_f32 600, ring_plain_f32 600",
        "-0.5: ring_plain_f32 600, ring_plain_f32 600",   "-0.5: ring_plain_f32 600, ring_plain_f32 600"};
    EXPECT_EQ(found, expected);
    EXPECT_EQ(never_on_front(points, costs, 0), std::vector<std::string>{"shift_plain_f32"});
    EXPECT_NE(best_table(points, costs).find("dominated at every order and length: shift_plain_f32"),
              std::string::npos);
    EXPECT_EQ(best_table({}, costs), "");
}

// The answer of a run: a screen for four orders, whoever wins.
TEST(FrontTable, SaysTheCheapestOfEachDecadeAndWhatThatSavesBesideAWindow) {
    std::vector<bench::Json> rows;
    const auto add = [&](const std::string& kernel, const std::string& order, const std::string& taps, double error,
                         double cycles) {
        const std::string name = "gl/" + kernel + "/order:" + order + "/taps:" + taps;
        rows.emplace_back(bench::make_row(name + "/accuracy/signal:step", 1))["error_max"] = error;
        auto& cost = rows.emplace_back(bench::make_row(name + "/m7:f746", 1));
        cost["model_cycles_per_sample"] = cycles;
        cost["state_bytes"] = 100;
        cost["coefficient_bytes"] = 20;
    };
    add("ring_plain_f32", "0.5", "600", 5e-3, 900);
    add("ring_plain_f32", "0.5", "full", 5e-5, 5000);
    add("modes_plain_f32", "0.5", "2+7", 5e-3, 60);
    add("modes_compensated_f32", "0.5", "2+7", 4e-3, 60);  // as cheap, more exact
    add("modes_plain_f32", "0.5", "2+11", 9e-5, 90.4);
    add("ring_plain_f32", "-0.5", "600", 7e-3, 650);
    const auto groups = bench::group(rows);
    const auto costs = costs_of(groups);
    EXPECT_EQ(front_table(curve_points(groups, costs), costs), R"(
order 0.5: the cheapest within each decade of error, by cycles of a Cortex-M7, modelled for f746
      error   kernel                       taps           cycles     bytes
    4.0e-03   modes_compensated_f32        2+7                60       120
    9.0e-05   modes_plain_f32              2+11               90       120
  Within 1e-2: modes_compensated_f32 2+7, 60 cycles; the cheapest window, ring_plain_f32 600: 15.0 times as much.
  Within 1e-4: modes_plain_f32 2+11, 90 cycles; the cheapest window, ring_plain_f32 full: 55.3 times as much.

order -0.5: the cheapest within each decade of error, by cycles of a Cortex-M7, modelled for f746
      error   kernel                       taps           cycles     bytes
    7.0e-03   ring_plain_f32               600               650       120
  Within 1e-2: ring_plain_f32 600, 650 cycles; a window.
  Within 1e-4: no kernel of this run.

  error: worst of the signals, relative to the largest exact sum. Every kernel and length: --table all.
)");
    EXPECT_EQ(front_table({}, costs), "");
    EXPECT_EQ(front_table({}, {}), "");
}

TEST(Differences, TheLargestRatioComesFirst) {
    std::vector<bench::Json> a = {bench::make_row("gl/a_b_c/order:0.5/taps:50/m7:count", 1),
                                  bench::make_row("gl/a_b_c/order:0.5/taps:50/accuracy/signal:step", 1),
                                  bench::make_row("gone", 1)};
    a[0]["instructions_per_sample"] = 100;
    a[0]["code_bytes"] = 40;
    a[1]["error_max"] = 1e-3;
    a[1]["real_time"] = 5.0;  // no timing: not compared
    auto b = a;
    b[0]["instructions_per_sample"] = 110;
    b[1]["error_max"] = 0.25e-3;
    b[1]["real_time"] = 7.0;
    b[2]["name"] = "new";
    a[0]["stack_bytes"] = 0;
    b[0]["stack_bytes"] = 8;  // of nothing there is no ratio
    auto found = differences(a, b);
    ASSERT_EQ(found.size(), 5U);
    EXPECT_NE(to_csv(found).find("gl/a_b_c/order:0.5/taps:50/m7:count,stack_bytes,0,8,,\n"), std::string::npos);
    EXPECT_NE(to_csv(found).find("gone,,,,,only in A\n"), std::string::npos);
    a[0].erase("stack_bytes");
    b[0].erase("stack_bytes");
    found = differences(a, b);
    ASSERT_EQ(found.size(), 4U);
    EXPECT_EQ(found[0].note, "only in A");
    EXPECT_EQ(found[1].note, "only in B");
    EXPECT_EQ(found[2].counter, "error_max");
    EXPECT_EQ(found[3].counter, "instructions_per_sample");
    EXPECT_NEAR(found[3].size(), std::log(1.1), 1e-12);
    EXPECT_NE(to_csv(found).find("gl/a_b_c/order:0.5/taps:50/m7:count,instructions_per_sample,100,110,1.1,\n"),
              std::string::npos);
}

TEST(Texts, OfAFileStayOneField) {
    EXPECT_EQ(bench::csv_field("plain"), "plain");
    EXPECT_EQ(bench::csv_field("a,b \"c\"\n"), "\"a,b \"\"c\"\"\n\"");
    EXPECT_EQ(base::gnuplot_text("ring\"; system('x'); `y` $z {a}"), "ring?? system(?x?)? ?y? ?z ?a?");
    EXPECT_EQ(bench::taps_number("2+7"), 9.0);
    for (const char* text : {"", "full", "5x", "+", "2+", "-3", "0"}) {
        EXPECT_EQ(bench::taps_number(text), std::nullopt) << text;
    }
}

TEST(Texts, NoneEndsTheDataOfThePage) {
    Input input{"</title>.json", test::pretend_results(10, 1), {}};
    const std::string hostile = "</script><!--<script>&lt;";
    input.results.context["cpu"] = hostile;
    input.results.rows[0]["name"] = hostile;
    const std::string page = make_page(input, nullptr);
    EXPECT_EQ(page.find(hostile), std::string::npos);
    const auto begin = page.find("id=\"data\">");
    const std::string data = page.substr(begin + 10, page.find("</script>", begin) - begin - 10);
    EXPECT_EQ(data.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(bench::Json::parse(data)["files"][0]["context"]["cpu"], hostile);
    EXPECT_NE(page.find("<title>glsum: &lt;/title&gt;.json</title>"), std::string::npos);
}

TEST(Report, WritesEveryFileEvenOfHostileNamesAndOddLengths) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "report it's";
    std::filesystem::remove_all(folder);
    Input input{"a.json", test::pretend_results(3000, 1), {}};
    input.results.rows[0]["name"] = "gl/a`touch stolen`_\"b_c/order:0.2\"/taps:2+7/accuracy/signal:step";
    input.results.rows[1]["name"] = "gl/a_b_c/order:0.2/taps:many/accuracy/signal:step";
    input.results.rows[2]["name"] = "BM_other/8";
    const auto written = write_report(input, &input, folder / "page.html");
    EXPECT_EQ(written.size(), 11U);
    for (const auto& file : written) {
        EXPECT_GT(std::filesystem::file_size(file), 0U) << file;
    }
    EXPECT_EQ(base::read_file(folder / "page-difference.csv", 1000), "name,counter,a,b,ratio,note\n");
    EXPECT_FALSE(std::filesystem::exists("stolen"));
    std::filesystem::remove_all(folder);
}

TEST(Report, OfAFileWithoutCostsHasNoFronts) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "report_free";
    Input input{"free.json", {}, {}};
    input.results.rows = {bench::make_row("gl/a_b_c/order:0.5/taps:50/accuracy/signal:step", 1)};
    input.results.rows[0]["error_max"] = 1e-2;
    EXPECT_EQ(write_report(input, nullptr, folder / "page.html").size(), 8U);
    EXPECT_FALSE(std::filesystem::exists(folder / "page-fronts.svg"));
    std::filesystem::remove_all(folder);
}

TEST(Report, OfAFileWithoutAccuracyHasNoPictures) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "report_other";
    Input input{"other.json", {}, {}};
    input.results.rows = {bench::make_row("BM_other/8", 1)};
    EXPECT_EQ(write_report(input, nullptr, folder / "page.html").size(), 4U);
    std::filesystem::remove_all(folder);
}

TEST(Columns, WiderIndicesForMoreValues) {
    const auto bits = [](std::size_t distinct) {
        std::vector<std::string> texts;
        for (std::size_t i = 0; i < distinct; ++i) {
            texts.push_back(std::to_string(i));
        }
        return encode_texts(texts)["bits"].get<int>();
    };
    EXPECT_EQ(bits(2), 6);
    EXPECT_EQ(bits(256), 8);
    EXPECT_EQ(bits(257), 16);
    EXPECT_EQ(bits(65536), 16);
    EXPECT_EQ(bits(65537), 32);
    // Bytes in threes, and what is missing to three is filled.
    for (const unsigned count : {66U, 67U, 68U}) {
        std::vector<std::string> texts;
        for (unsigned i = 0; i < count; ++i) {
            texts.push_back(std::to_string(i));
        }
        const std::string at = encode_texts(texts)["at"];
        EXPECT_EQ(at.size(), (count + 2) / 3 * 4) << count;
        EXPECT_EQ(std::count(at.begin(), at.end(), '='), (3 - count % 3) % 3) << count;
    }
}

// Floats where half of all numbers are others, 256 at least; errors in three bytes beyond 4096 values.
TEST(Columns, RepeatedNumbersStayValues) {
    const auto numbers = [](std::size_t distinct, std::size_t all) {
        std::vector<double> column;
        for (std::size_t i = 0; i < all; ++i) {
            column.push_back(static_cast<double>(i % distinct) + 1.0);
        }
        return column;
    };
    EXPECT_TRUE(encode_numbers(numbers(300, 600)).contains("values"));
    EXPECT_TRUE(encode_numbers(numbers(300, 599)).contains("float32"));
    EXPECT_TRUE(encode_numbers(numbers(256, 256)).contains("values"));
    EXPECT_TRUE(encode_numbers(numbers(257, 257)).contains("float32"));
    EXPECT_TRUE(encode_errors(numbers(4096, 8192)).contains("values"));
    EXPECT_TRUE(encode_errors(numbers(4097, 8194)).contains("float24"));
    EXPECT_TRUE(encode_errors(numbers(300, 300)).contains("float24"));
    // Beyond a float's range as far as it goes, and seven digits of what is in it.
    const bench::Json values = encode_numbers({1e300, -1e300, 0.1, 1.0 / 3.0})["values"];
    EXPECT_EQ(values[0].get<float>(), std::numeric_limits<float>::max());
    EXPECT_EQ(values[1].get<float>(), -std::numeric_limits<float>::max());
    EXPECT_EQ(values[2].dump(), "0.1");
    EXPECT_EQ(values[3].dump(), "0.33333334");
    std::vector<double> errors = numbers(300, 300);
    errors[0] = 1e300;
    errors[1] = -1e300;
    EXPECT_EQ(encode_errors(errors)["float24"].get<std::string>().substr(0, 8), "AAB/AAD/");  // 2^127: 00007f, 0000ff
}

TEST(Columns, LongTextsAreCutBetweenCharacters) {
    const auto shown = [](const std::string& label) {
        bench::Json row = bench::make_row("gl/a_b_c/order:0.5/taps:50/host", 1);
        row["label"] = label;
        return to_tables({row})[0]["texts"]["label"]["values"][0].get<std::string>();
    };
    EXPECT_EQ(shown(std::string(300, 'x')), std::string(300, 'x'));
    EXPECT_EQ(shown(std::string(301, 'x')), std::string(300, 'x') + " ...");
    EXPECT_EQ(shown(std::string(299, 'x') + "\u00fc."), std::string(299, 'x') + " ...");
    EXPECT_EQ(shown(std::string(298, 'x') + "\u00fc."), std::string(298, 'x') + "\u00fc ...");
}

TEST(Columns, CellsThatARowLacksAreEmpty) {
    std::vector<bench::Json> rows(3, bench::make_row("gl/a_b_c/order:0.5/taps:50/m7:x", 1));
    rows[0]["error_max"] = 0.5;
    rows[1]["stall_b"] = 2.0;
    rows[1]["label"] = "second";
    rows[2]["error_occurred"] = true;
    rows[2]["not_known"] = 1.0;
    for (int i = 0; i < 63; ++i) {
        rows[0]["stall_" + std::to_string(i)] = 1.0;  // 64 with the other one: as many as there may be
    }
    const bench::Json table = to_tables(rows)[0];
    EXPECT_EQ(table["rows"], 3);
    EXPECT_EQ(table["numbers"]["error_max"]["values"], (bench::Json{0.5, nullptr}));
    EXPECT_EQ(table["numbers"]["error_max"]["at"], "ABB");
    EXPECT_EQ(table["numbers"]["stall_b"]["at"], "ABA");
    EXPECT_EQ(table["texts"]["label"]["values"], (bench::Json{"", "second"}));
    EXPECT_EQ(table["texts"]["label"]["at"], "ABA");
    EXPECT_EQ(table["texts"]["fault"]["values"], (bench::Json{"", "no reason given"}));
    EXPECT_FALSE(table["numbers"].contains("not_known"));
    EXPECT_FALSE(table["texts"].contains("name"));
}

// A line for each kernel and length: what it errs, the bound of that, what it costs, whether it is on each front.
TEST(Curves, AreWrittenAsAFileOfAllPoints) {
    std::vector<bench::Json> rows;
    const auto row = [&](const std::string& name) -> bench::Json& {
        return rows.emplace_back(bench::make_row("gl/" + name, 1));
    };
    bench::Json& accuracy = row("a_b_c/order:0.5/taps:50/accuracy/signal:step");
    accuracy["error_max"] = 0.5;
    accuracy["rounding_error_max"] = 0.25;
    accuracy["truncation_error_max"] = 0.375;
    accuracy["effective_taps"] = 49;
    bench::Json& model = row("a_b_c/order:0.5/taps:50/m7:f746");
    model["instructions_per_sample"] = 100;
    model["model_cycles_per_sample"] = 60;
    model["model_cycles_low"] = 55;
    model["model_cycles_high"] = 66;
    model["state_bytes"] = 200;
    model["coefficient_bytes"] = 196;
    row("d_e_f/order:0.5/taps:50/accuracy/signal:step")["error_max"] = 0.125;
    bench::mark_error(row("g_h_i/order:0.5/taps:60/accuracy/signal:step"), "not, finite");
    row("a_b_c/order:0.5/taps:50/host")["real_time"] = 7.5;
    const auto groups = bench::group(rows);
    const auto costs = costs_of(groups);
    bench::WorstBounds bounds;
    bounds["0.5"]["50"] = 0.4375;
    bounds["0.7"]["60"] = 1.0;
    const auto path = std::filesystem::path(testing::TempDir()) / "report_curves.csv";
    write_curves(path, curve_points(groups, costs), costs, bounds);
    EXPECT_EQ(base::read_file(path, 10000),
              "order,kernel,taps,error_max,rounding_error_max,truncation_error_max,truncation_bound,effective_taps,"
              "host_ns,instructions,model_cycles:f746,model_cycles_low:f746,model_cycles_high:f746,bytes,"
              "front:host_ns,front:instructions,front:model_cycles:f746,front:bytes,fault\n"
              "0.5,a_b_c,50,0.5,0.25,0.375,0.4375,49,7.5,100,60,55,66,396,1,1,1,1,\n"
              "0.5,d_e_f,50,0.125,,,0.4375,,,,,,,,0,0,0,0,\n"
              "0.5,g_h_i,60,,,,,,,,,,,,0,0,0,0,\"accuracy: not, finite\"\n");
    std::filesystem::remove(path);
}

// Repetitions by their median; a row that is wrong in one of the two is a difference of its own.
TEST(Differences, AreOfMediansAndOfWhatIsWrong) {
    const auto timed = [](std::initializer_list<double> times) {
        std::vector<bench::Json> rows;
        for (const double ns : times) {
            rows.push_back(bench::make_row("gl/a_b_c/order:0.5/taps:50/host", 1));
            rows.back()["real_time"] = ns;
            rows.back()["cpu_time"] = ns;
            rows.back()["repetition_index"] = rows.size();
        }
        rows.push_back(bench::make_row("gl/a_b_c/order:0.5/taps:50/host", 1));
        rows.back()["run_type"] = "aggregate";
        rows.back()["real_time"] = 1e9;
        return rows;
    };
    auto found = differences(timed({30.0, 10.0, 20.0}), timed({50.0, 10.0, 70.0, 30.0}));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].counter, "real_time");
    EXPECT_EQ(found[0].a, 20.0);
    EXPECT_EQ(found[0].b, 40.0);
    EXPECT_NEAR(found[0].size(), std::log(2.0), 1e-12);
    auto wrong = timed({20.0});
    bench::mark_error(wrong[0], "wrong");
    EXPECT_EQ(differences(wrong, timed({20.0})).at(0).note, "wrong in A");
    EXPECT_EQ(differences(timed({20.0}), wrong).at(0).note, "wrong in B");
    EXPECT_TRUE(differences(wrong, wrong).empty());
    const Difference to_nothing{"x", "c", 4.0, 0.0, ""};
    EXPECT_TRUE(std::isinf(to_nothing.size()));
    EXPECT_EQ(to_csv({to_nothing}), "name,counter,a,b,ratio,note\nx,c,4,0,0,\n");
    EXPECT_TRUE(std::isinf((Difference{"x", "c", -4.0, 2.0, ""}).size()));
    EXPECT_TRUE(std::isinf((Difference{"x", "", {}, {}, "only in A"}).size()));
    EXPECT_NEAR((Difference{"x", "c", 4.0, 2.0, ""}).size(), std::log(2.0), 1e-12);
}

}  // namespace
