// The emulated board that was built beside this program, and the files of measured cycles that it is held to.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/machines.hpp"
#include "bench/sweep/sweep.hpp"
#include "qemu/emulate/firmware.hpp"
#include "qemu/emulate/measured_cycles.hpp"
#include "qemu/emulate/predicted_calls.hpp"
#include "qemu/emulate/silicon.hpp"

namespace cli {

/// The core that is modelled where none is asked for: the chip of the seed's drive, code and data in its fastest
/// memory.
inline constexpr const char* default_core = base::machines.front().default_core.data();

/// The project's core files.
[[nodiscard]] std::filesystem::path cores_folder();

/// What the emulator runs a program of anybody's with: the instrument, and the board's script.
[[nodiscard]] std::filesystem::path plugin();
[[nodiscard]] std::filesystem::path emulate_script(const base::Machine& machine);

/// \throws glsum::Failure (missing) naming the file that is not there, or the emulator.
[[nodiscard]] qemu::Board built_board(const base::Machine& machine = base::machines.front());

/// Its program `silicon`. \throws as `built_board`
[[nodiscard]] qemu::SiliconProgram built_silicon(const base::Machine& machine = base::machines.front());

/// What times functions of anybody's programs. \param timeout_s  that one may stay silent
[[nodiscard]] qemu::CallsProgram calls_program(unsigned timeout_s);

/// The core files that are modelled where none is asked for: one of each machine.
[[nodiscard]] std::vector<std::string> default_cores();

/// Gives a sweep its cores and their machines: those of its targets. \param asked  empty: counts and the usual cores
/// \throws glsum::Failure (bad input) for a core that has no file, or whose machine is none of the targets
void take_cores(bench::Sweep& sweep, const std::vector<std::string>& asked);

/// Nothing where it throws.
[[nodiscard]] std::optional<qemu::Board> board_if_there(const base::Machine& machine = base::machines.front());

/// \throws glsum::Failure (bad input) as `qemu::parse_measured_cycles`, or where the file cannot be read.
[[nodiscard]] std::vector<qemu::MeasuredCycles> read_measured_cycles(const std::filesystem::path& path);

}  // namespace cli
