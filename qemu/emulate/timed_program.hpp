// Runs a firmware program under the emulator and times its functions with the timing model.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/emulator.hpp"
#include "qemu/timing/marked_timer.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

/// \param entries  addresses of the functions to time
/// \param marks    of a program that marks what is to be timed
/// \param uncalled whether a log may be one of no call
/// \param line     called for each line that the program prints; may be empty
/// \param request  its stretches, too, are timed
/// \return one log for each part that the program marks; without marks one for each function, in the order of their
///         addresses, and behind them one for each stretch, likewise: of no call where it was not met
/// \throws glsum::Failure as emulate() does; when the program ends within a watched function, and when none was called,
/// it
///         says so (check failed); for marks of stretches that do not pair (bad input), and when no stretch was met
///         (check failed)
[[nodiscard]] std::vector<timing::TimingLog> time_program(
    const Emulator& emulator, const std::filesystem::path& plugin, const std::filesystem::path& elf,
    const std::vector<std::string>& arguments, const std::vector<std::uint32_t>& entries,
    const timing::TimingRequest& request, const std::optional<Marks>& marks,
    const std::function<void(const std::string&)>& line, bool uncalled = false);

}  // namespace qemu
