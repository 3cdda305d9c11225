// Dealing by cost.
#include "bench/target/shares.hpp"

#include <gtest/gtest.h>

#include "bench/run/pieces.hpp"

namespace {

using Shares = std::vector<std::vector<std::size_t>>;

TEST(Deal, BalancesWhatTurnsWouldNot) {
    EXPECT_EQ(bench::balanced_shares(std::vector{9.0, 1.0, 8.0, 1.0, 7.0, 10.0}, 2), (Shares{{1, 4, 5}, {0, 2, 3}}));
}

TEST(Deal, LeavesNoPieceOutAndNoShareEmpty) {
    EXPECT_EQ(bench::balanced_shares(std::vector{0.0, 0.0, 5.0}, 2), (Shares{{2}, {0, 1}}));
    EXPECT_EQ(bench::balanced_shares(std::vector{2.0, 1.0}, 5), (Shares{{0}, {1}}));
    EXPECT_TRUE(bench::balanced_shares({}, 3).empty());
}

TEST(Deal, PicksInTheSharesOrder) {
    EXPECT_EQ(bench::pick(std::vector{'a', 'b', 'c'}, {0, 2}), (std::vector{'a', 'c'}));
}

// Costs grow as the work does, so that shards of equal cost take about as long: exact products with the square of the
// record, kernels with its samples and their taps, timings with their number and repetitions.
TEST(Pieces, CostWhatTheirWorkGrowsBy) {
    bench::Sweep sweep;
    sweep.orders = {0.5};
    sweep.signals = {"noise"};
    sweep.lengths = {{50}};
    sweep.targets = {};
    sweep.samples = 1000;
    const auto cost_of = [&](std::size_t kernels, std::size_t taps, std::size_t samples) {
        bench::Sweep one = sweep;
        one.kernels.assign(kernels, "ring_plain_f32");
        one.lengths = {{taps}};
        one.samples = samples;
        return bench::make_pieces(one).at(0).cost;
    };
    const double exact = cost_of(0, 50, 1000);
    EXPECT_GT(exact, 0.0);
    EXPECT_NEAR(cost_of(0, 50, 2000), 4.0 * exact, 1e-9 * exact);
    const double kernel = cost_of(1, 50, 1000) - exact;
    EXPECT_GT(kernel, 0.0);
    EXPECT_NEAR(cost_of(3, 50, 1000), exact + 3.0 * kernel, 1e-9 * exact);
    EXPECT_NEAR(cost_of(1, 100, 1000), exact + 2.0 * kernel, 1e-9 * exact);
    EXPECT_NEAR(cost_of(1, 50, 2000), 4.0 * exact + 2.0 * kernel, 1e-9 * exact);
    // On the host each kernel and peer at each length.
    sweep.targets = {"host"};
    sweep.kernels = {"ring_plain_f32", "shift_plain_f32"};
    sweep.peers = {"peer_std_f32"};
    sweep.lengths = {{50}, {20}};
    const auto host = [&](unsigned repetitions) {
        sweep.repetitions = repetitions;
        const bench::Piece last = bench::make_pieces(sweep).back();
        EXPECT_EQ(last.kind, bench::Piece::Kind::host);
        return last.cost;
    };
    const double once = host(1);
    EXPECT_GT(once, 0.0);
    EXPECT_NEAR(host(20), 2.0 * host(10), 1e-12);
    sweep.lengths = {{50}};
    EXPECT_NEAR(host(1), 0.5 * once, 1e-12);
    sweep.kernels.clear();
    EXPECT_NEAR(host(1), once / 6.0, 1e-12);
}

}  // namespace
