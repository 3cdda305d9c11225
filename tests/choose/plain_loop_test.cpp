// The plain loop that the search is held against, and where the budgets lie.
#include "bench/choose/plain_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using choose::Budget;
using choose::Entry;

Entry entry(const char* kernel, std::vector<double> errors, double value, double limited, double bytes) {
    return {kernel, 1, std::move(errors), {.value = value, .limited = limited, .bytes = bytes, .fault = {}}};
}

std::string best(const std::vector<Entry>& entries, const Budget& budget, double* nearest = nullptr) {
    double factor = 0.0;
    const Entry* found = choose::best_of(entries, budget, factor);
    if (nearest != nullptr) {
        *nearest = factor;
    }
    return found != nullptr ? found->kernel : "";
}

TEST(PlainLoop, TheCheapestWinsThenTheSmallestThenTheMostAccurate) {
    std::vector<Entry> entries = {entry("a", {0.1, 0.2}, 10.0, 12.0, 100.0)};
    const Budget both{{0, 1}, {0.5, {}, {}}};
    EXPECT_EQ(best(entries, both), "a");
    entries.push_back(entry("less exact", {0.3, 0.1}, 10.0, 12.0, 100.0));
    EXPECT_EQ(best(entries, both), "a");
    EXPECT_EQ(best(entries, {{1}, {0.5, {}, {}}}), "less exact");  // of the second signal alone it errs less
    entries.push_back(entry("smaller", {0.3, 0.3}, 10.0, 12.0, 99.0));
    EXPECT_EQ(best(entries, both), "smaller");
    entries.push_back(entry("cheaper", {0.4, 0.4}, 9.0, 12.0, 500.0));
    EXPECT_EQ(best(entries, both), "cheaper");
    entries.push_back(entry("broken", {0.0, 0.0}, 1.0, 1.0, 1.0));
    entries.back().cost.fault = "broken";
    entries.push_back(entry("without an answer", {INFINITY, 0.0}, 1.0, 1.0, 1.0));
    EXPECT_EQ(best(entries, both), "cheaper");
    std::reverse(entries.begin(), entries.end());
    EXPECT_EQ(best(entries, both), "cheaper");
    EXPECT_EQ(best({}, both), "");
    // Of two that are as good in all three the first is taken.
    EXPECT_EQ(
        best({entry("first", {0.1, 0.2}, 10.0, 12.0, 100.0), entry("second", {0.2, 0.1}, 10.0, 12.0, 100.0)}, both),
        "first");
}

TEST(PlainLoop, AtItsLimitsAnEntryFits) {
    const std::vector<Entry> one = {entry("a", {0.25}, 10.0, 12.0, 100.0)};
    const auto fits = [&](double error, double cost, double bytes) {
        return best(one, {{0}, {error, cost, bytes}}) == "a";
    };
    EXPECT_TRUE(fits(0.25, 12.0, 100.0));
    EXPECT_FALSE(fits(0.24, 12.0, 100.0));
    EXPECT_FALSE(fits(0.25, 11.9, 100.0));  // the band's upper end counts, not the value
    EXPECT_FALSE(fits(0.25, 12.0, 99.0));
}

TEST(PlainLoop, NearestIsTheLeastRelaxationOfOneLimit) {
    double nearest = 0.0;
    const std::vector<Entry> entries = {entry("error", {0.75}, 1.0, 1.0, 1.0), entry("cost", {0.1}, 40.0, 40.0, 1.0),
                                        entry("bytes", {0.1}, 1.0, 1.0, 250.0), entry("two", {0.26}, 10.1, 10.1, 1.0)};
    EXPECT_EQ(best(entries, {{0}, {0.25, 10.0, 100.0}}, &nearest), "");
    EXPECT_EQ(nearest, 2.5);
    EXPECT_EQ(best(entries, {{0}, {0.25, 10.0, 50.0}}, &nearest), "");
    EXPECT_EQ(nearest, 3.0);
    EXPECT_EQ(best(entries, {{0}, {0.125, 10.0, 50.0}}, &nearest), "");
    EXPECT_EQ(nearest, 4.0);
    EXPECT_EQ(best({entries[3]}, {{0}, {0.25, 10.0, 100.0}}, &nearest), "");
    EXPECT_TRUE(std::isinf(nearest));
}

