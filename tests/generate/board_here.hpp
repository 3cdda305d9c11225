// The emulated board, where it was built; nothing elsewhere, unless tests are told that it has to be there.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include "base/failure.hpp"
#include "qemu/emulate/firmware.hpp"

inline std::optional<qemu::Board> board_here() {
    try {
        qemu::Board board = qemu::find_board(TEST_FIRMWARE_BUILD, TEST_PLUGIN, TEST_EMULATE);
        (void)qemu::emulator_version();
        return board;
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(std::getenv("GLSUM_REQUIRE_FIRMWARE"), nullptr) << failure.what();
        return std::nullopt;
    }
}
