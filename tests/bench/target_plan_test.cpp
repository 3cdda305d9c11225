// What the target is to run for a sweep.
#include "bench/target/target_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/sweep/signals.hpp"
#include "bench/target/count_path.hpp"

namespace {

bench::Sweep sweep_of(std::vector<double> orders, const std::vector<std::size_t>& lengths) {
    bench::Sweep sweep;
    sweep.kernels = {"null",          "shift_plain_f64",  "shift_plain_f32", "ring_plain_f32", "mirror_simd_f32",
                     "shift_fir_q31", "mirror_smlald_q15"};
    sweep.orders = std::move(orders);
    for (const std::size_t taps : lengths) {
        sweep.lengths.push_back({taps});
    }
    sweep.signals.assign(std::begin(bench::signal_names), std::end(bench::signal_names));
    sweep.samples = 5000;
    return sweep;
}

TEST(TargetPlan, EveryKernelMeetsEverySignalAndEveryRowIsReplayed) {
    for (const auto& sweep : {sweep_of({0.5}, {50}), sweep_of({0.5, -0.5}, {50, 5000}),
                              sweep_of({0.5, 0.7, 0.9, 1.5, 1.9909, -0.5, 0.3}, {50}),
                              sweep_of({0.5, 0.9, 1.9909, -0.5}, {50, 100, 200, 600, 1000})}) {
        const bench::TargetPlan plan = bench::make_target_plan(sweep);
        ASSERT_EQ(plan.rows.size(), 6 * sweep.orders.size() * sweep.lengths.size());
        std::map<std::string, std::set<std::size_t>> met;
        std::set<std::size_t> replayed;
        for (const auto& replay : plan.replays) {
            const auto& row = plan.rows.at(replay.row);
            EXPECT_EQ(replay.planned.kernel, row.kernel);
            EXPECT_EQ(replay.planned.order, row.order);
            EXPECT_EQ(replay.planned.taps, row.length.taps);
            EXPECT_EQ(replay.planned.calls, std::min<std::size_t>(row.length.taps + 64, row.software_double ? 128 : 1100));
            met[row.kernel].insert(replay.planned.signal);
            replayed.insert(replay.row);
        }
        EXPECT_EQ(replayed.size(), plan.rows.size());
        EXPECT_EQ(plan.replays.size(), std::max<std::size_t>(plan.rows.size(), 6 * 7));
        ASSERT_EQ(met.size(), 6U);
        for (const auto& [kernel, signals] : met) {
            EXPECT_EQ(signals, (std::set<std::size_t>{0, 1, 2, 3, 4, 5, 6})) << kernel;
        }
    }
}

TEST(TargetPlan, CountsOnceWhatMustComeOutTheSame) {
    const bench::Sweep sweep = sweep_of({0.5, 0.7, 1.9909, -0.5}, {50, 600});
    const bench::TargetPlan plan = bench::make_target_plan(sweep);
    std::map<std::string, std::size_t> counts;
    for (const auto& count : plan.counts) {
        EXPECT_EQ(count.signal, sweep.signals.size());
        ++counts[count.kernel];
    }
    for (const char* kernel : {"null", "shift_plain_f64", "shift_plain_f32", "ring_plain_f32"}) {
        EXPECT_EQ(counts[kernel], 2U) << kernel;
    }
    EXPECT_EQ(counts["mirror_smlald_q15"], 6U);  // 0.5 and 0.7 have one scale
    EXPECT_EQ(counts.count("mirror_simd_f32"), 0U);
    for (const auto& row : plan.rows) {
        const auto& count = plan.counts.at(row.count);
        EXPECT_EQ(count.kernel, row.kernel);
        EXPECT_EQ(count.taps, row.length.taps);
        EXPECT_EQ(bench::count_path(count.kernel, {count.order, count.taps}),
                  bench::count_path(row.kernel, {row.order, row.length.taps}));
        EXPECT_EQ(row.software_double, row.kernel == "shift_plain_f64");
    }
    EXPECT_EQ(plan.counts.front().order, bench::count_order(sweep));
}

TEST(TargetPlan, ACallInSoftwareDoubleIsDear) {
    EXPECT_EQ(bench::estimated_cost({"ring_plain_f32", 0.5, 10, 0, 3}), 30.0);
    EXPECT_EQ(bench::estimated_cost({"shift_plain_f64", 0.5, 10, 0, 3}), 300.0);
}

}  // namespace
