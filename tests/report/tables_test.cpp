// What a run recommends, at the edges: limits, ties, units, and runs that lack one thing or another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/best.hpp"
#include "bench/report/classic.hpp"
#include "bench/report/curves.hpp"
#include "bench/report/difference.hpp"
#include "bench/report/discretisation_table.hpp"
#include "bench/report/front_table.hpp"
#include "bench/report/page.hpp"
#include "bench/report/table.hpp"
#include "bench/rows/counters.hpp"
#include "glsum/catalogue.hpp"

namespace {

using namespace bench::report;
using testing::HasSubstr;
using testing::Not;

// A kernel's rows: what it errs, and one counter of another aspect.
struct OneCost {
    const char* aspect;
    const char* counter;
    std::vector<bench::Json> rows = {};
    void add(const std::string& kernel, const std::string& order, const std::string& taps, double error, double cost) {
        const std::string name = "gl/" + kernel + "/order:" + order + "/taps:" + taps;
        rows.emplace_back(bench::make_row(name + "/accuracy/signal:step", 1))["error_max"] = error;
        rows.emplace_back(bench::make_row(name + "/" + aspect, 1))[counter] = cost;
    }
};

OneCost cycles() { return {"m7:f746", "model_cycles_per_sample"}; }
OneCost host_times() { return {"host", "real_time"}; }

template <class Table>
std::string table_of(const OneCost& run, Table table) {
    const auto groups = bench::group(run.rows);
    const auto costs = costs_of(groups);
    return table(curve_points(groups, costs), costs);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

using Words = std::vector<std::string>;

// From 1e-1 to 1e-7, each kernel once, where it is the cheapest first.
TEST(FrontTable, HasTheDecadesFrom1e1To1e7) {
    OneCost run = cycles();
    run.add("ring_plain_f32", "0.5", "10", 0.5, 1);
    run.add("ring_plain_f32", "0.5", "20", 0.05, 10);
    run.add("ring_plain_f32", "0.5", "50", 5e-7, 50);
    run.add("ring_plain_f32", "0.5", "600", 5e-8, 100);
    run.add("ring_plain_f64", "0.5", "600", 5e-9, 1000);
    std::vector<Words> shown;
    for (const std::string& line : lines_of(table_of(run, front_table))) {
        if (const Words words = words_of(line); words.size() == 5 && words[1].starts_with("ring_")) {
            shown.push_back(words);
        }
    }
    EXPECT_EQ(shown, (std::vector<Words>{{"5.0e-02", "ring_plain_f32", "20", "10", "-"},
                                         {"5.0e-07", "ring_plain_f32", "50", "50", "-"},
                                         {"5.0e-08", "ring_plain_f32", "600", "100", "-"}}));
}

// What is beside the cheapest kernel: a window, another window, or none.
TEST(FrontTable, NamesTheUnitOfTheCostThatDecides) {
    OneCost timed = host_times();
    timed.add("modes_plain_f32", "0.5", "2+7", 5e-3, 12.34);
    const std::string ns = table_of(timed, front_table);
    EXPECT_THAT(ns, HasSubstr("order 0.5: the cheapest within each decade of error, by time on this machine\n"));
    EXPECT_THAT(ns, HasSubstr("  Within 1e-2: modes_plain_f32 2+7, 12.3 ns; no window of this run errs so little.\n"
                              "  Within 1e-4: no kernel of this run.\n"));
    OneCost counted{"m4:count", "instructions_per_sample"};
    counted.add("ring_plain_f32", "0.5", "600", 5e-5, 99.0);
    const std::string instructions = table_of(counted, front_table);
    EXPECT_THAT(instructions, HasSubstr(", by instructions of the emulated Cortex-M4, which are not cycles\n"));
    EXPECT_THAT(instructions, HasSubstr("  Within 1e-2: ring_plain_f32 600, 99 instructions; a window.\n"
                                        "  Within 1e-4: ring_plain_f32 600, 99 instructions; a window.\n"));
    OneCost modelled{"m4:fast", "model_cycles_per_sample"};
    modelled.add("ring_plain_f32", "0.5", "600", 5e-5, 99.0);
    EXPECT_THAT(table_of(modelled, front_table), HasSubstr(", by cycles of a Cortex-M4, modelled for fast\n"));
}

bench::Entry timed_entry(const char* kernel, double error, double ns) {
    bench::Entry made;
    made.kernel = kernel;
    made.error_max = error;
    made.host_ns = ns;
    return made;
}

const Cost host_ns{Cost::Kind::host_time, "", "host_ns", "host",
                   [](const bench::Entry& entry) { return entry.host_ns; }};

TEST(Best, OfEqualCostIsTheMoreExactAndOfEqualsTheFirst) {
    const bench::Entry exact = timed_entry("exact", 0x1p-10, 8.0);
    const bench::Entry rough = timed_entry("rough", 0x1p-9, 8.0);
    const bench::Entry equal = timed_entry("equal", 0x1p-10, 8.0);
    const bench::Group group{"0.5", "50", {}};
    const auto first_of = [&](const std::vector<const bench::Entry*>& entries, double limit) {
        std::vector<CurvePoint> points;
        for (const bench::Entry* entry : entries) {
            points.push_back({&group, entry, {}});
        }
        const CurvePoint* const found = cheapest(points, host_ns, "0.5", limit, Memory::any);
        return found == nullptr ? std::string("none") : found->entry->kernel;
    };
    EXPECT_EQ(first_of({&exact, &rough, &equal}, 0.5), "exact");
    EXPECT_EQ(first_of({&rough, &equal, &exact}, 0.5), "equal");
    EXPECT_EQ(first_of({&rough, &exact}, 0x1p-10), "exact");  // it errs no more than that
    EXPECT_EQ(first_of({&rough, &exact}, 0x1p-11), "none");
}

// 1e-2, 1e-3, 1e-4 and 1e-6, to the half per cent.
TEST(Best, ItsLimitsAreWhatItsTablesSay) {
    const bench::Group group{"0.5", "50", {}};
    const std::vector<double> limits = {1e-2, 1e-3, 1e-4, 1e-6};
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const bench::Entry below = timed_entry("below", 0.995 * limits[i], 10.0);
        const bench::Entry above = timed_entry("above", 1.005 * limits[i], 1.0);
        const std::vector<CurvePoint> points = {{&group, &below, {true}}, {&group, &above, {true}}};
        const std::vector<Best> found = best_of(points, {host_ns}, 0);
        ASSERT_EQ(found.size(), limits.size());
        ASSERT_NE(found[i].point, nullptr);
        EXPECT_EQ(found[i].point->entry->kernel, "below") << limits[i];
        EXPECT_DOUBLE_EQ(found[i].limit, limits[i]);
    }
}

TEST(Best, ItsTableHasTenthsOfNanosecondsAndWholeInstructions) {
    const auto first_line = [](const OneCost& run) {
        const std::string text = table_of(run, best_table);
        EXPECT_THAT(text, HasSubstr("\ndominated at every order and length: none\n"));
        return words_of(lines_of(text).at(3));
    };
    OneCost timed = host_times();
    timed.add("modes_plain_f32", "0.5", "2+7", 5e-3, 12.34);
    timed.add("ring_plain_f32", "0.5", "600", 6e-4, 98.76);
    EXPECT_EQ(first_line(timed),
              (Words{"0.5", "1e-02", "modes_plain_f32", "2+7", "12.3", "ring_plain_f32", "600", "98.8"}));
    OneCost counted{"m7:count", "instructions_per_sample"};
    counted.add("modes_plain_f32", "0.5", "2+7", 5e-3, 100.0);
    EXPECT_EQ(first_line(counted), (Words{"0.5", "1e-02", "modes_plain_f32", "2+7", "100", "none"}));
}

// What a run lacks cannot be ranked.
TEST(Best, WithoutACostThatDecidesThereIsNothingToSay) {
    OneCost sized{"m7:count", "state_bytes"};
    sized.add("ring_plain_f32", "0.5", "600", 5e-3, 2400.0);
    EXPECT_EQ(table_of(sized, best_table), "");
    EXPECT_EQ(table_of(sized, front_table), "");
    OneCost wrong = host_times();
    wrong.add("ring_plain_f32", "0.5", "600", 5e-3, 2400.0);
    bench::mark_error(wrong.rows.front(), "not finite");
    EXPECT_EQ(table_of(wrong, best_table), "");
    EXPECT_EQ(table_of(wrong, front_table), "");
    EXPECT_EQ(table_of(wrong, gain_table), "");
}

TEST(Gain, OfWhatIsFreeIsNoFactor) {
    const bench::Group group{"0.5", "50", {}};
    const bench::Entry before = timed_entry("before", 1e-3, 12.0);
    const bench::Entry after = timed_entry("after", 1e-3, 3.0);
    const bench::Entry gift = timed_entry("gift", 1e-3, 0.0);
    const CurvePoint costly{&group, &before, {}};
    const CurvePoint cheap{&group, &after, {}};
    const CurvePoint nothing{&group, &gift, {}};
    EXPECT_EQ(factor({"0.5", 1e-2, &costly, &cheap}, host_ns), 4.0);
    EXPECT_EQ(factor({"0.5", 1e-2, &costly, &nothing}, host_ns), std::nullopt);
    EXPECT_EQ(factor({"0.5", 1e-2, nullptr, &cheap}, host_ns), std::nullopt);
    EXPECT_EQ(factor({"0.5", 1e-2, &costly, nullptr}, host_ns), std::nullopt);
}

// A line for each order and limit, and below one for each limit, of the orders that have a factor there.
TEST(Gain, ItsTableEndsWithTheSpreadOverTheOrders) {
    OneCost run = cycles();
    for (const auto& [order, most] : {std::pair("0.3", 250.0), std::pair("0.5", 1000.0), std::pair("0.7", 500.0)}) {
        run.add("ring_plain_f32", order, "full", 5e-5, most);
        run.add("modes_plain_f32", order, "2+7", 5e-5, 50.0);
    }
    const std::vector<std::string> lines = lines_of(table_of(run, gain_table));
    ASSERT_EQ(lines.size(), 22U);  // a head of four, three orders at four limits, and the spread
    for (const std::string& line : lines) {
        EXPECT_FALSE(line.ends_with(' ')) << line;
    }
    EXPECT_THAT(lines[2], testing::EndsWith("f746, modelled cycles per sample"));
    EXPECT_EQ(words_of(lines[3]), (Words{"order", "error", "before", "after", "factor"}));
    EXPECT_EQ(words_of(lines[4]), (Words{"0.3", "1e-02", "250", "50", "5.0"}));
    EXPECT_EQ(words_of(lines[7]), (Words{"0.3", "1e-06", "none", "none"}));
    EXPECT_EQ(words_of(lines[8]), (Words{"0.5", "1e-02", "1000", "50", "20.0"}));
    EXPECT_EQ(words_of(lines[14]), (Words{"0.7", "1e-04", "500", "50", "10.0"}));
    EXPECT_EQ(words_of(lines[17]), (Words{"factors", "smallest", "median", "largest"}));
    EXPECT_EQ(words_of(lines[18]), (Words{"all", "1e-02", "5.0", "10.0", "20.0"}));
    EXPECT_EQ(words_of(lines[20]), (Words{"all", "1e-04", "5.0", "10.0", "20.0"}));
    EXPECT_EQ(words_of(lines[21]), (Words{"all", "1e-06", "none", "none", "none"}));
}

TEST(Gain, ItsTableHasTenthsOfNanoseconds) {
    OneCost run = host_times();
    run.add("ring_plain_f32", "0.5", "600", 5e-3, 98.76);
    run.add("modes_plain_f32", "0.5", "2+7", 5e-3, 12.345);
    EXPECT_EQ(words_of(lines_of(table_of(run, gain_table)).at(4)), (Words{"0.5", "1e-02", "98.8", "12.3", "8.0"}));
}

// Fronts are set anew: what was on one before is on none when it may not be ranked any more.
TEST(Curves, WhatIsNotRankedLosesItsFront) {
    const bench::Group group{"0.5", "50", {}};
    bench::Entry faulty = timed_entry("faulty", 1e-9, 1.0);
    const bench::Entry good = timed_entry("good", 1e-3, 10.0);
    const std::vector<Cost> costs = {host_ns};
    std::vector<CurvePoint> points = {{&group, &faulty, {false}}, {&group, &good, {false}}};
    set_fronts(points, costs);
    EXPECT_EQ(points[0].front, std::vector<bool>{true});
    EXPECT_EQ(points[1].front, std::vector<bool>{false});
    faulty.fault = "wrong";
    set_fronts(points, costs);
    EXPECT_EQ(points[0].front, std::vector<bool>{false});
    EXPECT_EQ(points[1].front, std::vector<bool>{true});
}

TEST(Curves, InstructionsAreOfTheMachineThatCountedThem) {
    for (const auto& [aspect, title] :
         {std::pair("m7:count", "emulated Cortex-M7, instructions per sample (not cycles)"),
          std::pair("m4:count", "emulated Cortex-M4, instructions per sample (not cycles)")}) {
        OneCost counted{aspect, "instructions_per_sample"};
        counted.add("ring_plain_f32", "0.5", "600", 5e-5, 99.0);
        const auto groups = bench::group(counted.rows);
        EXPECT_EQ(costs_of(groups).at(0).title, title);
    }
}

// Of rows that are not ours nobody knows whether they were timed: their times are compared.
TEST(Differences, OfAnotherProgramAreItsTimesToo) {
    bench::Json a = bench::make_row("BM_other/8", 1);
    a["real_time"] = 10.0;
    bench::Json b = a;
    b["real_time"] = 20.0;
    b["cpu_time"] = 20.0;
    const auto found = differences({a}, {b});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].counter, "real_time");
}

