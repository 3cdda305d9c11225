// Costs on the emulated board: the board's own counts, each case counted once.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/choose/costs.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/target/target_rows.hpp"
#include "tests/choose/pretend_board.hpp"

namespace {

std::optional<qemu::Board> board_here() {
    try {
        qemu::Board board = qemu::find_board(TEST_FIRMWARE_BUILD, TEST_PLUGIN, TEST_EMULATE);
        (void)qemu::emulator_version();
        board.cores = TEST_CORES;
        return board;
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(std::getenv("GLSUM_REQUIRE_FIRMWARE"), nullptr) << failure.what();
        return std::nullopt;
    }
}

TEST(OnTarget, CountsEachCaseOnce) {
    const auto board = board_here();
    if (!board) {
        GTEST_SKIP() << "no board is here";
    }
    const std::vector<choose::Case> cases = {
        {"ring_plain_f32", 20}, {"modes_plain_f32", 16}, {"ring_plain_f32", 20}, {"nested_plain_f32", 24}};
    const qemu::Signals signals = {bench::make_signal("noise", 300, 7)};
    std::vector<qemu::PlannedRow> plan;
    for (const auto& [kernel, taps] : cases) {
        const auto design = bench::design_of(kernel, 0.5, bench::length_of(kernel, 0.5, taps, 300), 300);
        plan.push_back({kernel,
                        0.5,
                        taps,
                        0,
                        qemu::calls_to_measure(kernel, taps),
                        {design.modes.begin(), design.modes.end()},
                        design.blocks});
    }
    for (const char* core : {"", "stm32f746-flash"}) {
        const bool modelled = core[0] != '\0';
        const auto timing =
            bench::timing_request(TEST_CORES, modelled ? std::vector<std::string>{core} : std::vector<std::string>{});
        const auto rows = qemu::measure(
            *board, plan, signals, [] {}, qemu::Counting::blocks, timing);
        choose::OnTarget costs(*board, 0.5, 300, 7, 1, core);
        const std::vector<choose::Cost> found = costs.costs(cases);
        ASSERT_EQ(found.size(), 4U);
        EXPECT_EQ(costs.measured(), 3U);
        for (std::size_t i = 0; i < cases.size(); ++i) {
            EXPECT_EQ(found[i].fault, "");
            EXPECT_EQ(found[i].value, modelled ? rows[i].cores[0].cycles : rows[i].instructions) << i;
            EXPECT_EQ(found[i].limited, modelled ? rows[i].cores[0].high : rows[i].instructions) << i;
            EXPECT_EQ(found[i].bytes, static_cast<double>(rows[i].state_bytes + rows[i].coefficient_bytes)) << i;
            EXPECT_EQ(found[i].noise, 0.0);
        }
        (void)costs.costs({cases[1]});  // known
        EXPECT_EQ(costs.measured(), 3U);
        (void)costs.costs({cases[1], {"ring_plain_f32", 21}});
        EXPECT_EQ(costs.measured(), 4U);
        EXPECT_EQ(costs.remembered(), 0U);
    }
}

// A kernel that computes other bits on the target has no cost: seen by a board whose second answer is changed on its
// way.
TEST(OnTarget, OtherBitsAreAFault) {
    auto board = board_here();
    if (!board) {
        GTEST_SKIP() << "no board is here";
    }
    const base::Scratch folder;
    std::ofstream(folder.file("emulate"))
        << "#!/bin/sh\n'" << board->emulator.command.string() << "' \"$@\" | sed 's/^row 1 0 [0-9a-f]*/row 1 0 1/'\n";
    std::filesystem::permissions(folder.file("emulate"), std::filesystem::perms::owner_all);
    board->emulator.command = folder.file("emulate");
    choose::OnTarget costs(*board, 0.5, 300, 7, 1);
    const auto found = costs.costs({{"ring_plain_f32", 20}, {"ring_plain_f32", 21}});
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].fault, "");
    EXPECT_EQ(found[1].fault, bench::other_bits);
}

// Of a pretended board, so everywhere: what is ranked and what is limited, and what has none because it is wrong.
TEST(OnTarget, CostsAreInstructionsOrTheCyclesOfACoreAndItsBand) {
    const test::PretendBoard pretended(0.5, 60, 7);
    pretended.knows(3);
    pretended.knows(40);
    for (const char* core : {"", "stm32f746-flash"}) {
        choose::OnTarget costs(pretended.board(), 0.5, 60, 7, 1, core);
        const auto found = costs.costs({{"ring_plain_f32", 40}, {"ring_plain_f32", 3}, {"ring_plain_f32", 40}});
        ASSERT_EQ(found.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i) {
            const double taps = i == 1 ? 3.0 : 40.0;
            EXPECT_EQ(found[i].fault, "");
            EXPECT_DOUBLE_EQ(found[i].value, taps * (core[0] != '\0' ? 20.0 : 10.0));
            EXPECT_DOUBLE_EQ(found[i].limited, taps * (core[0] != '\0' ? 24.0 : 10.0));
            EXPECT_EQ(found[i].bytes, taps * 12.0);
            EXPECT_EQ(found[i].noise, 0.0);
        }
        EXPECT_EQ(costs.measured(), 2U);
        (void)costs.costs({{"ring_plain_f32", 3}});  // known
        EXPECT_EQ(costs.measured(), 2U);
        pretended.knows(5);
        (void)costs.costs({{"ring_plain_f32", 3}, {"ring_plain_f32", 5}});
        EXPECT_EQ(costs.measured(), 3U);
        EXPECT_EQ(costs.remembered(), 0U);
        EXPECT_TRUE(costs.exact());
    }
}

TEST(OnTarget, WhatIsRefusedOrComputesOtherBitsHasAFault) {
    const test::PretendBoard pretended(0.5, 60, 7);
    pretended.knows(3);
    pretended.computes_other_bits(4);
    pretended.refuses(5, glsum::Status::order_out_of_range);
    choose::OnTarget costs(pretended.board(), 0.5, 60, 7, 1);
    const auto found = costs.costs({{"ring_plain_f32", 3}, {"ring_plain_f32", 4}, {"ring_plain_f32", 5}});
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].fault, "");
    EXPECT_EQ(found[1].fault, "the target's outputs differ from the host's");
    EXPECT_EQ(found[2].fault, "the order is not in (-2, 2]");
    EXPECT_EQ(costs.costs({{"ring_plain_f32", 5}}).front().fault, found[2].fault);
    EXPECT_EQ(costs.measured(), 3U);
}

}  // namespace
