// Files of measured cycle counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "qemu/emulate/measured_table.hpp"

namespace qemu {

/// One row of a measured file: kernel,code,data,maintenance,taps,cycles; further columns are allowed.
struct MeasuredCycles {
    std::string kernel;
    std::string code;  ///< flash_cached, flash or itcm; of other programs axi_cached and axi, too
    std::string data;  ///< dtcm or axi
    bool maintenance;  ///< a cache clean and invalidate lies inside the timing
    std::uint32_t taps;
    double cycles;
    unsigned line;
    std::optional<double> instructions = {};  ///< of a call, where the file has that column
    /// The file of another program than ours, whose function `kernel` is: then `taps` are the call's instructions.
    std::string program = {};
    double per = 1.0;  ///< samples or bytes of a call: what its cycles are divided by where rows are compared
};

/// \param name  begins every message
/// \throws glsum::Failure (bad input) with file and line for a column that is missing or there twice, a ragged row, a
///         word or number that is none, too many rows or columns, and a file without rows
[[nodiscard]] std::vector<MeasuredCycles> parse_measured_cycles(const std::string& text, const std::string& name);

/// Such a file, without counts of instructions.
[[nodiscard]] std::string to_csv(const std::vector<MeasuredCycles>& rows);

}  // namespace qemu