TEST(Differences, TheirCsvIsEmptyWhereNothingIsKnown) {
    const Difference half{"x", "c", 4.0, {}, ""};
    EXPECT_EQ(to_csv({half}), "name,counter,a,b,ratio,note\nx,c,4,,,\n");
}

// Of equal sizes as the files have them.
TEST(Differences, OfOneSizeStayInTheirOrder) {
    std::vector<bench::Json> a;
    for (const char* name : {"c", "a", "b"}) {
        a.push_back(bench::make_row(name, 1));
    }
    std::vector<std::string> names;
    for (const Difference& one : differences(a, {})) {
        names.push_back(one.name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"c", "a", "b"}));
}

std::string table_line(const std::string& table, const std::string& kernel) {
    const std::size_t from = table.find("\n  " + kernel + ' ') + 1;
    return table.substr(from, table.find('\n', from) - from);
}

// A fault is from a file: what would steer a terminal is a space, and what is printed stays.
TEST(Table, OfAFaultShowsWhatCanBePrinted) {
    bench::Entry faulty = timed_entry("faulty", 1e-3, 1.0);
    faulty.fault = "a!\x7f\x1f~";
    EXPECT_THAT(table_line(bench::to_table({{"0.5", "50", {faulty}}}, false), "faulty"), testing::EndsWith("  a!  ~"));
}

