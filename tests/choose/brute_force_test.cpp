// The search against a plain loop over real kernels.
#include "bench/choose/brute_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "glsum/design/modes.hpp"
#include "tests/choose/costs_by.hpp"
#include "tests/choose/small_question.hpp"

namespace {

// Costs that rise with the length, as code does that goes tap by tap; one kernel's are a bargain far behind.
test::CostsBy pretend_costs(bool bargains) {
    return test::CostsBy([bargains](const std::string& kernel, std::size_t taps) {
        choose::Cost cost;
        const double per_tap = 3.0 + static_cast<double>(kernel.size() % 5);
        cost.value = bargains && taps > 40 ? 1.0 : 10.0 + per_tap * static_cast<double>(taps);
        cost.limited = cost.value;
        cost.bytes = 8.0 * static_cast<double>(taps);
        return cost;
    });
}

TEST(BruteForce, TheSearchAgreesOnRealKernels) {
    test::CostsBy costs = pretend_costs(false);
    const choose::Agreement found = choose::check_against_brute_force(test::small_question(), costs, 120, 3);
    EXPECT_EQ(found.budgets, 120U);
    EXPECT_EQ(found.same, 120U) << found.differences;
    EXPECT_EQ(found.differences, "");
    EXPECT_EQ(found.same_miss, found.nothing);
    EXPECT_GT(found.nothing, 3U);
    EXPECT_LT(found.nothing, 90U);
    const std::size_t of_modes = std::min<std::size_t>(60, glsum::design::most_taps(0.5));
    EXPECT_EQ(found.candidates, 4 * 60 + of_modes);
}

// The search may only expect costs to rise, but for the rest of a group: where they do not, the check must say so.
TEST(BruteForce, ADifferenceIsSeenAndNamed) {
    test::CostsBy costs = pretend_costs(true);
    const choose::Agreement found = choose::check_against_brute_force(test::small_question(), costs, 60, 3);
    EXPECT_EQ(found.budgets, 60U);
    EXPECT_LT(found.same, 60U);
    EXPECT_EQ(static_cast<std::size_t>(std::count(found.differences.begin(), found.differences.end(), '\n')),
              60U - found.same);
    EXPECT_NE(found.differences.find("the search has "), std::string::npos) << found.differences;
}

}  // namespace
