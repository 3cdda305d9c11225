// The search where it turns: between equals, and where a longer length takes the place of the shortest.
#include "bench/choose/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "tests/choose/few_kernels.hpp"

namespace {

using choose::Choice;
using choose::Cost;
using choose::Limits;
using choose::Standing;
using test::cost_of;
using test::Few;

// Meets the error from 20 taps on, and costs the same at every length.
Few::One always(double value, double bytes) {
    return {20, [=](std::size_t) { return cost_of(value, bytes); }};
}

// Of equals the first are chosen, and that they are equal is a tie.
TEST(SearchEdges, OfEqualsTheFirstTwoAreChosen) {
    Few equals;
    equals.ones = {{"a", always(100.0, 8.0)}, {"b", always(100.0, 8.0)}, {"c", always(100.0, 8.0)}};
    const Choice found = equals.choose({0.1, {}, {}});
    ASSERT_TRUE(found.chosen && found.runner_up);
    EXPECT_EQ(found.chosen->kernel, "a");
    EXPECT_EQ(found.runner_up->kernel, "b");
    EXPECT_TRUE(found.tie);
    EXPECT_EQ(found.kernels.at(2).standing, Standing::costlier);
}

// The second best is the runner-up, wherever the kernels stand.
TEST(SearchEdges, TheRunnerUpIsTheSecondBest) {
    for (const auto& [a, b, c, second] : {std::tuple(100.0, 300.0, 200.0, "c"), std::tuple(300.0, 100.0, 200.0, "c"),
                                          std::tuple(200.0, 300.0, 100.0, "a"), std::tuple(300.0, 200.0, 100.0, "b"),
                                          std::tuple(200.0, 100.0, 300.0, "a")}) {
        Few three;
        three.ones = {{"a", always(a, 8.0)}, {"b", always(b, 8.0)}, {"c", always(c, 8.0)}};
        const Choice found = three.choose({0.1, {}, {}});
        ASSERT_TRUE(found.chosen && found.runner_up);
        EXPECT_EQ(found.chosen->cost.value, 100.0);
        EXPECT_EQ(found.runner_up->kernel, second);
        EXPECT_FALSE(found.tie);
    }
}

// A longer length takes the place of the shortest where it fits and that does not, else where it is better.
TEST(SearchEdges, ALongerLengthIsTakenWhereItFitsOrIsBetter) {
    const auto chosen_of = [](const Cost& shortest, const Cost& longer) {
        Few one;
        one.ones["a"] = {20, [=](std::size_t taps) {
                             return taps == 20 ? shortest : taps == 22 ? longer : cost_of(1000.0, 1000.0);
                         }};
        return one.choose({0.1, {}, 50.0}).chosen->taps;
    };
    EXPECT_EQ(chosen_of(cost_of(10.0, 100.0), cost_of(60.0, 40.0)), 22U);
    EXPECT_EQ(chosen_of(cost_of(60.0, 40.0), cost_of(10.0, 100.0)), 20U);
    EXPECT_EQ(chosen_of(cost_of(60.0, 40.0), cost_of(59.0, 45.0)), 22U);
    EXPECT_EQ(chosen_of(cost_of(60.0, 40.0), cost_of(60.0, 39.0)), 22U);
    EXPECT_EQ(chosen_of(cost_of(60.0, 40.0), cost_of(60.0, 40.0)), 20U);
    Cost broken = cost_of(1.0, 1.0);
    broken.fault = "other bits";
    EXPECT_EQ(chosen_of(cost_of(60.0, 40.0), broken), 20U);
}

// Of longer lengths those count that meet the error too.
TEST(SearchEdges, OnlyLongerLengthsThatMeetTheErrorAreMeasured) {
    struct Bumpy : Few {
        [[nodiscard]] choose::ErrorAt error(const std::string&, std::size_t taps) override {
            const bool meets = taps == 20 || taps == 23 || taps == 27;
            return {.error = meets ? 0.1 : 0.2, .signal = "made", .fault = {}};
        }
    } bumpy;
    bumpy.ones["a"] = always(100.0, 8.0);
    const Choice found = bumpy.choose({0.1, {}, {}});
    ASSERT_TRUE(found.chosen);
    EXPECT_EQ(found.chosen->taps, 20U);
    EXPECT_EQ(bumpy.asked, (std::vector<choose::Case>{{"a", 20}, {"a", 23}, {"a", 27}}));
}

// What does not fit makes nothing else superfluous.
TEST(SearchEdges, WhatDoesNotFitDominatesNothing) {
    Few few;
    few.ones = {{"a", always(80.0, 100.0)}, {"b", always(85.0, 100.0)}, {"x", always(100.0, 50.0)}};
    few.ones["other"] = {20, [](std::size_t) {
                             Cost cheap_but_for_its_band = cost_of(90.0, 40.0);
                             cheap_but_for_its_band.limited = 250.0;
                             return cheap_but_for_its_band;
                         }};
    const auto standing_of_x = [&](const Limits& limits) {
        const Choice found = few.choose(limits);
        return std::ranges::find(found.kernels, "x", &choose::Outcome::kernel)->standing;
    };
    EXPECT_EQ(standing_of_x({0.1, 200.0, {}}), Standing::costlier);
    EXPECT_EQ(standing_of_x({0.1, 250.0, {}}), Standing::dominated);
}

}  // namespace
