// Runs a firmware program under the emulator and times its functions with the timing model.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "qemu/elf.hpp"
#include "qemu/emulator.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

/// \param entries  addresses of the functions to time
/// \param line     called for each line that the program prints; may be empty
/// \throws glsum::Failure as emulate() does; when the program ends within a watched function, when one is recursive, and
///         when none was called, it says so (check failed)
[[nodiscard]] timing::TimingLog time_program(const Emulator& emulator, const std::filesystem::path& plugin,
                                             const std::filesystem::path& elf, const std::vector<std::string>& arguments,
                                             const std::vector<std::uint32_t>& entries,
                                             const timing::TimingRequest& request,
                                             const std::function<void(const std::string&)>& line);

}  // namespace qemu
