// What a timing on the host says besides the time: names, sizes, repetitions, and which cases of a sweep are timed.
#include "bench/host/host_timing.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/failure.hpp"
#include "bench/host/peer_numbers.hpp"
#include "bench/host/timed_rows.hpp"
#include "bench/sweep/designs.hpp"

namespace {

const std::vector<std::string> quick = {"--benchmark_min_time=0.0001"};

std::set<std::string> names_of(const bench::HostTiming& timing) {
    std::set<std::string> names;
    for (const bench::Json& row : timing.rows) {
        names.insert(row.at("name").get<std::string>());
    }
    return names;
}

TEST(HostTiming, RepetitionsKeepTheirNameAndOrder) {
    const std::vector<bench::Timed> cases = {
        {"shift_plain_f32", {50}, 0.5}, {"ring_plain_q15", {7}, 0.5}, {"peer_std_f32", {50}, 0.5}, {"null", {1}, 0.5}};
    const bench::HostTiming timing = bench::time_on_host(cases, 1000, 3, {});
    ASSERT_EQ(timing.rows.size(), 4U * 3U + 4U * 4U);  // mean, median, stddev and cv of each
    std::map<std::string, int> repetitions;
    std::map<std::string, std::string> rows_of;
    std::vector<std::string> order;
    for (const bench::Json& row : timing.rows) {
        const std::string name = row.at("run_name").get<std::string>();
        if (order.empty() || order.back() != name) {
            order.push_back(name);
        }
        // How often it ran is not in the name: only what an aggregate is of.
        EXPECT_EQ(row.at("name"),
                  row.at("run_type") == "iteration" ? name : name + '_' + row.at("aggregate_name").get<std::string>());
        rows_of[name] +=
            row.at("run_type") == "iteration" ? std::to_string(row.at("repetition_index").get<int>()) : "a";
        if (row.at("run_type") == "iteration") {
            ++repetitions[name];
            // Some 2 ms, in whole turns of the ring.
            const auto taps = name.find("taps:50") != std::string::npos  ? 50
                              : name.find("taps:7") != std::string::npos ? 7
                                                                         : 1;
            EXPECT_EQ(row.at("iterations").get<std::int64_t>() % taps, 0) << row;
            EXPECT_GE(row.at("iterations").get<std::int64_t>(), taps);
            EXPECT_LE(row.at("iterations").get<std::int64_t>(), 1000000 * taps);
            // Far below what was asked for: the estimate was of something else.
            EXPECT_GE(row.at("iterations").get<double>() * row.at("ns_per_sample").get<double>(), 2e5) << row;
            EXPECT_FALSE(row.contains("error_occurred")) << row;
            EXPECT_GT(row.at("ns_per_sample").get<double>(), 0.0);
            // Of the same iterations; a busy machine may take the processor away between two readings of its clock.
            EXPECT_NEAR(row.at("ns_per_sample").get<double>() / row.at("cpu_time").get<double>(), 1.0, 1e-6) << row;
            // Some counters go on while the processor is another program's, others do not.
            EXPECT_GT(row.at("cycles_per_sample").get<double>() / row.at("cpu_time").get<double>(), 0.01) << row;
            EXPECT_LT(row.at("cycles_per_sample").get<double>() / row.at("real_time").get<double>(), 100.0) << row;
        }
    }
    // As they were asked for, whatever turns they took.
    EXPECT_EQ(order, (std::vector<std::string>{
                         "gl/shift_plain_f32/order:0.5/taps:50/host", "gl/ring_plain_q15/order:0.5/taps:7/host",
                         "gl/peer_std_f32/order:0.5/taps:50/host", "gl/null/order:0.5/taps:1/host"}));
    for (const auto& [name, count] : repetitions) {
        EXPECT_EQ(count, 3) << name;
        EXPECT_EQ(rows_of[name], "012aaaa") << name;  // its repetitions one after the other, then what sums them up
    }
    const bench::Json& kernel = timing.rows.front();
    EXPECT_EQ(kernel.at("macs_per_sample"), 49.0);  // a_0 = 1 needs none
    EXPECT_EQ(kernel.at("coefficient_bytes"), 4.0 * 49.0);
    for (const bench::Json& row : timing.rows) {
        if (row.at("run_name") == "gl/peer_std_f32/order:0.5/taps:50/host" && row.at("run_type") == "iteration") {
            EXPECT_EQ(row.at("macs_per_sample"), 50.0);
            EXPECT_EQ(row.at("coefficient_bytes"), 200.0);
            EXPECT_EQ(row.at("state_bytes"), 400.0);  // a doubled buffer
        }
    }
    EXPECT_EQ(timing.context.at("host_timing_order"), "0.5");
    EXPECT_NE(timing.context.at("cycle_counter").get<std::string>().find("cycles"), std::string::npos);
}

// Once for each kernel, peer and length: time depends on no order.
TEST(HostTiming, OfASweepEachCaseOnceAtItsFirstOrder) {
    bench::Sweep sweep;
    sweep.kernels = {"ring_plain_f32", "mirrordelta_plain_f32", "modes_plain_f32", "nested_plain_f32"};
    sweep.peers = {"peer_std_f32"};
    sweep.orders = {-1.5, 0.5, 0.9};
    sweep.lengths = {{9}, {16}};
    sweep.design_errors = {1e-2};
    sweep.samples = 300;
    const bench::HostTiming timing = bench::time_on_host(sweep, quick);
    for (const bench::Json& row : timing.rows) {
        EXPECT_FALSE(row.contains("error_occurred")) << row;  // each answer was checked
    }
    const auto names = names_of(timing);
    std::set<std::string> expected;
    for (const char* taps : {"9", "16"}) {
        expected.insert(std::string("gl/ring_plain_f32/order:-1.5/taps:") + taps + "/host");
        expected.insert(std::string("gl/mirrordelta_plain_f32/order:0.5/taps:") + taps + "/host");  // takes no -1.5
        expected.insert(std::string("gl/peer_std_f32/order:-1.5/taps:") + taps + "/host");
    }
    for (const char* kernel : {"modes_plain_f32", "nested_plain_f32"}) {
        std::set<std::string> seen;
        for (const double order : sweep.orders) {
            for (const bench::Length& length : bench::lengths_of(sweep, kernel, order)) {
                if (seen.insert(length.text()).second) {
                    expected.insert(to_name(bench::row_key(kernel, order, length, "host")));
                }
            }
        }
        EXPECT_FALSE(seen.empty()) << kernel;
    }
    EXPECT_EQ(names, expected);
    sweep.kernels.clear();
    sweep.peers.clear();
    EXPECT_TRUE(bench::time_on_host(sweep, quick).rows.empty());
}

// No order above 2 has weights: such a case is a row that says so, and no time.
TEST(HostTiming, WhatCannotBePreparedSaysWhy) {
    for (const unsigned repetitions : {1U, 2U}) {
        const bench::HostTiming timing =
            bench::time_on_host({bench::Timed{"ring_plain_f32", {9}, 2.5}}, 100, repetitions, quick);
        ASSERT_FALSE(timing.rows.empty());
        for (const bench::Json& row : timing.rows) {
            EXPECT_EQ(row.at("error_message"), "the order is not in (-2, 2]") << row;
            EXPECT_FALSE(row.contains("cycles_per_sample"));
        }
    }
}

TEST(HostTiming, AFlagThatIsNoneIsRefused) {
    const std::vector<bench::Timed> one = {{"null", {1}, 0.5}};
    EXPECT_THROW((void)bench::time_on_host(one, 100, 1, {"--no_such_flag"}), glsum::Failure);
    testing::internal::CaptureStderr();
    EXPECT_THROW((void)bench::time_on_host(one, 100, 1, {"--benchmark_filter=nothing_is_called_so"}), glsum::Failure);
    // The refusal says it all: what Google Benchmark writes beside it would be told twice.
    EXPECT_EQ(testing::internal::GetCapturedStderr().find("Failed to match"), std::string::npos);
    EXPECT_EQ(bench::time_on_host(one, 100, 1, {"--benchmark_min_time=0.0001", "--benchmark_filter=."}).rows.size(),
              1U);
}

TEST(TimedRows, IterationsAreSome2MsInWholeTurns) {
    EXPECT_EQ(bench::iterations_for(20.0, 50), 100000);  // 2e6 ns of 20 ns each
    EXPECT_EQ(bench::iterations_for(30.0, 600), 67200);  // 66 667, and on to the end of the turn
    EXPECT_EQ(bench::iterations_for(1e9, 600), 600);
    EXPECT_EQ(bench::iterations_for(2.0, 1), 1000000);
    EXPECT_EQ(bench::iterations_for(1.0, 1), 1000000);  // no more turns than that
    EXPECT_EQ(bench::iterations_for(1.0, 2), 2000000);
    EXPECT_EQ(bench::iterations_for(0.1, 40), 40 * 500000);
    EXPECT_EQ(bench::iterations_for(0.0, 40), 40 * 500000);  // no clock tells less
}

TEST(TimedRows, ANameLosesItsIterationsAndNothingElse) {
    const auto name_of = [](const char* name) {
        bench::Json row = {{"name", name}, {"label", "/iterations:5"}};
        bench::drop_iterations(row, "name");
        bench::drop_iterations(row, "not there");
        EXPECT_EQ(row.at("label"), "/iterations:5");
        EXPECT_EQ(row.size(), 2U);
        return row.at("name").get<std::string>();
    };
    EXPECT_EQ(name_of("gl/a/taps:50/host/iterations:1000/repeats:3"), "gl/a/taps:50/host/repeats:3");
    EXPECT_EQ(name_of("gl/a/taps:50/host/iterations:1000_mean"), "gl/a/taps:50/host_mean");
    EXPECT_EQ(name_of("gl/a/taps:50/host/iterations:1"), "gl/a/taps:50/host");
    EXPECT_EQ(name_of("gl/a/taps:50/host"), "gl/a/taps:50/host");
}

std::vector<reference::Real> reals(const std::vector<double>& values) { return {values.begin(), values.end()}; }

// Each term of n is rounded in its two factors, their product and n - 1 additions: (n + 2) half units, and a little.
TEST(PeerNumbers, InSinglePrecisionTheBoundIsOfEveryRounding) {
    const bench::PeerTable table(reals({1.0, -0.5, -0.125}));
    EXPECT_EQ(table.largest, 1.0);
    EXPECT_EQ(table.absolute_sum, 1.625);
    EXPECT_EQ(table.coefficients, (std::vector<double>{1.0, -0.5, -0.125}));
    using Numbers = bench::PeerNumbers<bench::F32Dot>;
    const double rounded = 5.0 * 0x1p-24 * 0.9 * 1.625;
    EXPECT_GT(Numbers::bound(table), rounded);
    EXPECT_LT(Numbers::bound(table), 1.011 * rounded);
    EXPECT_EQ(Numbers::coefficient(0.1), 0.1F);
    EXPECT_EQ(Numbers::sample(0.1), 0.1F);
    EXPECT_EQ(Numbers::real(0.1F), static_cast<double>(0.1F));
}

TEST(PeerNumbers, InQ31ACoefficientOrASumThatIsTooLargeTakesABit) {
    using Numbers = bench::PeerNumbers<bench::Q31Dot>;
    const auto bits = [](const std::vector<double>& weights) { return Numbers(bench::PeerTable(reals(weights))).bits; };
    EXPECT_EQ(bits({1.0, -0.5}), 29);
    EXPECT_EQ(bits({1.0, 3.99}), 29);
    EXPECT_EQ(bits({1.0, 4.0}), 28);  // 2^31 in 29 bits
    EXPECT_EQ(bits({-3.0, 3.0, 1.99}), 29);
    EXPECT_EQ(bits({-3.0, 3.0, 2.0}), 28);  // a sum of 2^63
    EXPECT_EQ(bits({9.0}), 27);
    const Numbers numbers(bench::PeerTable(reals({1.0, -0.5})));
    EXPECT_EQ(numbers.coefficient(1.0), 1 << 29);
    EXPECT_EQ(numbers.coefficient(-0.5), -(1 << 28));
    EXPECT_EQ(numbers.coefficient(0x3p-31), 1);  // 3/4 to nearest
    EXPECT_EQ(Numbers::sample(0.5), 1 << 30);
    EXPECT_EQ(Numbers::sample(0x3p-33), 1);
    EXPECT_EQ(numbers.real(std::int64_t{1} << 60), 1.0);
    // Half a unit of each of two coefficients, of samples up to 1; half a unit of each sample, times its coefficient.
    const double rounded = 2.0 * 0x1p-30 + 1.5 * 0x1p-32;
    const double bound = numbers.bound(bench::PeerTable(reals({1.0, -0.5})));
    EXPECT_GT(bound, rounded);
    EXPECT_LT(bound, rounded + 0.0151 * 0x1p-32);
}

}  // namespace