TEST(Table, EqualErrorsStayInTheirOrder) {
    const std::string table = bench::to_table(
        {{"0.5", "50", {timed_entry("one", 1e-3, 1.0), timed_entry("two", 1e-3, 1.0), timed_entry("six", 1e-3, 1.0)}}},
        false);
    EXPECT_LT(table.find("\n  one "), table.find("\n  two "));
    EXPECT_LT(table.find("\n  two "), table.find("\n  six "));
}

// Cycles are of one machine or another; only what was modelled is called so, and a band has both its ends.
TEST(Table, EachGroupNamesTheCoresThatItWasModelledFor) {
    const base::Machine* const m4 = base::machine_called("m4");
    bench::Entry plain = timed_entry("plain", 1e-3, 1.0);
    const std::string unmodelled = bench::to_table({{"0.5", "50", {plain}}}, false);
    EXPECT_THAT(unmodelled, HasSubstr("\norder 0.5, 50 taps\n"));
    EXPECT_THAT(unmodelled, HasSubstr("M7 worst"));
    EXPECT_THAT(unmodelled, Not(HasSubstr("of the timing model")));
    bench::Entry both = timed_entry("both", 1e-3, 1.0);
    both.model_cycles["one"] = {100.0, 90.0, {}};
    both.model_cycles["two"] = {200.0, {}, 210.0};
    both.model_cycles["a4"] = {300.0, 290.0, 310.0, m4};
    const std::string table =
        bench::to_table({{"0.5", "50", {plain}}, {"0.5", "60", {both}}, {"0.5", "70", {plain}}}, false);
    EXPECT_THAT(table, HasSubstr("\norder 0.5, 50 taps\n"));
    EXPECT_THAT(table, HasSubstr("\norder 0.5, 60 taps; M7 cycles modelled for one, then two; M4 cycles modelled for "
                                 "a4\n"));
    EXPECT_THAT(table, HasSubstr("\norder 0.5, 70 taps\n"));
    EXPECT_THAT(table, HasSubstr("M7 cycles: per sample, of the timing model, not of silicon"));
    EXPECT_EQ(words_of(table_line(table, "both")),
              (Words{"both", "1.00e-03", "-", "1.0", "-", "-", "100.0", "-", "200.0", "-", "300.0", "290", "to", "310",
                     "-", "dominated"}));
}

