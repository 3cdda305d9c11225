// What an executed program looks like from outside: instructions with their addresses, and the memory accesses that
// they really made. The plugin produces this stream; counters and timing models consume it. No QEMU header here.
#pragma once

#include <cstdint>
#include <vector>

namespace qemu {

struct Instruction {
    std::uint32_t address;
    std::uint32_t encoding;  ///< 16-bit: the halfword; 32-bit: first halfword in the upper half
    std::uint8_t bytes;      ///< 2 or 4
    std::uint32_t index;     ///< numbers the distinct instructions from 0: consumers decode each once and keep it there
};

/// Instructions that are executed one after the other whenever the first of them is: only the last may branch.
struct TranslationBlock {
    std::vector<Instruction> instructions;  ///< at least one
    std::uint32_t index;                    ///< numbers the distinct blocks from 0
};

struct Access {
    std::uint32_t address;
    std::uint8_t bytes;
    bool store;
    std::uint16_t by = 0;  ///< which instruction of its block makes it, where blocks are told
};

/// Called before each instruction, those included whose condition is false, and after that for each of its accesses:
/// LDRD makes two of four bytes, LDM, VLDM, PUSH and POP one per register, a VLDR of a double one of eight.
class StreamConsumer {
public:
    virtual ~StreamConsumer() = default;
    virtual void executes(const Instruction& instruction) = 0;
    virtual void accesses(const Access& access) = 0;
};

}  // namespace qemu
