// Measured cycle counts, and what the timing model predicts for them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "qemu/emulator.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

/// One row of a measured file: kernel,code,data,maintenance,taps,cycles; further columns are allowed.
struct MeasuredCycles {
    std::string kernel;
    std::string code;  ///< flash_cached, flash or itcm
    std::string data;  ///< dtcm or axi
    bool maintenance;  ///< a cache clean and invalidate lies inside the timing
    std::uint32_t taps;
    double cycles;
    unsigned line;
    std::optional<double> instructions = {};  ///< of a call, where the file has that column
};

/// \throws glsum::Failure (bad input) with file and line for a column that is missing, a ragged row, a word or number
/// that
///         is none, and a file without rows
[[nodiscard]] std::vector<MeasuredCycles> read_measured_cycles(const std::filesystem::path& file);

/// A core file, with its placement replaced by each row's.
struct CoreVariant {
    std::string core;
    std::string set = {};                   ///< one of its rule sets alone; empty: all of them
    std::vector<std::string> without = {};  ///< effects that cost nothing
};

struct PredictedCycles {
    double nominal;
    double low;  ///< of the core file's rule sets, the nominal one included
    double high;
    double beside;               ///< of these, what the core file adds for reading the counter and for maintenance
    std::uint64_t instructions;  ///< of the call
    timing::Losses half_cycles;  ///< lost to each effect
};

struct SiliconProgram {
    std::filesystem::path elf;
    std::filesystem::path plugin;
    std::filesystem::path cores_folder;
    Emulator emulator;
};

/// Predictions, variant by variant and row by row.
/// A kernel is a loop of the program's (targets/firmware/silicon_loops.def), or else one of the registry's.
/// \throws glsum::Failure (bad input) naming file and line for a kernel that the program does not have, and for more
///         taps than it takes
[[nodiscard]] std::vector<std::vector<PredictedCycles>> predict(const SiliconProgram& program,
                                                                const std::filesystem::path& file,
                                                                const std::vector<MeasuredCycles>& rows,
                                                                const std::vector<CoreVariant>& variants);

/// Least-squares line through (taps, cycles).
struct Line {
    double slope;
    double constant;
};
[[nodiscard]] Line fit_line(const std::vector<double>& taps, const std::vector<double>& cycles);

}  // namespace qemu