struct Range {
    double least = INFINITY;
    double most = 0.0;
    std::size_t count = 0;
    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
        ++count;
    }
    // Drawn a thousand times or so, evenly in the logarithm: its ends are met to half a per cent.
    void expect(double low, double high) const {
        EXPECT_GE(least, low);
        EXPECT_LE(least, 1.006 * low);
        EXPECT_LE(most, high);
        EXPECT_GE(most, 0.994 * high);
    }
};

TEST(Budgets, LieNearARandomEntry) {
    const std::vector<Entry> entries = {entry("a", {4.0, 2.0, 1.0}, 1.0, 100.0, 10.0)};
    choose::Budgets budgets(5);
    Range error;
    Range cost;
    Range bytes;
    std::size_t one[] = {0, 0, 0};
    constexpr std::size_t draws = 3000;
    for (std::size_t i = 0; i < draws; ++i) {
        const Budget budget = budgets.next(entries, 3);
        if (budget.signals.size() == 1) {
            ++one[budget.signals[0]];
        } else {
            EXPECT_EQ(budget.signals, (std::vector<std::size_t>{0, 1, 2}));
        }
        error.add(budget.limits.max_error / choose::error_of(entries[0], budget));
        if (budget.limits.max_cost) {
            cost.add(*budget.limits.max_cost / 100.0);
        }
        if (budget.limits.max_bytes) {
            bytes.add(*budget.limits.max_bytes / 10.0);
        }
    }
    error.expect(0.7, 3.0);
    cost.expect(0.6, 2.0);
    bytes.expect(0.6, 2.0);
    for (const std::size_t count : one) {
        EXPECT_NEAR(static_cast<double>(count) / draws, 1.0 / 9.0, 0.02);  // a third, of three signals
    }
    EXPECT_NEAR(static_cast<double>(cost.count) / draws, 0.5, 0.03);
    EXPECT_NEAR(static_cast<double>(bytes.count) / draws, 0.5, 0.03);
}

TEST(Budgets, WithoutAnErrorToGoByLieAnywhere) {
    for (const double error : {0.0, static_cast<double>(INFINITY)}) {
        const std::vector<Entry> entries = {entry("a", {error}, 1.0, 1.0, 1.0)};
        choose::Budgets budgets(5);
        Range range;
        for (int i = 0; i < 20000; ++i) {
            range.add(budgets.next(entries, 1).limits.max_error);
        }
        range.expect(1e-6, 1.0);
    }
}

// The same seed, the same budgets; every entry is drawn as often as any other.
TEST(Budgets, AreThoseOfTheirSeed) {
    std::vector<Entry> entries;
    for (const double error : {1.0, 100.0, 1e4, 1e6}) {
        entries.push_back(entry("a", {error}, 1.0, 1.0, 1.0));
    }
    choose::Budgets first(7);
    choose::Budgets second(7);
    choose::Budgets other(8);
    std::size_t drawn[] = {0, 0, 0, 0};
    bool differs = false;
    for (int i = 0; i < 2000; ++i) {
        const double error = first.next(entries, 1).limits.max_error;
        EXPECT_EQ(error, second.next(entries, 1).limits.max_error);
        differs = differs || error != other.next(entries, 1).limits.max_error;
        ++drawn[static_cast<std::size_t>(std::lround(std::log10(error) / 2.0))];
    }
    EXPECT_TRUE(differs);
    for (const std::size_t count : drawn) {
        EXPECT_NEAR(static_cast<double>(count), 500.0, 60.0);
    }
}

}  // namespace
