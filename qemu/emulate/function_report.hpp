// What a function takes, for people and as a file.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/function_time.hpp"
#include "qemu/timing/core_file.hpp"

namespace qemu {

/// Where a function's time goes: an instruction, all calls together.
struct HotInstruction {
    std::uint32_t address;
    std::string symbol;       ///< of the function that holds it; may be empty
    std::string disassembly;  ///< likewise
    double cycles;
    std::string reason = {};  ///< the effect that most of them were lost to; empty: none
    double lost = 0.0;        ///< cycles, to it
};

/// The costliest `most`. Their texts are objdump's.
[[nodiscard]] std::vector<HotInstruction> hot_instructions(const FunctionTime& time, const Elf& elf, std::size_t most);

struct FunctionReport {
    std::string function;
    timing::CoreFile core;
    std::vector<std::string> without;  ///< effects that cost nothing
    FunctionTime time;
    std::vector<HotInstruction> hot;
};

[[nodiscard]] std::string to_text(const FunctionReport& report);

/// CSV, a row a call in the order in which they ended: function (as given, quoted), number of the call from 1,
/// instructions, modelled cycles with the band's edges, and what each effect cost, in cycles.
void write_calls_header(std::ostream& out);
void write_calls(std::ostream& out, const std::string& function, const timing::TimingLog& log, std::size_t core = 0);

/// Schema `glsum-time-1`. \param elf_sha256  of the program
[[nodiscard]] std::string to_json(const FunctionReport& report, const std::string& elf_sha256);
/// Of several functions of one program: a list of the same. Of one: as above.
[[nodiscard]] std::string to_json(const std::vector<FunctionReport>& reports, const std::string& elf_sha256);

}  // namespace qemu
