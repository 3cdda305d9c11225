// Reading rows, and which of them are ranked.
#include "bench/results.hpp"

#include <gtest/gtest.h>

#include "bench/sweep.hpp"
#include "bench/table.hpp"

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

TEST(Results, NamesAreShortestRoundTripAndReadBack) {
    EXPECT_EQ(bench::row_name("ring_plain_f32", 0.98319, {600}, "host"),
              "gl/ring_plain_f32/order:0.98319/taps:600/host");
    EXPECT_EQ(bench::row_name("null", -0.5, {1000, true}, "m7:count"), "gl/null/order:-0.5/taps:full/m7:count");
    EXPECT_EQ(bench::row_name("null", 1.0, {1}, "host"), "gl/null/order:1/taps:1/host");
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

}  // namespace
