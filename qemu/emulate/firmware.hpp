// Carries out plans on the emulated board: what each call of a kernel costs there, and which bits it computes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/machines.hpp"
#include "glsum/kernel.hpp"
#include "qemu/emulate/emulator.hpp"
#include "qemu/emulate/modelled_calls.hpp"
#include "qemu/stream/call_counter.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

struct Board {
    std::filesystem::path measure_elf;
    std::filesystem::path replay_elf;
    std::filesystem::path plugin;
    Emulator emulator;
    std::filesystem::path cores = {};                        ///< folder of core files, for the timing model
    const base::Machine* machine = &base::machines.front();  ///< that it emulates

    /// "emulated Cortex-M7"
    [[nodiscard]] std::string name() const { return "emulated " + std::string(machine->name); }
    /// Of the board, below targets/: its `emulate` and its memory map.
    [[nodiscard]] std::filesystem::path folder() const { return emulator.command.parent_path(); }
};

/// The board's files below the build folder of its preset.
/// \throws glsum::Failure (missing) naming the file that is not there and how to build it.
[[nodiscard]] Board find_board(const std::filesystem::path& build, const std::filesystem::path& plugin,
                               const std::filesystem::path& emulate);

/// One row of a plan: `calls` calls from a cleared past, fed with a signal (repeated when it is shorter).
struct PlannedRow {
    std::string kernel;
    double order;
    std::size_t taps;
    std::size_t signal;  ///< index into the signals
    std::size_t calls;
    std::vector<glsum::Mode> modes = {};
    glsum::Blocks blocks = {};

    [[nodiscard]] glsum::Design design() const { return {order, taps, modes, {}, blocks}; }
};

/// Records of equal length, |x| <= 1.
using Signals = std::vector<std::vector<double>>;

struct ReplayedRow {
    glsum::Status status;
    std::uint64_t hash;  ///< of all outputs
};

struct MeasuredRow {
    glsum::Status status;
    std::uint64_t hash;  ///< of the outputs of `calls_hashed` calls
    std::size_t stack_bytes;
    std::size_t state_bytes;
    std::size_t coefficient_bytes;
    std::size_t code_bytes;  ///< of the functions that the calls reached, whole
    CallCounts first;
    double instructions;  ///< the mean of 32 calls once the past is full, as are the next three
    double loads;
    double stores;
    double branches;
    std::uint64_t worst_instructions;              ///< of the calls once the past is full
    std::vector<ModelledCall> cores;               ///< as the timing request has them
    std::vector<std::uint32_t> unknown_encodings;  ///< addresses of what the model could not decode
    bool operator==(const MeasuredRow&) const = default;
};

/// Which calls `measure` makes of a kernel at this length, and which of them it times.
/// \param kernel  of any name; none that the registry does not have computes in double
[[nodiscard]] firmware::TimedCalls timed_calls(const std::string& kernel, std::size_t taps);

/// How many calls `measure` needs of a kernel at this length: `timed_calls(kernel, taps).calls()`.
[[nodiscard]] std::size_t calls_to_measure(const std::string& kernel, std::size_t taps);

/// How many calls the hash of a measured row is of: one more, on a painted stack, and those in halves.
[[nodiscard]] std::size_t calls_hashed(const std::string& kernel, std::size_t calls);

/// The hash of the same calls on this machine. `status` as `prepare` gave it; no calls unless ok.
/// \throws std::out_of_range for a kernel that is not in the registry.
[[nodiscard]] ReplayedRow replay_here(const PlannedRow& row, const Signals& signals);

/// Called after each row.
using RowDone = std::function<void()>;

[[nodiscard]] std::vector<ReplayedRow> replay(const Board& board, std::span<const PlannedRow> plan,
                                              const Signals& signals, const RowDone& done);

/// How the plugin is told of the program: the counts are the same. Blocks take a fraction of the time; the stream has
/// each instruction and each access with its address.
enum class Counting { blocks, stream };

/// Checks the instrument on loops of known counts first. Every row's `calls` must be `calls_to_measure(kernel, taps)`.
/// \param timing  cores that the timing model is to have, in the same run; none: instructions only
/// \throws glsum::Failure when the instrument miscounts, or the emulator fails, and as timing::cores_of.
[[nodiscard]] std::vector<MeasuredRow> measure(const Board& board, std::span<const PlannedRow> plan,
                                               const Signals& signals, const RowDone& done,
                                               Counting counting = Counting::blocks,
                                               const timing::TimingRequest& timing = {});

}  // namespace qemu
