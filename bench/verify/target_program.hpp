// C code with generated headers as a program of the emulated Cortex-M7: compiled, linked, run and watched.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/scratch.hpp"
#include "qemu/emulate/firmware.hpp"
#include "qemu/stream/call_counter.hpp"

namespace generate {

/// A file of the run. \throws glsum::Failure (bad input) when it cannot be written
void write_file(const std::filesystem::path& path, const std::string& text);

/// \param who  compiles, in the message \throws glsum::Failure (check failed) with what the command says when it fails
void compile(const std::string& command, const std::string& who);

/// Links C code with targets/firmware/verify.cpp, which calls it. Headers lie in the folder; warnings are errors.
/// \throws glsum::Failure (missing) without the target's compiler, (check failed) when it refuses the code
[[nodiscard]] std::filesystem::path link_for_target(const std::string& code, const qemu::Board& board,
                                                    const base::Scratch& scratch);

struct TargetRun {
    std::vector<std::uint32_t> answers;      ///< what each `glsum_verify` returned
    std::vector<std::uint32_t> entries;      ///< addresses of the watched functions
    qemu::CallLog counts;                    ///< of their calls
    std::vector<timing::TimingLog> timings;  ///< one for each of them
};

/// \param functions  to be counted and timed \param answers  how many the program gives \param done  called after each
/// \throws glsum::Failure (check failed) where the program stops before the last one
[[nodiscard]] TargetRun run_on_target(const std::filesystem::path& elf, const std::vector<std::string>& functions,
                                      std::size_t answers, const qemu::Board& board,
                                      const timing::TimingRequest& timing, const base::Scratch& scratch,
                                      const std::function<void()>& done);

}  // namespace generate