TEST(Table, CountedOnAnotherMachineAloneItSaysSo) {
    bench::Entry slow = timed_entry("slow", 1e-3, 1.0);
    slow.counted_on = base::machine_called("m4");
    slow.software_double = true;
    slow.host_front = true;
    const std::string counted = bench::to_table({{"0.5", "50", {slow}}}, false);
    EXPECT_THAT(counted, HasSubstr("M4 instr."));
    EXPECT_THAT(counted, HasSubstr("M4 worst"));
    EXPECT_THAT(table_line(counted, "slow"), testing::EndsWith("double in software on the M4"));
}

// A line for each order and a column for each signal, as they come; the late errors in a table of their own.
TEST(DiscretisationTable, HasACellForEachOrderAndSignal) {
    std::vector<bench::Json> rows;
    const auto add = [&](const std::string& name, double error) -> bench::Json& {
        rows.push_back(bench::make_row("gl/ring_plain_f32/" + name, 1));
        rows.back()["discretisation_error_max"] = error;
        return rows.back();
    };
    add("order:0.5/taps:50/accuracy/signal:step", 0.25);
    add("order:0.5/taps:50/accuracy/signal:sine5", 0.125)["discretisation_error_late_max"] = 0.0625;
    add("order:-0.5/taps:50/accuracy/signal:step", 0.5);
    add("order:0.5/taps:50/accuracy/signal:step/amplitude:0.5", 0.75);  // another question
    add("order:0.5/taps:many/accuracy/signal:step", 0.75);              // not ours
    rows.push_back(bench::make_row("gl/ring_plain_f32/order:0.9/taps:50/accuracy/signal:noise", 1));
    const std::vector<std::string> lines = lines_of(bench::discretisation_table({{"weights", "gl"}}, rows));
    ASSERT_EQ(lines.size(), 9U);
    EXPECT_THAT(lines[1], testing::StartsWith("discretisation error max, weights gl: "));
    EXPECT_EQ(words_of(lines[2]), (Words{"order", "step", "sine5"}));
    EXPECT_EQ(words_of(lines[3]), (Words{"0.5", "2.50e-01", "1.25e-01"}));
    EXPECT_EQ(words_of(lines[4]), (Words{"-0.5", "5.00e-01", "-"}));
    EXPECT_EQ(lines[6], "the same in the second half of the record");
    EXPECT_EQ(words_of(lines[7]), (Words{"order", "sine5"}));
    EXPECT_EQ(words_of(lines[8]), (Words{"0.5", "6.25e-02"}));
}

