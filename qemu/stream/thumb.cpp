#include "qemu/stream/thumb.hpp"

namespace qemu {
namespace {

constexpr bool matches(std::uint32_t encoding, std::uint32_t mask, std::uint32_t pattern) {
    return (encoding & mask) == pattern;
}

bool is_branch_16(std::uint32_t e) {
    const bool conditional = matches(e, 0xF000, 0xD000) && !matches(e, 0xFE00, 0xDE00);  // not UDF, SVC
    const bool add_or_move_to_pc = matches(e, 0xFF87, 0x4487) || matches(e, 0xFF87, 0x4687);
    return conditional || add_or_move_to_pc || matches(e, 0xF800, 0xE000)  // B
           || matches(e, 0xFF00, 0x4700)                                   // BX, BLX
           || matches(e, 0xF500, 0xB100)                                   // CBZ, CBNZ
           || matches(e, 0xFF00, 0xBD00);                                  // POP with PC
}

bool is_branch_32(std::uint32_t e) {
    if (matches(e, 0xF8008000, 0xF0008000)) {                          // branches and miscellaneous control
        const bool unconditional = (e & 0x1000) != 0;                  // B, BL
        const bool conditional = !matches(e, 0x03800000, 0x03800000);  // else MSR, hints, barriers
        return unconditional || ((e & 0x5000) == 0 && conditional);
    }
    return matches(e, 0xFF70F000, 0xF850F000)                                              // LDR to PC
           || (matches(e, 0xFE508000, 0xE8108000) && !matches(e, 0x00400000, 0x00400000))  // LDM, POP with PC
           || matches(e, 0xFFF0FFE0, 0xE8D0F000);                                          // TBB, TBH
}

bool stores_16(std::uint32_t e) {
    return matches(e, 0xFE00, 0x5000) || matches(e, 0xFE00, 0x5200) || matches(e, 0xFE00, 0x5400)  // by register
           || (e >= 0x6000 && e < 0xA000 && !matches(e, 0x0800, 0x0800))                           // by immediate
           || matches(e, 0xF800, 0xC000)                                                           // STM
           || matches(e, 0xFE00, 0xB400);                                                          // PUSH
}

}  // namespace

bool is_branch(const Instruction& instruction) {
    return instruction.bytes == 2 ? is_branch_16(instruction.encoding) : is_branch_32(instruction.encoding);
}

bool stores(const Instruction& instruction) {
    // All 32-bit forms, those of the FPU included, have one bit for it.
    return instruction.bytes == 2 ? stores_16(instruction.encoding)
                                  : !matches(instruction.encoding, 1U << 20, 1U << 20);
}

bool moves_pair(const Instruction& instruction) {
    // Neither indexed nor written back would be an exclusive access or a table branch.
    return instruction.bytes == 4 && matches(instruction.encoding, 0xFE400000, 0xE8400000) &&
           !matches(instruction.encoding, 0x01200000, 0);
}

bool is_call(const Instruction& instruction) {
    return instruction.bytes == 2 ? matches(instruction.encoding, 0xFF80, 0x4780)
                                  : matches(instruction.encoding, 0xF800D000, 0xF000D000);
}

}  // namespace qemu
