// What the timing model predicts for measured cycle counts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "qemu/emulate/core_variant.hpp"
#include "qemu/emulate/emulator.hpp"
#include "qemu/emulate/measured_cycles.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

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
/// A kernel is a loop of the program's (targets/shared/silicon_loops.def), or else one of the registry's.
/// \throws glsum::Failure (bad input) naming file and line for a kernel that the program does not have, and for more
///         taps than it takes
[[nodiscard]] std::vector<std::vector<PredictedCycles>> predict(const SiliconProgram& program,
                                                                const std::filesystem::path& file,
                                                                const std::vector<MeasuredCycles>& rows,
                                                                const std::vector<CoreVariant>& variants);

/// Least-squares line through (taps, cycles).
struct FittedLine {
    double slope;
    double constant;
};
[[nodiscard]] FittedLine fit_line(const std::vector<double>& taps, const std::vector<double>& cycles);

}  // namespace qemu
