// What the timing model predicts for measured cycles of any program's functions.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/machines.hpp"
#include "qemu/emulate/core_variant.hpp"
#include "qemu/emulate/emulator.hpp"
#include "qemu/emulate/measured_calls.hpp"
#include "qemu/timing/effects.hpp"

namespace qemu {

/// Medians of a function's calls, as `glsum time` has them, divided by the row's `per`.
struct PredictedCall {
    double cycles;
    double low;  ///< of the band
    double high;
    double instructions;
    std::array<double, timing::effect_count> lost;  ///< of `cycles`, to each effect
};

struct CallsProgram {
    std::function<Emulator(const base::Machine&)> emulator;
    std::filesystem::path plugin;
    std::filesystem::path cores_folder;
};

/// Variant by variant and row by row. Each function of a program runs once on a board, on all the cores and placements
/// that rows and variants ask of it.
/// \param name  of the file of the rows; with a row's line it begins every message
/// \param jobs  emulators at once
/// \throws glsum::Failure as `Elf`, `timing::cores_of` and `time_program` do
[[nodiscard]] std::vector<std::vector<PredictedCall>> predict_calls(const CallsProgram& program,
                                                                    const std::vector<MeasuredCall>& rows,
                                                                    const std::string& name,
                                                                    const std::vector<CoreVariant>& variants,
                                                                    unsigned jobs);

}  // namespace qemu
