// What a timing on the host says besides the time: names, sizes, repetitions, and which cases of a sweep are timed.
#include "bench/host_timing.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bench/designs.hpp"
#include "qemu/failure.hpp"

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
    std::vector<std::string> order;
    for (const bench::Json& row : timing.rows) {
        const std::string name = row.at("run_name").get<std::string>();
        if (order.empty() || order.back() != name) {
            order.push_back(name);
        }
        if (row.at("run_type") == "iteration") {
            ++repetitions[name];
            // Some 2 ms, in whole turns of the ring.
            const auto taps = name.find("taps:50") != std::string::npos  ? 50
                              : name.find("taps:7") != std::string::npos ? 7
                                                                         : 1;
            EXPECT_EQ(row.at("iterations").get<std::int64_t>() % taps, 0) << row;
            EXPECT_GE(row.at("iterations").get<std::int64_t>(), taps);
            EXPECT_LE(row.at("iterations").get<std::int64_t>(), 1000000 * taps);
            EXPECT_FALSE(row.contains("error_occurred")) << row;
            EXPECT_GT(row.at("ns_per_sample").get<double>(), 0.0);
            // Of the same iterations; a busy machine may take the processor away between two readings of its clock.
            EXPECT_NEAR(row.at("ns_per_sample").get<double>() / row.at("cpu_time").get<double>(), 1.0, 1e-6) << row;
            EXPECT_GT(row.at("cycles_per_sample").get<double>() / row.at("cpu_time").get<double>(), 0.01) << row;
        }
    }
    // As they were asked for, whatever turns they took.
    EXPECT_EQ(order, (std::vector<std::string>{
                         "gl/shift_plain_f32/order:0.5/taps:50/host", "gl/ring_plain_q15/order:0.5/taps:7/host",
                         "gl/peer_std_f32/order:0.5/taps:50/host", "gl/null/order:0.5/taps:1/host"}));
    for (const auto& [name, count] : repetitions) {
        EXPECT_EQ(count, 3) << name;
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
    const auto names = names_of(bench::time_on_host(sweep, quick));
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
                    expected.insert(bench::row_name(kernel, order, length, "host"));
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

TEST(HostTiming, AFlagThatIsNoneIsRefused) {
    const std::vector<bench::Timed> one = {{"null", {1}, 0.5}};
    EXPECT_THROW((void)bench::time_on_host(one, 100, 1, {"--no_such_flag"}), glsum::Failure);
    EXPECT_THROW((void)bench::time_on_host(one, 100, 1, {"--benchmark_filter=nothing_is_called_so"}), glsum::Failure);
    EXPECT_EQ(bench::time_on_host(one, 100, 1, {"--benchmark_min_time=0.0001", "--benchmark_filter=."}).rows.size(),
              1U);
}

}  // namespace
