// Files of cycles that were measured on silicon, of any program's functions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace qemu {

/// One row of such a file: elf,function,core,code,data,measured,per; further columns are allowed, of which group is
/// read.
struct MeasuredCall {
    std::filesystem::path elf;  ///< paths are relative to the file that names them
    std::string function;       ///< as `Elf::function` takes it
    std::string core;           ///< a core file's name
    std::string code;           ///< placement as `TimingRequest::Core`; empty: as the core file has it
    std::string data;
    double cycles;  ///< measured: a call's, divided by `per`
    double per;     ///< bytes, samples or turns of a call; 1 where the call itself is meant
    unsigned line;
    std::string group = {};  ///< rows of one author, kernel or commit, where the file has that column
};

/// Whether a file of measured cycles is one of these, and not of our kernels (`parse_measured_cycles`).
[[nodiscard]] bool names_programs(const std::string& text);

/// \param name    of the file; begins every message
/// \param folder  that it lies in
/// \throws glsum::Failure (bad input) as `MeasuredTable`, and for a word or number that is none
[[nodiscard]] std::vector<MeasuredCall> parse_measured_calls(const std::string& text, const std::string& name,
                                                             const std::filesystem::path& folder);

}  // namespace qemu
