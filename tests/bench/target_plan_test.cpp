// What the target is to run for a sweep.
#include "bench/target/target_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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
            EXPECT_EQ(replay.planned.calls,
                      std::min<std::size_t>(row.length.taps + 64, row.software_double ? 128 : 1100));
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

// Of a kernel's rows each replays the signal of its place, of the next kernel's the one behind. Four rows are fewer
// than five signals: the first row replays two.
TEST(TargetPlan, SignalsAndPiecesAreDealtInTurn) {
    bench::Sweep sweep;
    sweep.kernels = {"shift_plain_f64", "ring_plain_f32"};
    sweep.orders = {0.5, 0.7};
    sweep.lengths = {{50}, {200}};
    sweep.signals = {"step", "ramp", "sine1", "noise", "drive"};
    sweep.samples = 250;
    const bench::TargetPlan plan = bench::make_target_plan(sweep);
    const struct {
        const char* kernel;
        double order;
        std::size_t taps;
        std::size_t piece;
        std::vector<std::size_t> signals;
        std::size_t calls;  // 64 behind the window, of the record, and in software double no more than 128
    } known[] = {{"shift_plain_f64", 0.5, 50, 0, {0, 4}, 114}, {"ring_plain_f32", 0.5, 50, 1, {1, 0}, 114},
                 {"shift_plain_f64", 0.5, 200, 2, {1}, 128},   {"ring_plain_f32", 0.5, 200, 3, {2}, 250},
                 {"shift_plain_f64", 0.7, 50, 0, {2}, 114},    {"ring_plain_f32", 0.7, 50, 1, {3}, 114},
                 {"shift_plain_f64", 0.7, 200, 2, {3}, 128},   {"ring_plain_f32", 0.7, 200, 3, {4}, 250}};
    ASSERT_EQ(plan.rows.size(), std::size(known));
    ASSERT_EQ(plan.counts.size(), 4U);
    std::size_t replay = 0;
    for (std::size_t i = 0; i < std::size(known); ++i) {
        const bench::TargetPlan::Row& row = plan.rows[i];
        EXPECT_EQ(row.kernel, known[i].kernel) << i;
        EXPECT_EQ(row.order, known[i].order) << i;
        EXPECT_EQ(row.length.taps, known[i].taps) << i;
        EXPECT_EQ(row.piece, known[i].piece) << i;
        EXPECT_EQ(row.count, i % 4) << i;  // of both orders the same
        EXPECT_EQ(row.software_double, i % 2 == 0) << i;
        for (const std::size_t signal : known[i].signals) {
            ASSERT_LT(replay, plan.replays.size());
            EXPECT_EQ(plan.replays[replay].row, i);
            EXPECT_EQ(plan.replays[replay].planned.kernel, known[i].kernel);
            EXPECT_EQ(plan.replays[replay].planned.signal, signal) << i;
            EXPECT_EQ(plan.replays[replay].planned.calls, known[i].calls) << i;
            ++replay;
        }
    }
    EXPECT_EQ(replay, plan.replays.size());
    for (std::size_t i = 0; i < plan.counts.size(); ++i) {
        EXPECT_EQ(plan.counts[i].kernel, known[i].kernel);
        EXPECT_EQ(plan.counts[i].order, 0.5);
        EXPECT_EQ(plan.counts[i].taps, known[i].taps);
        EXPECT_EQ(plan.counts[i].calls, qemu::calls_to_measure(known[i].kernel, known[i].taps));
    }
}

// Of pieces 0 and 2: rows by their piece, each with the count and the replays that it had.
TEST(TargetPlan, APartHasWhatItsPiecesNeed) {
    const auto planned = [](std::size_t taps, std::size_t calls) {
        return qemu::PlannedRow{"ring_plain_f32", 0.5, taps, 0, calls};
    };
    const auto row = [](const char* kernel, std::size_t count, std::size_t piece) {
        return bench::TargetPlan::Row{kernel, 0.5, {3}, false, count, piece};
    };
    bench::TargetPlan whole;
    whole.counts = {planned(1, 10), planned(2, 10), planned(3, 10), planned(4, 10)};
    whole.rows = {row("a", 3, 2), row("b", 0, 1), row("c", 1, 0), row("d", 3, 2), row("e", 2, 0), row("f", 2, 1)};
    whole.replays = {{0, planned(5, 7)}, {1, planned(6, 7)}, {2, planned(7, 7)},
                     {4, planned(8, 7)}, {4, planned(9, 7)}, {3, planned(11, 7)}};
    const bench::TargetPlan part = bench::part_of(whole, {0, 2});
    ASSERT_EQ(part.rows.size(), 4U);
    const struct {
        const char* kernel;
        std::size_t piece;
        std::size_t count;
        std::size_t taps;  // of the count
    } known[] = {{"c", 0, 0, 2}, {"e", 0, 1, 3}, {"a", 2, 2, 4}, {"d", 2, 2, 4}};
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
        EXPECT_EQ(part.rows[i].kernel, known[i].kernel);
        EXPECT_EQ(part.rows[i].piece, known[i].piece);
        EXPECT_EQ(part.rows[i].count, known[i].count);
        EXPECT_EQ(part.counts.at(part.rows[i].count).taps, known[i].taps);
    }
    EXPECT_EQ(part.counts.size(), 3U);
    std::vector<std::pair<std::size_t, std::size_t>> replays;
    for (const bench::TargetPlan::Replay& replay : part.replays) {
        replays.emplace_back(replay.row, replay.planned.taps);
    }
    EXPECT_EQ(replays, (std::vector<std::pair<std::size_t, std::size_t>>{{2, 5}, {0, 7}, {1, 8}, {1, 9}, {3, 11}}));
    EXPECT_TRUE(bench::part_of(whole, {}).rows.empty());
    // A count once for its piece, each replay: 10 calls of so many taps, or 7.
    EXPECT_EQ(bench::piece_costs(whole),
              (std::vector<double>{10 * (2 + 3) + 7 * (7 + 8 + 9), 10 * (1 + 3) + 7 * 6, 10 * 4 + 7 * (5 + 11)}));
    EXPECT_TRUE(bench::piece_costs({}).empty());
}

TEST(CountPath, IsOfTheDesignsModesBlocksAndScale) {
    EXPECT_EQ(bench::count_path("ring_plain_f32", {0.5, 50}), bench::CountPath{});
    EXPECT_EQ(bench::count_path("ring_plain_f32", {2.5, 50}).status, glsum::Status::order_out_of_range);
    const std::vector<glsum::Mode> modes = {{0.25, 0.5}, {0.5, 0.25}};
    EXPECT_EQ(bench::count_path("modes_plain_f32", {0.5, 6, modes}).modes, 2U);
    const bench::CountPath blocks = bench::count_path("nested_plain_f32", {0.5, 6, {}, {}, {3, 2}});
    EXPECT_EQ(blocks.blocks, (std::pair<std::size_t, std::size_t>{3, 2}));
    EXPECT_EQ(blocks.status, glsum::Status::ok);
    EXPECT_TRUE(bench::double_in_software("shift_plain_f64"));
    EXPECT_FALSE(bench::double_in_software("shift_plain_f32"));
    EXPECT_THROW((void)bench::count_path("square", {0.5, 5}), std::out_of_range);
}

}  // namespace
