#include "qemu/timing/stack_depth.hpp"

#include <algorithm>
#include <bit>

namespace timing {
namespace {

std::int32_t words_of(std::uint32_t list) { return 4 * std::popcount(list); }

// [ARMv7-M A5.3.2, ThumbExpandImm]
std::int32_t expanded(std::uint32_t encoding) {
    const std::uint32_t imm12 = (encoding >> 26 & 1U) << 11 | (encoding >> 12 & 7U) << 8 | (encoding & 0xFFU);
    if (imm12 >> 10 != 0) {
        return static_cast<std::int32_t>(std::rotr(0x80U | (imm12 & 0x7FU), static_cast<int>(imm12 >> 7)));
    }
    const std::uint32_t byte = imm12 & 0xFFU;
    const std::uint32_t patterns[] = {byte, byte << 16 | byte, byte << 24 | byte << 8, byte * 0x01010101U};
    return static_cast<std::int32_t>(patterns[imm12 >> 8]);
}

}  // namespace

std::optional<StackMove> stack_move(std::uint32_t encoding, std::uint8_t bytes) {
    if (bytes == 2) {
        switch (encoding >> 9) {
            case 0x5A:
                return StackMove{-words_of(encoding & 0x1FFU), true, false};  // PUSH, LR with bit 8
            case 0x5E:
                return StackMove{words_of(encoding & 0x1FFU), false, true};  // POP, PC with bit 8
            default:
                break;
        }
        if (encoding >> 8 == 0xB0) {  // ADD, SUB of 7 bits
            const auto amount = static_cast<std::int32_t>(4 * (encoding & 0x7FU));
            return StackMove{(encoding & 0x80U) != 0 ? -amount : amount, false, false};
        }
        return std::nullopt;
    }
    switch (encoding >> 16) {
        case 0xE92D:
            return StackMove{-words_of(encoding & 0xFFFFU), true, false};  // STMDB SP!
        case 0xE8BD:
            return StackMove{words_of(encoding & 0xFFFFU), false, true};  // LDMIA SP!
        default:
            break;
    }
    if ((encoding & 0xFFBF0E00U) == 0xED2D0A00U) {  // VPUSH: the immediate counts words
        return StackMove{-static_cast<std::int32_t>(4 * (encoding & 0xFFU)), true, false};
    }
    if ((encoding & 0xFFBF0E00U) == 0xECBD0A00U) {  // VPOP
        return StackMove{static_cast<std::int32_t>(4 * (encoding & 0xFFU)), false, true};
    }
    if ((encoding & 0xFFFF0F00U) == 0xF84D0D00U) {  // STR Rt, [SP, #-imm]!
        return StackMove{-static_cast<std::int32_t>(encoding & 0xFFU), true, false};
    }
    if ((encoding & 0xFFFF0F00U) == 0xF85D0B00U) {  // LDR Rt, [SP], #imm
        return StackMove{static_cast<std::int32_t>(encoding & 0xFFU), false, true};
    }
    if ((encoding & 0xFBEF8F00U) == 0xF1AD0D00U) {  // SUB SP, SP, #const
        return StackMove{-expanded(encoding), false, false};
    }
    if ((encoding & 0xFBEF8F00U) == 0xF10D0D00U) {  // ADD SP, SP, #const
        return StackMove{expanded(encoding), false, false};
    }
    const auto imm12 =
        static_cast<std::int32_t>((encoding >> 26 & 1U) << 11 | (encoding >> 12 & 7U) << 8 | (encoding & 0xFFU));
    if ((encoding & 0xFBFF8F00U) == 0xF2AD0D00U) {  // SUBW SP, SP, #imm12
        return StackMove{-imm12, false, false};
    }
    if ((encoding & 0xFBFF8F00U) == 0xF20D0D00U) {  // ADDW SP, SP, #imm12
        return StackMove{imm12, false, false};
    }
    return std::nullopt;
}

void StackDepth::follow(const StackMove& move, std::span<const qemu::Access> accesses) {
    if ((move.stores || move.loads) && accesses.empty()) {
        return;
    }
    std::uint32_t after = pointer_ + static_cast<std::uint32_t>(move.bytes);
    if (!accesses.empty()) {
        const std::uint32_t lowest =
            std::min_element(accesses.begin(), accesses.end(), [](const qemu::Access& a, const qemu::Access& b) {
                return a.address < b.address;
            })->address;
        const std::uint32_t seen = move.stores ? lowest : lowest + static_cast<std::uint32_t>(move.bytes);
        if (!known_) {  // all so far was relative
            entered_ += seen - after;
            lowest_ += seen - after;
            known_ = true;
        }
        after = seen;
    }
    pointer_ = after;
    // Below what it was on entry; what lies above is another stack, or a caller's.
    if (entered_ - pointer_ < 0x80000000U && entered_ - pointer_ > entered_ - lowest_) {
        lowest_ = pointer_;
    }
}

}  // namespace timing