bench::Json data_of(const std::string& page) {
    const std::size_t begin = page.find("id=\"data\">") + 10;
    const std::string data = page.substr(begin, page.find("</script>", begin) - begin);
    // One line of ASCII, whatever character set a reader takes.
    EXPECT_EQ(std::ranges::count(data, '\n'), 0);
    EXPECT_TRUE(std::ranges::all_of(data, [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
    return bench::Json::parse(data);
}

TEST(Page, SaysWhatTheTableOfCountersSays) {
    Input input{"a.json", {}, {}};
    input.results.context["cpu"] = "f\u00fcnf";
    const bench::Json data = data_of(make_page(input, nullptr));
    EXPECT_EQ(data.at("files").size(), 1U);
    EXPECT_EQ(data.at("files")[0].at("context").at("cpu"), "f\u00fcnf");
    std::size_t next = 0;
    for (const bench::CounterFacts& facts : bench::counter_table()) {
        if (facts.shown == bench::Shown::nowhere) {
            continue;
        }
        const bench::Json& counter = data.at("counters").at(next++);
        const auto text = [&](const char* field) { return counter.at(field).get<std::string>(); };
        EXPECT_EQ(text("name"), facts.name);
        EXPECT_EQ(text("unit"), facts.unit) << facts.name;
        EXPECT_EQ(counter.at("is_time"), facts.role == bench::Role::time) << facts.name;
        EXPECT_EQ(text("better"), bench::name_of(facts.better)) << facts.name;
        EXPECT_EQ(text("layer"), bench::name_of(facts.layer)) << facts.name;
        EXPECT_EQ(counter.at("compared"), facts.shown != bench::Shown::listed) << facts.name;
        EXPECT_EQ(counter.at("drawn"), facts.shown == bench::Shown::drawn) << facts.name;
    }
    EXPECT_EQ(data.at("counters").size(), next);
    for (const glsum::CatalogueEntry& entry : glsum::catalogue) {
        const auto found = data.at("kernels").find(std::string(entry.name));
        ASSERT_EQ(found != data.at("kernels").end(), !entry.format.empty()) << entry.name;
        if (!entry.format.empty()) {
            EXPECT_EQ(found->at("format").get<std::string>(), entry.format) << entry.name;
            EXPECT_EQ(found->at("fixed").get<bool>(), !entry.floating_point) << entry.name;
        }
    }
}

TEST(Page, OfTwoFilesIsCalledAfterBoth) {
    const Input one{"a&b \"c\".json", {}, {}};
    const Input other{"d.json", {}, {}};
    const std::string page = make_page(one, &other);
    EXPECT_THAT(page, HasSubstr("<title>glsum: a&amp;b &quot;c&quot;.json and d.json</title>"));
    const bench::Json data = data_of(page);
    ASSERT_EQ(data.at("files").size(), 2U);
    EXPECT_EQ(data.at("files")[0].at("name"), one.name);
    EXPECT_EQ(data.at("files")[1].at("name"), other.name);
}

}  // namespace
