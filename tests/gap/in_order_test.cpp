// Which description is the base: the prices of its numbers, what outlasts the records, and how near a start is kept.
#include "gap/drive/base/in_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gap/drive/base/structure.hpp"

namespace {

using gap::Described;
using testing::ElementsAre;

constexpr double longest_s = 10.0;

Described description(const std::string& name, double aside, double validation, int numbers, int integrators = 0) {
    return {name, "", gap::form_to_find(), aside, validation, numbers, integrators};
}

std::vector<std::string> in_order(std::vector<Described> found, double floor = 0.0) {
    gap::keep_in_order(found, longest_s, floor);
    std::vector<std::string> names;
    for (const Described& one : found) {
        names.push_back(one.name);
    }
    return names;
}

// By the logarithms of what stays in blocks kept aside and on the validation, half of each.
TEST(BaseInOrder, ANumberMoreIsWorthEightPercent) {
    const Described simple = description("simple", 0.1, 0.2, 2);
    const auto richer = [&](int numbers, double aside, double validation) {
        return in_order({description("richer", 0.1 * std::exp(-aside), 0.2 * std::exp(-validation), numbers), simple});
    };
    EXPECT_THAT(richer(3, 0.0795, 0.0795), ElementsAre("simple", "richer"));
    EXPECT_THAT(richer(3, 0.0805, 0.0805), ElementsAre("richer", "simple"));
    EXPECT_THAT(richer(5, 0.239, 0.239), ElementsAre("simple", "richer"));
    EXPECT_THAT(richer(5, 0.241, 0.241), ElementsAre("richer", "simple"));
    EXPECT_THAT(richer(3, 0.159, 0.0), ElementsAre("simple", "richer"));
    EXPECT_THAT(richer(3, 0.161, 0.0), ElementsAre("richer", "simple"));
    EXPECT_THAT(richer(3, 0.0, 0.161), ElementsAre("richer", "simple"));
    // Of two alike the one that was tried first.
    EXPECT_THAT(richer(2, 0.0, 0.0), ElementsAre("richer", "simple"));
}

// A record that has not settled looks like an integrator's.
TEST(BaseInOrder, AnIntegratorIsBetterByThirtyPercent) {
    const Described rests = description("rests", 0.1, 0.2, 2);
    const auto integrates = [&](int integrators, double by) {
        return in_order({description("integrates", 0.1 * std::exp(-by), 0.2 * std::exp(-by), 2, integrators), rests});
    };
    for (const int integrators : {1, 2}) {
        EXPECT_THAT(integrates(integrators, 0.2985), ElementsAre("rests", "integrates"));
        EXPECT_THAT(integrates(integrators, 0.3015), ElementsAre("integrates", "rests"));
    }
}

// What noise hides, and rounding, goes equally far.
TEST(BaseInOrder, BelowTheNoiseTheSimplerOneIsFirst) {
    const Described simple = description("simple", 0.01, 0.01, 2);
    const Described richer = description("richer", 1e-4, 1e-4, 3);
    EXPECT_THAT(in_order({richer, simple}), ElementsAre("richer", "simple"));
    EXPECT_THAT(in_order({richer, simple}, 0.01), ElementsAre("simple", "richer"));
    EXPECT_THAT(in_order({description("richer", 0.0, 0.0, 3), description("simple", 1.083e-6, 1.083e-6, 2)}),
                ElementsAre("simple", "richer"));
    EXPECT_THAT(in_order({description("richer", 0.0, 0.0, 3), description("simple", 1.0837e-6, 1.0837e-6, 2)}),
                ElementsAre("richer", "simple"));
}

TEST(BaseInOrder, OfEachStructureTheBetterOneStays) {
    std::vector<Described> found = {description("a", 0.2, 0.2, 2), description("b", 0.15, 0.15, 2),
                                    description("a", 0.1, 0.1, 2)};
    gap::keep_in_order(found, longest_s, 0.0);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].name, "a");
    EXPECT_EQ(found[0].aside, 0.1);
    EXPECT_EQ(found[1].name, "b");
    // A second mode is the plant's own only where it takes half.
    EXPECT_THAT(in_order({description("two_modes", 0.06, 0.01, 2), description("a", 0.1, 0.1, 2)}), ElementsAre("a"));
}

// Lags that outlast the longest record one and a half times are a drift's; of a half order they are a time to that
// power.
TEST(BaseInOrder, LagsThatOutlastTheRecordsAreNoPlants) {
    const Described quick = description("quick", 0.5, 0.5, 2);
    const auto with_lag = [](const char* structure, double lag_s, double order = 1.0) {
        Described one = description("slow", 0.1, 0.1, 2);
        one.form = gap::form_of(*gap::structure_named(structure),
                                {.denominator = {std::pow(lag_s, order)}, .numerator = {}, .orders = {order}}, true);
        return one;
    };
    for (const char* structure : {"first_order", "integrator_lag"}) {
        EXPECT_THAT(in_order({quick, with_lag(structure, 14.95)}), ElementsAre("slow", "quick"));
        EXPECT_THAT(in_order({quick, with_lag(structure, 15.05)}), ElementsAre("quick"));
    }
    EXPECT_THAT(in_order({quick, with_lag("fractional_lag", 14.95, 0.5)}), ElementsAre("slow", "quick"));
    EXPECT_THAT(in_order({quick, with_lag("fractional_lag", 15.05, 0.5)}), ElementsAre("quick"));
    // Unless there is nothing else.
    EXPECT_THAT(in_order({with_lag("first_order", 15.05)}), ElementsAre("slow"));
}

// A dead time by as much of itself and the lags; what is below 0, the gain and what is fixed as they were.
TEST(HeldNear, LagsAndDeadTimeStayWithinSoManyTimes) {
    const gap::Coefficients at{.gain = 3.0, .denominator = {2.0, 0.5}, .numerator = {-0.4}, .delay_s = 1.0};
    drive::Form free = gap::form_of(*gap::structure_named("second_order_zero"), at, true);
    drive::Form held = gap::held_near(free, 4.0);
    const auto expect_bounds = [&](const char* name, double lower, double upper) {
        EXPECT_DOUBLE_EQ(held.parameter(name).lower, lower) << name;
        EXPECT_DOUBLE_EQ(held.parameter(name).upper, upper) << name;
        EXPECT_EQ(held.parameter(name).value, free.parameter(name).value) << name;
    };
    expect_bounds("a1", 0.5, 8.0);
    expect_bounds("a2", 0.125, 2.0);
    expect_bounds("delay_s", 0.0, 10.0);
    for (const char* name : {"gain", "b1", "a0", "alpha1"}) {
        expect_bounds(name, free.parameter(name).lower, free.parameter(name).upper);
    }
    held = gap::held_near(free, 1.25);
    expect_bounds("a1", 1.6, 2.5);
    expect_bounds("delay_s", 0.25, 1.75);
}

}  // namespace
