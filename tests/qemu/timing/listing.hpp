// What the GNU tools say of code: objdump's disassembly, taken apart, and the assembler on a text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace listing {

struct Line {
    std::uint32_t address;
    std::uint32_t encoding;  ///< as qemu::Instruction has it
    std::uint8_t bytes;
    std::string mnemonic;  ///< "addeq.w"
    std::string operands;
};

/// All instructions of an ELF file, object or archive; literal pools and other data left out.
[[nodiscard]] std::vector<Line> disassemble(const std::filesystem::path& file);

/// Assembles for the Cortex-M7 with its double-precision FPU, from address 0, and disassembles.
/// \throws std::runtime_error with the assembler's words
[[nodiscard]] std::vector<Line> assemble(const std::string& text);

/// Registers named in an operand list, numbered as timing::registers: "{r4, r6-r8}, [sp, #4]!" or "d3, s1".
[[nodiscard]] std::set<unsigned> registers_in(const std::string& operands);

}  // namespace listing
