// How the search beside the bases that were found ends.
#include "gap/drive/beside_found_base.hpp"

#include <gtest/gtest.h>

namespace {

using gap::Outcome;

TEST(BesideFoundBase, IsSettledWhereNothingIsMissing) {
    const auto settled = [](Outcome outcome, bool disturbed) {
        gap::Decision decision;
        decision.outcome = outcome;
        decision.disturbed = disturbed;
        return gap::is_settled(decision);
    };
    EXPECT_TRUE(settled(Outcome::no_gap, false));
    EXPECT_FALSE(settled(Outcome::no_gap, true));
    for (const Outcome outcome : {Outcome::attributed, Outcome::ambiguous, Outcome::unknown}) {
        EXPECT_FALSE(settled(outcome, false));
        EXPECT_FALSE(settled(outcome, true));
    }
}

}  // namespace
