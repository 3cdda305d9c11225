// A decoded instruction with what does not change from one execution to the next, and stretches of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "qemu/timing/decoded.hpp"
#include "qemu/timing/latency.hpp"

namespace timing {

struct Prepared {
    Decoded decoded;
    std::array<Consumer, 36> consumers{};
    explicit Prepared(const Decoded& d);
};

/// Instructions one behind the other, of which only the last may branch.
struct CodeBlock {
    struct Instruction {
        const Prepared* instruction;
        std::uint32_t site;  ///< numbers the distinct instructions
        std::uint32_t address;
    };
    std::uint32_t index = 0;         ///< numbers the distinct blocks
    std::vector<Instruction> lines;  ///< at least one
};

}  // namespace timing
