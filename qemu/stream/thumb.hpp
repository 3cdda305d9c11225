// What the counters need to know of a Thumb-2 encoding. [ARMv7-M ARM, A5]
#pragma once

#include "qemu/stream/stream.hpp"

namespace qemu {

/// The length of the instruction that begins with this halfword.
[[nodiscard]] constexpr std::uint8_t bytes_from(std::uint16_t first_halfword) {
    return first_halfword >= 0xE800U ? 4 : 2;
}

/// Whether the instruction may change the program counter other than to the next instruction: B, BL, BX, BLX, CBZ,
/// CBNZ, TBB, TBH, and POP, LDM, LDR, MOV and ADD into PC. An IT block's condition does not matter.
[[nodiscard]] bool is_branch(const Instruction& instruction);

/// Whether it leaves a return address in LR: BL and BLX.
[[nodiscard]] bool is_call(const Instruction& instruction);

/// Whether it writes memory rather than reads it. Only for instructions that make accesses: none makes both kinds.
[[nodiscard]] bool stores(const Instruction& instruction);

/// Whether it loads or stores two core registers: LDRD and STRD, which are two accesses of a word each.
[[nodiscard]] bool moves_pair(const Instruction& instruction);

}  // namespace qemu
