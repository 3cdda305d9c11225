// How deep the stack goes, followed through the stream: no register is seen there, but what moves the stack pointer is,
// and a push shows where it points.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "qemu/stream/stream.hpp"

namespace timing {

/// What an instruction does to the stack pointer.
struct StackMove {
    std::int32_t bytes = 0;  ///< added to it
    bool stores = false;     ///< where it points afterwards: the lowest address stored to
    bool loads = false;      ///< where it pointed before: the lowest address loaded from
};

/// PUSH, POP, VPUSH, VPOP and their wide forms, STR and LDR of one register with SP written back, additions of an
/// immediate to SP. \return nothing for all else, moves from another register among it: the next push tells.
[[nodiscard]] std::optional<StackMove> stack_move(std::uint32_t encoding, std::uint8_t bytes);

class StackDepth {
public:
    /// \param accesses  of the instruction; empty when its condition was false
    void follow(const StackMove& move, std::span<const qemu::Access> accesses);
    void begin() { entered_ = lowest_ = pointer_; }
    /// Bytes below where `begin` found it.
    [[nodiscard]] std::uint32_t deepest() const { return entered_ - lowest_; }

private:
    std::uint32_t pointer_ = 0;  // relative until it is known
    std::uint32_t entered_ = 0;
    std::uint32_t lowest_ = 0;
    bool known_ = false;
};

}  // namespace timing
