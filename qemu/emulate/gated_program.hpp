// What the functions of a program took, as a file that a later build is held against.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace qemu {

/// What is kept of a function. Cycles are modelled ones.
struct GatedFunction {
    std::string name;
    std::uint64_t calls = 0;  ///< 0: the program never called it, and nothing else is known but its bytes
    std::int64_t instructions_median = 0;
    std::int64_t instructions_max = 0;
    double cycles_median = 0.0;
    double cycles_max = 0.0;
    double low = 0.0;  ///< of the median's band
    double high = 0.0;
    std::uint32_t code_bytes = 0;          ///< of all functions that its calls reached, whole; uncalled: its own
    std::uint32_t stack_bytes = 0;         ///< the most of any call
    std::map<std::string, double> stalls;  ///< cycles by cause, median of the calls; causes of 0 are left out
};

struct GatedProgram {
    std::string elf_sha256;
    std::string core;
    std::string core_sha256;  ///< of all files that the core was read from, and of where code and data were placed
    std::vector<GatedFunction> functions;  ///< by name
};

/// Schema `glsum-functions-1`. \param reason  why it was recorded, kept in it
/// \throws glsum::Failure (bad input) naming the file when it is none
[[nodiscard]] std::string to_json(const GatedProgram& program, const std::string& reason);
[[nodiscard]] GatedProgram parse_gated_program(const std::string& text, const std::string& name);

}  // namespace qemu
