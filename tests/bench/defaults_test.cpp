// What is measured where nothing is said: committed results and the commands' help rest on it.
#include <gtest/gtest.h>

#include "bench/studies/equal_cost.hpp"
#include "bench/sweep/sweep.hpp"

namespace {

TEST(Defaults, ASweepIsOfFiveSecondsOnBothTargets) {
    const bench::Sweep sweep;
    EXPECT_EQ(sweep.design_errors, (std::vector{1e-2, 1e-3, 1e-4, 1e-6}));
    EXPECT_EQ(sweep.targets, (std::vector<std::string>{"host", "m7"}));
    EXPECT_EQ(sweep.cores, std::vector<std::string>{"count"});
    EXPECT_EQ(sweep.samples, 5000U);
    EXPECT_EQ(sweep.seed, 2020U);
    EXPECT_EQ(sweep.weights, bench::Discretisation::gl);
    EXPECT_EQ(sweep.repetitions, 1U);
    EXPECT_EQ(sweep.jobs, 1U);
    EXPECT_EQ(bench::longest_length, 1000000U);
}

TEST(Defaults, EqualCostsAreThreeOfFiveOrders) {
    const bench::EqualCost equal;
    EXPECT_EQ(equal.costs, (std::vector<std::size_t>{16, 24, 32}));
    EXPECT_EQ(equal.orders, (std::vector{0.2, 0.5, 0.9, 1.5, -0.5}));
    EXPECT_EQ(equal.samples, 5000U);
    EXPECT_EQ(equal.jobs, 1U);
}

}  // namespace
