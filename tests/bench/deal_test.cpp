// Dealing by cost.
#include "bench/target/deal.hpp"

#include <gtest/gtest.h>

namespace {

using Shares = std::vector<std::vector<std::size_t>>;

TEST(Deal, BalancesWhatTurnsWouldNot) {
    EXPECT_EQ(bench::deal(std::vector{9.0, 1.0, 8.0, 1.0, 7.0, 10.0}, 2), (Shares{{1, 4, 5}, {0, 2, 3}}));
}

TEST(Deal, LeavesNoPieceOutAndNoShareEmpty) {
    EXPECT_EQ(bench::deal(std::vector{0.0, 0.0, 5.0}, 2), (Shares{{2}, {0, 1}}));
    EXPECT_EQ(bench::deal(std::vector{2.0, 1.0}, 5), (Shares{{0}, {1}}));
    EXPECT_TRUE(bench::deal({}, 3).empty());
}

TEST(Deal, PicksInTheSharesOrder) {
    EXPECT_EQ(bench::pick(std::vector{'a', 'b', 'c'}, {0, 2}), (std::vector{'a', 'c'}));
}

}  // namespace
