// Rows and their names, and what an entry holds where rows lack something, repeat or contradict each other.
#include "bench/rows/groups.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/columns.hpp"
#include "bench/rows/csv.hpp"
#include "bench/rows/front.hpp"
#include "bench/rows/key.hpp"
#include "bench/rows/row.hpp"
#include "bench/rows/target_fields.hpp"
#include "bench/run/first_line.hpp"

namespace {

bench::Json row_of(const std::string& aspect, const char* counter, double value) {
    bench::Json row = bench::make_row("gl/a/order:0.5/taps:50/" + aspect, 1);
    row[counter] = value;
    return row;
}

bench::Entry entry_of(const std::vector<bench::Json>& rows) { return bench::group(rows).at(0).entries.at(0); }

// What is exact is as exact as anything: it costs less, or it takes less, or it is no better.
TEST(Dominance, HoldsAmongExactOnes) {
    EXPECT_TRUE(bench::dominates({10, 0.0}, {12, 0.0}));
    EXPECT_TRUE(bench::dominates({10, 0.0, 40}, {10, 0.0, 50}));
    EXPECT_FALSE(bench::dominates({12, 0.0}, {10, 0.0}));
    EXPECT_FALSE(bench::dominates({10, 0.0}, {10, 0.0}));
    EXPECT_TRUE(bench::dominates({10, 0.0}, {10, 1e-300}));
    EXPECT_FALSE(bench::dominates({1, 1e-300}, {10, 0.0}));
}

TEST(Groups, AWrongRepetitionIsNoneOfTheMedian) {
    std::vector<bench::Json> rows;
    for (const double ns : {10.0, 20.0, 1000.0}) {
        rows.push_back(row_of("host", "real_time", ns));
        rows.back()["cycles_per_sample"] = 3.0 * ns;
    }
    bench::mark_error(rows.back(), "wrong answer");
    const bench::Entry found = entry_of(rows);
    EXPECT_EQ(found.host_ns, 15.0);
    EXPECT_EQ(found.host_cycles, 45.0);
    EXPECT_EQ(found.fault, "host: wrong answer");
}

// One machine counts the same on all of its cores: where rows do not, the last one speaks.
TEST(Groups, OfAMachineTheLastRowCounts) {
    const bench::Entry found = entry_of(
        {row_of("m7:one", "instructions_per_sample", 100.0), row_of("m7:two", "instructions_per_sample", 101.0)});
    EXPECT_EQ(found.target_instructions, 101.0);
}

TEST(Groups, BytesAreOfStateAndCoefficientsTogether) {
    bench::Json whole = row_of("m7:count", "state_bytes", 0.0);
    EXPECT_EQ(entry_of({whole}).bytes, std::nullopt);
    EXPECT_EQ(entry_of({row_of("m7:count", "coefficient_bytes", 8.0)}).bytes, std::nullopt);
    whole["coefficient_bytes"] = 8.0;
    EXPECT_EQ(entry_of({whole}).bytes, 8.0);
}

// A counter that one signal's row lacks is the worst of the others.
TEST(Groups, WhatARowLacksTakesNothingAway) {
    const bench::Json with = row_of("accuracy/signal:step", "truncation_error_max", 0.25);
    const bench::Json without = row_of("accuracy/signal:ramp", "error_max", 0.5);
    for (const auto& rows : {std::vector{with, without}, std::vector{without, with}}) {
        const bench::Entry found = entry_of(rows);
        EXPECT_EQ(found.truncation_error_max, 0.25);
        EXPECT_EQ(found.error_max, 0.5);
        EXPECT_EQ(found.effective_taps, std::nullopt);
    }
}

// A row says at length that it is right: it is no fault, nor ranked as one.
TEST(Groups, ARowThatIsCalledRightIsRight) {
    bench::Json right = row_of("accuracy/signal:step", "error_max", 0.5);
    right["error_occurred"] = false;
    right["error_message"] = "none";
    EXPECT_EQ(entry_of({right}).fault, "");
    EXPECT_EQ(entry_of({right}).error_max, 0.5);
    EXPECT_FALSE(bench::report::to_tables({right}).at(0).at("texts").contains("fault"));
}

// Of near taps and modes both are told.
TEST(Names, OfALengthAreNumbersWithAPlusBetween) {
    const auto reads = [](const std::string& taps) {
        return bench::parse_key("gl/a/order:0.5/taps:" + taps + "/host").has_value();
    };
    for (const char* good : {"600", "full", "2+7", "2+7+4"}) {
        EXPECT_TRUE(reads(good)) << good;
    }
    for (const char* bad : {"", "+", "5+", "+5", "5++6", "5+6+", "5-6", "full+6"}) {
        EXPECT_FALSE(reads(bad)) << bad;
    }
}

// A band is two numbers with two dots between, whatever dots the numbers have.
TEST(Names, OfABandHaveItsTwoEnds) {
    const auto hz = [](const std::string& text) {
        const auto key = bench::parse_any_key("band/a/order:0.5/taps:1+3/hz:" + text);
        return key ? key->hz : "none";
    };
    for (const char* good : {"1..2", "0.5..1.5", "0.05..80", "1e-05..1e+05"}) {
        EXPECT_EQ(hz(good), good);
    }
    for (const char* bad : {"8", "8.80", "..80", "8..", "a..80", "8..b", "8..80..90", "8..inf", "8...80", "8....80"}) {
        EXPECT_EQ(hz(bad), "none") << bad;
    }
}

// The run's first machine has plain names; another's begin with its word, where the run had both.
TEST(Names, OfAMachinesFieldsAreThoseOfTheContext) {
    const base::Machine& m7 = *base::machine_called("m7");
    const base::Machine& m4 = *base::machine_called("m4");
    EXPECT_EQ(bench::target_field("elf_sha256", m7, true), "elf_sha256");
    EXPECT_EQ(bench::target_field("elf_sha256", m4, false), "m4_elf_sha256");
    const bench::Json both = {{"elf_sha256", "a"}, {"m4_elf_sha256", "b"}};
    EXPECT_EQ(bench::target_field_in(both, "elf_sha256", m7), "elf_sha256");
    EXPECT_EQ(bench::target_field_in(both, "elf_sha256", m4), "m4_elf_sha256");
    const bench::Json alone = {{"elf_sha256", "b"}, {"qemu_version", "7"}};
    EXPECT_EQ(bench::target_field_in(alone, "elf_sha256", m4), "elf_sha256");
}

// Fields of a row that Google Benchmark's tools look for: of one thread, the first repetition of one.
TEST(Rows, HaveWhatGoogleBenchmarksToolsExpect) {
    const bench::Json row = bench::make_row("a", 7);
    EXPECT_EQ(row.at("name"), "a");
    EXPECT_EQ(row.at("run_name"), "a");
    EXPECT_EQ(row.at("run_type"), "iteration");
    EXPECT_EQ(row.at("repetitions"), 1);
    EXPECT_EQ(row.at("repetition_index"), 0);
    EXPECT_EQ(row.at("threads"), 1);
    EXPECT_EQ(row.at("iterations"), 7);
    EXPECT_EQ(row.at("time_unit"), "ns");
    EXPECT_FALSE(bench::is_timed(row));
    EXPECT_FALSE(bench::is_wrong(row));
}

TEST(Rows, ATimeIsTheWallsAndTheProcessorsAlike) {
    bench::RowKey key;
    key.kernel = "a";
    key.order = "0.5";
    key.taps = "50";
    key.aspect = "m7:x";
    bench::Row made(key, 1);
    made.set_time(12.5);
    const bench::Json row = std::move(made).take();
    EXPECT_EQ(row.at("real_time"), 12.5);
    EXPECT_EQ(row.at("cpu_time"), 12.5);
    EXPECT_TRUE(bench::is_timed(row));
}

// A row without the number of its repetition is the first; one that another program made may lack it.
TEST(Rows, WithoutTheNumberOfARepetitionAreTheFirst) {
    bench::Json row = row_of("m7:count", "instructions_per_sample", 9.0);
    row.erase("repetition_index");
    EXPECT_EQ(bench::to_tidy_csv({row}),
              "kernel,order,taps,target,signal,amplitude,repetition,counter,value,unit\n"
              "a,0.5,50,m7:count,,,0,instructions_per_sample,9.0,instructions\n");
}

TEST(FirstLine, IsWhatACommandPrintsUpToItsEnd) {
    EXPECT_EQ(bench::first_line("printf 'one\\ntwo\\n'"), "one");
    EXPECT_EQ(bench::first_line("printf one"), "one");
    EXPECT_EQ(bench::first_line("printf '\\ntwo\\n'"), "");
    EXPECT_EQ(bench::first_line("true"), "");
    EXPECT_EQ(bench::first_line("printf '%5000s\\n' end"), std::string(4997, ' ') + "end");
    EXPECT_EQ(bench::first_line("/nonexistent/program 2>/dev/null"), "");
}

}  // namespace
