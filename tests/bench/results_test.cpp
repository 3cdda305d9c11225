// Reading rows, and which of them are ranked.
#include "bench/rows/groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/table.hpp"
#include "bench/rows/csv.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/sweep.hpp"

namespace {

bench::Json accuracy(const std::string& kernel, double error, const std::string& signal = "step") {
    bench::Json row = bench::make_row("gl/" + kernel + "/order:0.5/taps:50/accuracy/signal:" + signal, 1);
    row["error_max"] = error;
    row["rounding_error_max"] = error / 2;
    return row;
}

bench::Json timing(const std::string& kernel, const std::string& aspect, double cost) {
    bench::Json row = bench::make_row("gl/" + kernel + "/order:0.5/taps:50/" + aspect, 1);
    row[aspect == "host" ? "real_time" : "instructions_per_sample"] = cost;
    return row;
}

const bench::Entry& entry(const std::vector<bench::Group>& groups, const std::string& kernel) {
    for (const auto& e : groups.at(0).entries) {
        if (e.kernel == kernel) {
            return e;
        }
    }
    throw std::runtime_error("no entry " + kernel);
}

TEST(Results, TheCatalogueAloneKnowsTheFormatOfAKernel) {
    EXPECT_EQ(bench::number_format_of("ring_plain_q31"), "q31");
    EXPECT_EQ(bench::number_format_of("mirror_smlaldshaped_q15"), "q15");
    for (const char* foreign : {"null", "fir", "another_program_q31", "ring_plain_f33", "ring_plain_f32_", ""}) {
        EXPECT_EQ(bench::number_format_of(foreign), "unknown") << foreign;
    }
}

TEST(Results, NamesAreShortestRoundTripAndReadBack) {
    EXPECT_EQ(to_name(bench::row_key("ring_plain_f32", 0.98319, {600}, "host")),
              "gl/ring_plain_f32/order:0.98319/taps:600/host");
    EXPECT_EQ(to_name(bench::row_key("null", -0.5, {1000, true}, "m7:count")), "gl/null/order:-0.5/taps:full/m7:count");
    EXPECT_EQ(to_name(bench::row_key("null", 1.0, {1}, "host")), "gl/null/order:1/taps:1/host");
    const auto key = bench::parse_key("gl/ring_plain_f32/order:0.5/taps:2+7/accuracy/signal:sine5");
    ASSERT_TRUE(key);
    EXPECT_EQ(key->kernel, "ring_plain_f32");
    EXPECT_EQ(key->order, "0.5");
    EXPECT_EQ(key->taps, "2+7");
    EXPECT_EQ(key->aspect, "accuracy");
    EXPECT_EQ(key->signal, "sine5");
    EXPECT_FALSE(bench::parse_key("drive/niopdt/ring_plain_f32/taps:50/host"));
    EXPECT_FALSE(bench::parse_key("gl/ring_plain_f32/order:0.5"));
    EXPECT_FALSE(bench::parse_key("gl/ring_plain_f32/order:0.5/taps:50/host/"));
    EXPECT_FALSE(bench::parse_key("gl/ring_plain_f32/order:0.5/taps:50/accuracy/signal:step/other"));
    EXPECT_FALSE(bench::parse_key("ring_plain_f32/order:0.5/taps:50/host"));
    EXPECT_TRUE(bench::parse_key("gl/ring_plain_f32/order:-1e-05/taps:50/m7:m7-ideal_mean"));
    for (const char* name : {"gl/a\";system(\"id\")/order:0.5/taps:50/host", "gl/a/order:0.5\"/taps:50/host",
                             "gl/a/order:half/taps:50/host", "gl/a/order:inf/taps:50/host", "gl/a/order:1/taps:x/host",
                             "gl/a/order:1/taps:99999999999999999999/host", "gl/a/order:1/taps:50/ho\033st",
                             "gl/a/order:1/taps:50/accuracy/signal:a b", "gl//order:1/taps:50/host"}) {
        EXPECT_FALSE(bench::parse_key(name)) << name;
    }
}

// Of every kind a name is put together as it was taken apart, and has a place of its own for each part.
TEST(Results, EveryKindOfNameIsReadAsItIsWritten) {
    for (const char* name :
         {"gl/ring_plain_f32/order:0.5/taps:2+7/accuracy/signal:sine5/amplitude:0.0625",
          "gl/ring_plain_f32/order:-0.5/taps:full/m7:stm32f746-itcm", "gl/null/order:1/taps:1/host",
          "gl/a/order:1/taps:50/accuracy/amplitude:0.5", "drive/niopdt/ringdelta_plain_f32/taps:2+7/m7:count",
          "record/peer_fftw_f64/order:0.5/samples:1000/host", "horizon/nested/order:0.5/error:1e-06/samples:600",
          "horizon/modes/order:0.5/error:1e-06/samples:600/m4:cortex-m4-zerowait",
          "filter/oustaloup_f64/order:0.5/poles:7/accuracy/signal:step", "band/charef_f32/order:0.5/taps:1+3/hz:8..80",
          "derivative/modes_plain_f32/order:0.5/taps:1+5/m7:stm32f746-itcm/hz:0.05..80/until:60",
          "derivative/modes_plain_f32/order:0.5/taps:1+5/host/until:60",
          "derivative/modes_plain_f32/order:0.5/taps:1+5/accuracy/hz:0.05..80"}) {
        const auto key = bench::parse_any_key(name);
        ASSERT_TRUE(key) << name;
        EXPECT_EQ(to_name(*key), name);
        EXPECT_EQ(bench::parse_key(name).has_value(), key->kind == bench::RowKind::sum) << name;
    }
    const auto model = bench::parse_any_key("drive/niopdt/ringdelta_plain_f32/taps:2+7/m7:count").value();
    EXPECT_EQ(model.model, "niopdt");
    EXPECT_EQ(model.kernel, "ringdelta_plain_f32");
    EXPECT_TRUE(model.is_target());
    EXPECT_EQ(model.core(), bench::count_only);
    EXPECT_EQ(model.machine(), base::machine_called("m7"));
    const auto other = bench::parse_any_key("gl/a/order:1/taps:50/m4:cortex-m4-zerowait").value();
    EXPECT_EQ(other.machine(), base::machine_called("m4"));
    EXPECT_EQ(other.core(), "cortex-m4-zerowait");
    EXPECT_EQ(other.aspect, bench::on_target(*other.machine(), other.core()));
    EXPECT_FALSE(bench::parse_any_key("gl/a/order:1/taps:50/m5:core").value().is_target());
    const auto filter = bench::parse_any_key("filter/oustaloup_f64/order:0.5/poles:7/accuracy/signal:step").value();
    EXPECT_EQ(filter.poles, "7");
    EXPECT_EQ(filter.signal, "step");
    EXPECT_TRUE(filter.is_accuracy());
    for (const char* name : {"filter/oustaloup_f64/order:0.5/poles:7/accuracy", "drive/a/b/taps:x/host",
                             "drive/a/taps:50/host", "horizon/nested/order:0.5/error:1e-06/samples:600/host", "gl", "",
                             "gl/", "other/a/order:1", "derivative/a/order:1/taps:5/host/hz:80",
                             "derivative/a/order:1/taps:5/host/until:60/hz:1..2", "record/a/order:0.5/samples:/host"}) {
        EXPECT_FALSE(bench::parse_any_key(name)) << name;
    }
    EXPECT_EQ(subject_of(*bench::parse_key("gl/a/order:1/taps:50/accuracy/signal:step")), "gl/a/order:1/taps:50");
    EXPECT_EQ(bench::rows_of("a"), "gl/a/*");
}

TEST(Results, CellsOfACsvAreQuotedWhereTheyMustBe) {
    bench::Json row = timing("a", "host", 1.5);
    row["label"] = "one, \"two\"";
    row["plain"] = "three";
    const std::string csv = bench::to_csv({row});
    EXPECT_EQ(csv.substr(csv.find('\n') + 1),
              "gl/a/order:0.5/taps:50/host,a,0.5,50,host,,,1,1.5,0.0,\"one, \"\"two\"\"\",three\n");
}

TEST(Results, TheWorstSignalCounts) {
    const auto groups = bench::group({accuracy("a", 1e-3), accuracy("a", 5e-3, "ramp"), accuracy("a", 2e-3, "noise")});
    EXPECT_EQ(entry(groups, "a").error_max, 5e-3);
}

TEST(Results, OfRepetitionsTheMedianCounts) {
    std::vector<bench::Json> rows = {accuracy("a", 1e-3)};
    for (const double ns : {50.0, 10.0, 20.0}) {
        rows.push_back(timing("a", "host", ns));
        rows.back()["repetition_index"] = rows.size();
    }
    EXPECT_EQ(entry(bench::group(rows), "a").host_ns, 20.0);
    rows.push_back(timing("a", "host", 30));
    EXPECT_EQ(entry(bench::group(rows), "a").host_ns, 25.0);
}

TEST(Results, TheFrontHoldsWhatNothingBeatsAtItsError) {
    const auto groups = bench::group({
        accuracy("exact", 1e-6),
        timing("exact", "host", 50),
        timing("exact", "m7:count", 500),
        accuracy("cheap", 1e-2),
        timing("cheap", "host", 10),
        timing("cheap", "m7:count", 100),
        accuracy("slow", 1e-6),
        timing("slow", "host", 60),
        timing("slow", "m7:count", 600),
        accuracy("near", 1.005e-6),
        timing("near", "host", 40),
        timing("near", "m7:count", 700),
    });
    EXPECT_FALSE(entry(groups, "exact").host_front);  // "near" has the same error within 1 % and costs less
    EXPECT_TRUE(entry(groups, "exact").target_front);
    EXPECT_TRUE(entry(groups, "cheap").host_front);
    EXPECT_TRUE(entry(groups, "near").host_front);
    EXPECT_FALSE(entry(groups, "near").target_front);
    EXPECT_FALSE(entry(groups, "slow").host_front);
    EXPECT_FALSE(entry(groups, "slow").target_front);
    EXPECT_NE(bench::to_table(groups, false).find("dominated"), std::string::npos);
}

TEST(Results, AWrongRowIsNeverRanked) {
    bench::Json wrong = timing("fast", "host", 1);
    bench::mark_error(wrong, "wrong answer");
    const auto groups =
        bench::group({accuracy("fast", 1e-9), wrong, timing("fast", "m7:count", 1), accuracy("right", 1e-6),
                      timing("right", "host", 50), timing("right", "m7:count", 500)});
    EXPECT_FALSE(entry(groups, "fast").target_front);  // wrong in one place, trusted in none
    EXPECT_TRUE(entry(groups, "right").target_front);
    EXPECT_FALSE(entry(groups, "fast").host_front);
    EXPECT_TRUE(entry(groups, "right").host_front);
    EXPECT_NE(bench::to_table(groups, false).find("wrong answer"), std::string::npos);
}

// Under its heading each kernel's numbers, the best error first, and what speaks against it.
TEST(Table, SaysOfEachKernelWhatItIsAndWhatSpeaksAgainstIt) {
    bench::Entry worse;
    worse.kernel = "worse";
    worse.error_max = 0.25;
    bench::Entry best;
    best.kernel = "best";
    best.error_max = 1e-3;
    best.rounding_error_max = 1e-7;
    best.host_ns = 12.5;
    best.host_cycles = 40.0;
    best.target_instructions = 300.25;
    best.target_worst = 310.0;
    best.bytes = 400.0;
    best.host_front = true;
    bench::Entry software = best;
    software.kernel = "software";
    software.error_max = 1e-2;
    software.software_double = true;
    software.host_front = false;
    software.target_front = true;
    bench::Entry slow = software;
    slow.kernel = "slow";
    slow.error_max = 0.125;
    slow.target_front = false;
    bench::Entry faulty = software;
    faulty.kernel = "faulty";
    faulty.error_max.reset();
    faulty.fault = "wrong\x1b[31m";
    const std::string table = bench::to_table({{"0.5", "50", {worse, faulty, slow, software, best}}}, false);
    const auto line = [&](const std::string& kernel) {
        const std::size_t from = table.find("\n  " + kernel + ' ') + 1;
        return table.substr(from, table.find('\n', from) - from);
    };
    std::istringstream words(line("best"));
    EXPECT_EQ((std::vector<std::string>{std::istream_iterator<std::string>(words), {}}),
              (std::vector<std::string>{"best", "1.00e-03", "1.00e-07", "12.5*", "40", "300.2", "310", "400"}));
    EXPECT_NE(line("software").find("300.2*"), std::string::npos);
    EXPECT_TRUE(line("software").ends_with("  400  double in software on the M7")) << line("software");
    EXPECT_TRUE(line("slow").ends_with("  400  dominated; double in software on the M7")) << line("slow");
    EXPECT_TRUE(line("worse").ends_with("  -  dominated")) << line("worse");
    EXPECT_TRUE(line("faulty").ends_with("  400  wrong [31m")) << line("faulty");
    EXPECT_LT(table.find("  best"), table.find("  software"));
    EXPECT_LT(table.find("  slow"), table.find("  worse"));
    EXPECT_LT(table.find("  worse"), table.find("  faulty"));  // without an error last
    // On a terminal what is on no front steps back, and so does what is wrong.
    const std::string coloured = bench::to_table({{"0.5", "50", {best, slow, faulty}}}, true);
    EXPECT_NE(coloured.find("\n" + line("best") + "\n"), std::string::npos);
    EXPECT_NE(coloured.find("\n\x1b[2m" + line("slow") + "\x1b[0m\n"), std::string::npos);
    EXPECT_NE(coloured.find("\n\x1b[2m" + line("faulty") + "\x1b[0m\n"), std::string::npos);
    // Of modelled cores the cycles and their band instead of the most instructions.
    bench::Entry modelled = best;
    modelled.model_cycles["b-core"] = {200.0, 190.0, 215.0};
    modelled.model_cycles["a-core"] = {150.0, {}, {}};
    modelled.target_front = true;
    const std::string cycles = bench::to_table({{"0.5", "2+7", {modelled, software}}}, false);
    EXPECT_NE(cycles.find("order 0.5, 2+7 taps; M7 cycles modelled for a-core, then b-core\n"), std::string::npos);
    std::istringstream more(cycles.substr(cycles.find("\n  best ")));
    std::string first;
    std::getline(more, first);
    std::getline(more, first);
    std::istringstream fields(first);
    EXPECT_EQ((std::vector<std::string>{std::istream_iterator<std::string>(fields), {}}),
              (std::vector<std::string>{"best", "1.00e-03", "1.00e-07", "12.5*", "40", "300.2", "150.0*", "-", "200.0",
                                        "190", "to", "215", "400"}));
}

TEST(Results, NamesHaveTheirLengths) {
    const auto reads = [](const std::string& kernel, const std::string& taps = "50", const std::string& aspect = "host",
                          const std::string& rest = "") {
        return bench::parse_key("gl/" + kernel + "/order:0.5/taps:" + taps + '/' + aspect + rest).has_value();
    };
    EXPECT_TRUE(reads(std::string(64, 'k')));
    EXPECT_FALSE(reads(std::string(65, 'k')));
    EXPECT_FALSE(reads("k\x80"));
    EXPECT_TRUE(reads("k", "123456789012345678"));
    EXPECT_FALSE(reads("k", "1234567890123456789"));
    EXPECT_FALSE(reads("k", "+5"));
    EXPECT_TRUE(reads("k", "5+6"));
    EXPECT_TRUE(reads("k", "full"));
    EXPECT_FALSE(reads("k", "fuller"));
    EXPECT_FALSE(reads("k", "50", ""));
    EXPECT_TRUE(reads("k", "50", "accuracy", "/signal:step/amplitude:0.0625"));
    EXPECT_FALSE(reads("k", "50", "accuracy", "/amplitude:0.0625/signal:step"));
    EXPECT_FALSE(reads("k", "50", "accuracy", "/signal:step/amplitude:small"));
    EXPECT_EQ(bench::taps_number("7"), 7.0);
    EXPECT_EQ(bench::taps_number("1"), 1.0);
    EXPECT_EQ(bench::taps_number("2+7+4"), 13.0);
    EXPECT_EQ(bench::taps_number("0+0"), std::nullopt);
}

// Which kernels the target carries out in software the catalogue says, not a label.
TEST(Results, DoubleInSoftwareFollowsFromTheKernel) {
    const auto in_software = [](const std::string& kernel, const std::string& aspect, const std::string& label) {
        bench::Json row = timing(kernel, aspect, 300.0);
        row["label"] = label;
        return entry(bench::group({row}), kernel).software_double;
    };
    EXPECT_TRUE(in_software("shift_plain_f64", "m7:count", "instructions only"));
    EXPECT_TRUE(in_software("ring_plain_f32a64", "m7:f746", ""));
    EXPECT_FALSE(in_software("shift_plain_f64", "host", ""));
    EXPECT_FALSE(in_software("ring_plain_f32", "m7:count", "double precision in software"));
    EXPECT_FALSE(in_software("another_plain_f64", "m7:count", "double precision in software"));
}

// What an entry holds of its rows: of accuracy the worst of each counter, of the target what its last row says.
TEST(Results, EachCounterHasItsPlace) {
    bench::Json step = accuracy("a", 1e-3);
    bench::Json ramp = accuracy("a", 5e-4, "ramp");
    step["truncation_error_max"] = 1e-4;
    ramp["truncation_error_max"] = 2e-4;
    step["effective_taps"] = 48;
    ramp["effective_taps"] = 49;
    bench::Json host = timing("a", "host", 20.0);
    host["cycles_per_sample"] = 60.0;
    host["state_bytes"] = 7;
    host["coefficient_bytes"] = 8;
    bench::Json model = timing("a", "m7:f746", 300.0);
    model["worst_instructions"] = 310.0;
    model["model_cycles_per_sample"] = 200.0;
    model["model_cycles_low"] = 190.0;
    model["model_cycles_high"] = 220.0;
    model["state_bytes"] = 100;
    model["coefficient_bytes"] = 96;
    for (const bool turned : {false, true}) {
        std::vector<bench::Json> rows = {step, ramp, host, model};
        if (turned) {
            std::reverse(rows.begin(), rows.end());
        }
        const auto groups = bench::group(rows);
        ASSERT_EQ(groups.size(), 1U);
        const bench::Entry& found = entry(groups, "a");
        EXPECT_EQ(found.error_max, 1e-3);
        EXPECT_EQ(found.rounding_error_max, 5e-4);
        EXPECT_EQ(found.truncation_error_max, 2e-4);
        EXPECT_EQ(found.effective_taps, 49.0);
        EXPECT_EQ(found.host_ns, 20.0);
        EXPECT_EQ(found.host_cycles, 60.0);
        EXPECT_EQ(found.target_instructions, 300.0);
        EXPECT_EQ(found.target_worst, 310.0);
        EXPECT_EQ(found.model_cycles.at("f746").median, 200.0);
        EXPECT_EQ(found.model_cycles.at("f746").low, 190.0);
        EXPECT_EQ(found.model_cycles.at("f746").high, 220.0);
        EXPECT_EQ(found.bytes, 196.0);  // the target's, where there are any
    }
    EXPECT_EQ(entry(bench::group({host}), "a").bytes, 15.0);
    // The amplitude sweep, means and other rows are no part of it; one order's times are those of every order.
    bench::Json scaled = accuracy("a", 0.5);
    scaled["name"] = scaled["name"].get<std::string>() + "/amplitude:0.0625";
    bench::Json mean = host;
    mean["run_type"] = "aggregate";
    mean["real_time"] = 1.0;
    bench::Json other_order = accuracy("a", 1e-4);
    other_order["name"] = "gl/a/order:0.7/taps:50/accuracy/signal:step";
    const auto groups = bench::group({step, scaled, mean, other_order, host, bench::make_row("BM_other", 1)});
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(groups[0].order, "0.5");
    EXPECT_EQ(groups[1].order, "0.7");
    for (const bench::Group& group : groups) {
        ASSERT_EQ(group.entries.size(), 1U);
        EXPECT_EQ(group.entries[0].host_ns, 20.0);
        EXPECT_EQ(group.taps, "50");
    }
    EXPECT_EQ(groups[0].entries[0].error_max, 1e-3);
}

// Of two emulated machines the first one counts, whichever row comes first; cycles of cores are told apart by machine.
TEST(Results, TheFirstMachineCountsBesideAnother) {
    const auto row = [](const std::string& aspect, double instructions, double cycles, double bytes) {
        bench::Json one = timing("a", aspect, instructions);
        one["worst_instructions"] = instructions + 1.0;
        one["model_cycles_per_sample"] = cycles;
        one["state_bytes"] = bytes;
        one["coefficient_bytes"] = 0.0;
        return one;
    };
    const bench::Json m4 = row("m4:another", 110.0, 150.0, 12.0);
    const bench::Json m7 = row("m7:core", 100.0, 60.0, 8.0);
    for (const auto& rows : {std::vector{m4, m7, accuracy("a", 1e-3)}, std::vector{m7, m4, accuracy("a", 1e-3)}}) {
        const auto groups = bench::group(rows);
        const bench::Entry& found = entry(groups, "a");
        EXPECT_EQ(found.counted_on, base::machine_called("m7"));
        EXPECT_EQ(found.target_instructions, 100.0);
        EXPECT_EQ(found.target_worst, 101.0);
        EXPECT_EQ(found.bytes, 8.0);
        EXPECT_EQ(found.model_cycles.at("another").machine, base::machine_called("m4"));
        EXPECT_EQ(found.model_cycles.at("core").machine, base::machine_called("m7"));
        const auto cores = bench::modelled_cores(groups);
        ASSERT_EQ(cores.size(), 2U);
        EXPECT_EQ(cores[0].name, "core");  // "another" would be the first by name
        EXPECT_EQ(bench::counted_on(groups), base::machine_called("m7"));
    }
    const auto alone = bench::group({m4});
    EXPECT_EQ(entry(alone, "a").counted_on, base::machine_called("m4"));
    EXPECT_EQ(entry(alone, "a").target_instructions, 110.0);
    EXPECT_EQ(entry(alone, "a").bytes, 12.0);
    EXPECT_EQ(bench::counted_on(bench::group({accuracy("a", 1e-3)})), nullptr);
}

TEST(Results, WithinOnePercentItIsTheSameError) {
    for (const auto& [factor, beaten] : {std::pair(1.009, true), std::pair(1.011, false)}) {
        const auto groups = bench::group({accuracy("exact", 1e-6), timing("exact", "host", 50),
                                          accuracy("near", factor * 1e-6), timing("near", "host", 40)});
        EXPECT_EQ(entry(groups, "exact").host_front, !beaten) << factor;
        EXPECT_TRUE(entry(groups, "near").host_front);
    }
    // Of modelled cores the first by name decides, of equal costs none beats the other.
    bench::Json one = timing("one", "m7:b", 1.0);
    one["model_cycles_per_sample"] = 10.0;
    bench::Json two = timing("one", "m7:a", 1.0);
    two["model_cycles_per_sample"] = 30.0;
    bench::Json other = timing("other", "m7:a", 1.0);
    other["model_cycles_per_sample"] = 20.0;
    const auto groups = bench::group({accuracy("one", 1e-6), accuracy("other", 1e-6), one, two, other});
    EXPECT_FALSE(entry(groups, "one").target_front);
    EXPECT_TRUE(entry(groups, "other").target_front);
    const auto same =
        bench::group({accuracy("a", 1e-6), timing("a", "host", 5), accuracy("b", 1e-6), timing("b", "host", 5)});
    EXPECT_TRUE(entry(same, "a").host_front);
    EXPECT_TRUE(entry(same, "b").host_front);
    // Of equal costs the more accurate one does, where that is more than one percent.
    for (const auto& [factor, beaten] : {std::pair(1.009, false), std::pair(1.011, true)}) {
        const auto groups = bench::group({accuracy("better", 1e-6), timing("better", "host", 5),
                                          accuracy("worse", factor * 1e-6), timing("worse", "host", 5)});
        EXPECT_EQ(entry(groups, "worse").host_front, !beaten) << factor;
        EXPECT_TRUE(entry(groups, "better").host_front);
    }
}

// A column for each field but the bookkeeping, in the order in which they are met; cells that a row lacks are empty.
TEST(Results, ACsvHasAColumnForEachField) {
    bench::Json first = accuracy("a", 0.5);
    first["signal"] = "x";
    bench::Json second = bench::make_row("BM_other/8", 7);
    second["extra"] = true;
    second["threads"] = 4;
    const std::string csv = bench::to_csv({first, second});
    const std::string head = csv.substr(0, csv.find('\n'));
    EXPECT_TRUE(head.starts_with("name,kernel,order,taps,aspect,signal,amplitude,")) << head;
    for (const char* field : {"threads", "run_type", "repetition_index", "family_index", "time_unit", "run_name"}) {
        EXPECT_EQ(head.find(field), std::string::npos) << head;
    }
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    const std::string behind = csv.substr(csv.find('\n') + 1);
    const std::string last = behind.substr(behind.find('\n') + 1);
    EXPECT_TRUE(last.starts_with("BM_other/8,,,,,,,")) << last;
    EXPECT_NE(last.find(",true"), std::string::npos) << last;
    const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
    EXPECT_EQ(commas(head), commas(last));
    EXPECT_EQ(commas(head), commas(behind.substr(0, behind.find('\n'))));
}

// A number a line, with its unit; no bookkeeping, no time of what was not timed, nothing wrong and nobody else's row.
TEST(Results, ATidyCsvHasALineForEachNumber) {
    bench::Json error = bench::make_row("gl/a/order:0.5/taps:2+7/accuracy/signal:step", 7);
    error["error_max"] = 0.25;
    error["coefficient_bytes"] = 36;
    bench::Json time = bench::make_row("gl/a/order:0.5/taps:600/host", 7);
    time["real_time"] = 12.5;
    time["repetition_index"] = 3;
    bench::Json core = bench::make_row("gl/a/order:0.5/taps:600/m7:count", 7);
    core["instructions_per_sample"] = 99.0;
    core["stall_load_use"] = 1.5;
    bench::Json wrong = error;
    bench::mark_error(wrong, "overflows");
    const std::string csv = bench::to_tidy_csv({error, time, core, wrong, bench::make_row("BM_other/8", 7)});
    EXPECT_EQ(csv,
              "kernel,order,taps,target,signal,amplitude,repetition,counter,value,unit\n"
              "a,0.5,2+7,accuracy,step,,0,error_max,0.25,largest exact sum\n"
              "a,0.5,2+7,accuracy,step,,0,coefficient_bytes,36,bytes\n"
              "a,0.5,600,host,,,3,real_time,12.5,ns\n"
              "a,0.5,600,host,,,3,cpu_time,0.0,ns\n"
              "a,0.5,600,m7:count,,,0,instructions_per_sample,99.0,instructions\n"
              "a,0.5,600,m7:count,,,0,stall_load_use,1.5,cycles\n");
}

}  // namespace
