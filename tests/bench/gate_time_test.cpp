// Host time by statistics, on made-up machines: a quiet one, one whose neighbours come and go, one that is always busy.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "bench/gate/host_time.hpp"

namespace {

using bench::gate::Timing;

// A run of a kernel of 100 ns and an anchor of 20 ns: a share of the repetitions is disturbed, which costs the kernel
// up to 70 % and the anchor up to 20 %.
Timing run(unsigned seed, std::size_t repetitions, double disturbed, double slower = 1.0) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Timing timing;
    for (std::size_t i = 0; i < repetitions; ++i) {
        const auto time = [&](double ns, double cost) {
            const double hit = unit(generator) < disturbed ? cost * unit(generator) : 0.0;
            return ns * (1.0 + hit + 0.01 * unit(generator));
        };
        timing.kernel.push_back(slower * time(100.0, 0.7));
        timing.anchor.push_back(time(20.0, 0.2));
    }
    return timing;
}

TEST(GateTime, IsTheChangeOfTheRatio) {
    Timing before{std::vector<double>(20, 100.0), std::vector<double>(20, 20.0)};
    Timing after{std::vector<double>(20, 330.0), std::vector<double>(20, 60.0)};
    const auto change = bench::gate::time_change(before, after, 0.99);
    EXPECT_NEAR(change.estimate, 0.1, 1e-12);
    EXPECT_NEAR(change.low, 0.1, 1e-12);
    EXPECT_NEAR(change.high, 0.1, 1e-12);
}

// Of 300 repetitions the three fastest count, their mean being twice the least here; of fewer than 300 the two fastest.
TEST(GateTime, TheFastestHundredthCounts) {
    const auto change_of = [](std::size_t repetitions) {
        const std::vector<double> anchor(repetitions, 20.0);
        Timing fast{std::vector<double>(repetitions, 400.0), anchor};
        fast.kernel[7] = fast.kernel[70] = 100.0;
        return bench::gate::time_change({std::vector<double>(repetitions, 100.0), anchor}, fast, 0.99).estimate;
    };
    EXPECT_NEAR(change_of(300), 1.0, 1e-12);  // 100, 100 and 400
    EXPECT_NEAR(change_of(299), 0.0, 1e-12);
}

TEST(GateTime, SameFilesSameVerdict) {
    const auto first = bench::gate::time_change(run(1, 50, 0.5), run(2, 50, 0.5), 0.99);
    const auto second = bench::gate::time_change(run(1, 50, 0.5), run(2, 50, 0.5), 0.99);
    EXPECT_EQ(first.low, second.low);
    EXPECT_EQ(first.high, second.high);
}

TEST(GateTime, NeighboursRaiseNoAlarmAndHideNoTenth) {
    int alarms = 0;
    int caught = 0;
    for (unsigned seed = 0; seed < 50; ++seed) {
        const double before = 0.9 * (seed % 10) / 9.0;
        const double after = 0.9 * (seed / 10) / 4.0;
        const Timing baseline = run(2 * seed, 200, before);
        alarms += bench::gate::time_change(baseline, run(2 * seed + 1, 200, after), 0.99).low > 0.05 ? 1 : 0;
        caught += bench::gate::time_change(baseline, run(2 * seed + 1, 200, after, 1.1), 0.99).low > 0.05 ? 1 : 0;
    }
    EXPECT_EQ(alarms, 0);
    EXPECT_GE(caught, 48);
}

// Where no moment is quiet, the interval says that nothing can be said.
TEST(GateTime, FewQuietMomentsWidenTheInterval) {
    const auto quiet = bench::gate::time_change(run(1, 200, 0.0), run(2, 200, 0.0), 0.99);
    const auto busy = bench::gate::time_change(run(1, 200, 0.995), run(2, 200, 0.995), 0.99);
    EXPECT_GT(busy.high - busy.low, 3.0 * (quiet.high - quiet.low));
}

