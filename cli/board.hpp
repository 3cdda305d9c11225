// The emulated board that was built beside this program.
#pragma once

#include <optional>

#include "bench/choose/question.hpp"
#include "qemu/firmware.hpp"

namespace cli {

/// \throws glsum::Failure (missing) naming the file that is not there, or the emulator.
[[nodiscard]] qemu::Board built_board();

/// Nothing where it throws.
[[nodiscard]] std::optional<qemu::Board> board_if_there();

/// The board where a question needs it, else the board if it is there.
[[nodiscard]] std::optional<qemu::Board> board_for(const choose::Question& question);

}  // namespace cli
