// Runs one firmware program under the emulator, with a limit on the time that it may stay silent.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace qemu {

struct Emulator {
    std::filesystem::path command;  ///< the board's `emulate` script
    /// Of its own processor time; up to ten times as long where others take the processor.
    std::chrono::seconds silence_limit{120};
    /// How long it may take to end by itself, its plugin included, before it is killed.
    std::chrono::seconds grace{0};
};

/// The emulator's own version, for the record of a run.
/// \throws glsum::Failure (missing) when it is absent or too old.
[[nodiscard]] std::string emulator_version();

/// Runs `elf` with its arguments; calls `line` for each line of its output as it comes.
/// \param plugin  value of the emulator's -plugin option; empty for none
/// \throws glsum::Failure when the emulator is missing (missing), crashes, reports an error, exits with another status
///         than 0, or is silent for longer than the limit, in which case it is ended first (check failed).
void emulate(const Emulator& emulator, const std::filesystem::path& elf, const std::vector<std::string>& arguments,
             const std::string& plugin, const std::function<void(const std::string&)>& line);

}  // namespace qemu