// A run that met few quiet moments, and one that met none, differ in the fastest twentieth if not in the hundredth.
TEST(GateTime, CodeThatDidNotChangeTellsWhetherTheMachineDid) {
    EXPECT_LT(bench::gate::movement(run(1, 200, 0.0), run(2, 200, 0.5)), 0.02);
    Timing few = run(3, 200, 0.0);
    for (std::size_t i = 4; i < few.kernel.size(); ++i) {
        few.kernel[i] *= 1.5;
    }
    EXPECT_NEAR(bench::gate::movement(run(1, 200, 0.0), few), 0.3, 0.02);  // 4 quiet and 6 disturbed of the fastest ten
    EXPECT_NEAR(bench::gate::movement(few, run(1, 200, 0.0)), 0.3, 0.02);
    EXPECT_NEAR(bench::gate::movement(run(1, 200, 0.0), run(2, 200, 0.0, 0.9)), 1.0 / 0.9 - 1.0, 0.02);
}

// Two at least count, and their mean: of 20 repetitions 100 and 120.
TEST(GateTime, OfFewRepetitionsTheTwoFastestCount) {
    const std::vector<double> anchor(20, 10.0);
    Timing after{std::vector<double>(20, 500.0), anchor};
    after.kernel[3] = 120.0;
    after.kernel[11] = 100.0;
    EXPECT_NEAR(bench::gate::time_change({std::vector<double>(20, 100.0), anchor}, after, 0.99).estimate, 0.1, 1e-12);
}

// However much the times scatter: what disturbs kernel and anchor alike leaves their ratio alone, in every redrawn run.
TEST(GateTime, WhatDisturbsBothAlikeDoesNotWidenTheInterval) {
    Timing before;
    Timing after;
    for (int i = 0; i < 40; ++i) {
        before.anchor.push_back(10.0 + i * 7 % 40);
        before.kernel.push_back(5.0 * before.anchor.back());
        after.anchor.push_back(20.0 + i * 11 % 40);
        after.kernel.push_back(6.0 * after.anchor.back());
    }
    const auto change = bench::gate::time_change(before, after, 0.99);
    EXPECT_NEAR(change.estimate, 0.2, 1e-12);
    EXPECT_NEAR(change.low, 0.2, 1e-12);
    EXPECT_NEAR(change.high, 0.2, 1e-12);
}

// Of a confidence of one half both bounds are the median; of more they lie on either side of it.
TEST(GateTime, BothBoundsAreAsFarFromTheEndsOfTheRedrawnRuns) {
    const Timing before = run(1, 50, 0.5);
    const Timing after = run(2, 50, 0.5);
    const auto median = bench::gate::time_change(before, after, 0.5);
    EXPECT_EQ(median.low, median.high);
    double low = median.low;
    double high = median.high;
    for (const double confidence : {0.75, 0.9, 0.99}) {
        const auto change = bench::gate::time_change(before, after, confidence);
        EXPECT_LT(change.low, low) << confidence;
        EXPECT_GT(change.high, high) << confidence;
        low = change.low;
        high = change.high;
    }
}

// The hundredth and the twentieth of 400 repetitions are the fastest 4 and 20, of 396 the fastest 3 and 19.
TEST(GateTime, MovementIsOfTheHundredthOrTheTwentiethWhicheverIsMore) {
    const auto moved = [](std::size_t repetitions, const std::vector<double>& fastest, double rest) {
        const std::vector<double> anchor(repetitions, 10.0);
        Timing now{std::vector<double>(repetitions, rest), anchor};
        std::copy(fastest.begin(), fastest.end(), now.kernel.begin());
        const Timing before{std::vector<double>(repetitions, 100.0), anchor};
        const double there = bench::gate::movement(before, now);
        EXPECT_NEAR(bench::gate::movement(now, before), there, 1e-12);  // either way
        return there;
    };
    EXPECT_NEAR(moved(400, {40.0, 50.0, 50.0, 60.0}, 100.0), 1.0, 1e-12);  // half of 100
    EXPECT_NEAR(moved(396, {40.0, 50.0, 60.0}, 100.0), 1.0, 1e-12);
    std::vector<double> twenty(20, 130.0);
    std::fill_n(twenty.begin(), 4, 100.0);
    EXPECT_NEAR(moved(400, twenty, 1000.0), 0.24, 1e-12);  // (4 * 100 + 16 * 130) / 20 = 124
    std::vector<double> nineteen(19, 119.0);
    std::fill_n(nineteen.begin(), 3, 100.0);
    EXPECT_NEAR(moved(396, nineteen, 1000.0), 0.16, 1e-12);  // (3 * 100 + 16 * 119) / 19 = 116
    EXPECT_EQ(moved(100, {}, 100.0), 0.0);
}

}  // namespace
