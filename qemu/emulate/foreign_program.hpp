// Whether a program of anybody's can run on the emulated board at all: said before the emulator dies of it.
#pragma once

#include "qemu/emulate/elf.hpp"

namespace qemu {

/// \throws glsum::Failure (bad input), in one sentence: when it is for another core, when a section lies where the
/// board
///         has no memory (a program linked for a chip's flash at 0x08000000), when nothing at address 0 starts it
void check_runs_on_board(const Elf& elf);

}  // namespace qemu
