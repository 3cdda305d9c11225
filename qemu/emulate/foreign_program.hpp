// Whether a program of anybody's can run on the emulated board at all: said before the emulator dies of it.
#pragma once

#include <filesystem>

#include "base/machines.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

/// The machine that a core file is for. \throws glsum::Failure as timing::cores_of
[[nodiscard]] const base::Machine& machine_of(const timing::TimingRequest::Core& core,
                                              const std::filesystem::path& cores_folder);

/// \param machine  whose board it is
/// \throws glsum::Failure (bad input), in one sentence: when it is for another core, when a section lies where the
/// board
///         has no memory (a program linked for a chip's flash at 0x08000000), when nothing at address 0 starts it
void check_runs_on_board(const Elf& elf, const base::Machine& machine);

}  // namespace qemu
