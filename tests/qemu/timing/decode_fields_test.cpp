// Fields of encodings that no assembler sets, or not all of them: bit by bit, as the architecture's manual has them.
#include <gtest/gtest.h>

#include "qemu/timing/decode.hpp"

namespace {

using timing::decode;
using timing::Kind;

// LDR and STR with a register: bits 10 to 6 are zero, 5 and 4 shift the index.
TEST(DecodeFields, ARegisterOffsetIsShiftedByThreeAtMost) {
    for (const std::uint32_t e : {0xF8510002U /* ldr.w r0, [r1, r2] */, 0xF8410002U /* str.w */,
                                  0xF8110002U /* ldrb.w */, 0xF8210002U /* strh.w */, 0xF9310002U /* ldrsh.w */}) {
        const Kind kind = decode(e, 4).kind;
        EXPECT_TRUE(kind == Kind::load || kind == Kind::store) << std::hex << e;
        for (unsigned bit = 4; bit <= 10; ++bit) {
            EXPECT_EQ(decode(e | 1U << bit, 4).kind, bit < 6 ? kind : Kind::unknown) << std::hex << e << " " << bit;
        }
    }
}

// B<c>.W: the condition is in bits 25 to 22, below the sign; 14 and 15 are other instructions.
TEST(DecodeFields, AWideBranchHasItsConditionBesideItsSign) {
    for (std::uint32_t condition = 0; condition < 14; ++condition) {
        const timing::Decoded forward = decode(0xF0008000U | condition << 22, 4);
        EXPECT_EQ(forward.branch, timing::Branch::conditional) << condition;
        EXPECT_EQ(forward.condition, condition);
        EXPECT_FALSE(forward.backward) << condition;
        const timing::Decoded backward = decode(0xF4008000U | condition << 22, 4);
        EXPECT_EQ(backward.branch, timing::Branch::conditional) << condition;
        EXPECT_EQ(backward.condition, condition);
        EXPECT_TRUE(backward.backward) << condition;
    }
}

}  // namespace
