// What `time` and `gate --elf` ask of a program of anybody's, and the run that answers.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "cli/board.hpp"
#include "cli/command.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/timing/timing_log.hpp"

namespace cli {

struct TimedElf {
    std::filesystem::path elf;
    std::string core = default_core;
    std::vector<std::string> places;
    std::vector<std::string> without;
    unsigned timeout = 120;  ///< s
};

/// --core, --place and --timeout.
void add_timing_options(Command& command, TimedElf& options);

/// \throws glsum::Failure (bad input) for places, cores and effects that do not exist
[[nodiscard]] timing::TimingRequest to_request(const TimedElf& options, const qemu::Elf& elf);

/// One run of the emulator. \return the log of each function, in their order, and behind them of each stretch of the
///         request, by address
/// \throws glsum::Failure as qemu::time_program; \param uncalled  whether a function may be one that is never called:
/// its log
///         has no runs then
[[nodiscard]] std::vector<timing::TimingLog> time_functions(const TimedElf& options,
                                                            const std::vector<qemu::Function>& functions,
                                                            const timing::TimingRequest& request, bool uncalled);

}  // namespace cli
