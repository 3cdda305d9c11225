// What moves the stack pointer, by its encoding as binutils assemble it, and how deep a call goes.
#include "qemu/timing/stack_depth.hpp"

#include <gtest/gtest.h>

#include "listing.hpp"

namespace {

std::optional<timing::StackMove> move_of(const std::string& text) {
    const listing::Line line = listing::assemble(text + "\n").front();
    return timing::stack_move(line.encoding, line.bytes);
}

TEST(StackDepth, KnowsWhatMovesTheStackPointer) {
    const std::tuple<const char*, std::int32_t, bool, bool> moves[] = {
        {"push {r4,lr}", -8, true, false},
        {"pop {r4,pc}", 8, false, true},
        {"push.w {r4-r11,lr}", -36, true, false},
        {"pop.w {r4-r11,pc}", 36, false, true},
        {"vpush {s16-s19}", -16, true, false},
        {"vpop {d8-d9}", 16, false, true},
        {"vpush {s17}", -4, true, false},
        {"str r4,[sp,#-4]!", -4, true, false},
        {"ldr pc,[sp],#4", 4, false, true},
        {"sub sp,#16", -16, false, false},
        {"add sp,#508", 508, false, false},
        {"sub.w sp,sp,#1024", -1024, false, false},
        {"add.w sp,sp,#4096", 4096, false, false},
        {"subw sp,sp,#1028", -1028, false, false},
        {"addw sp,sp,#4095", 4095, false, false},
        {"subw sp,sp,#2049", -2049, false, false},
        {"addw sp,sp,#1793", 1793, false, false},
        {"sub.w sp,sp,#255", -255, false, false},
        {"add.w sp,sp,#33024", 33024, false, false},
        {"sub.w sp,sp,#0xff0", -0xFF0, false, false},
        {"add.w sp,sp,#0x00ab00ab", 0x00AB00AB, false, false},
        {"add.w sp,sp,#0x2c002c00", 0x2C002C00, false, false},
        {"add.w sp,sp,#0x12121212", 0x12121212, false, false},
        {"sub.w sp,sp,#0x7f000000", -0x7F000000, false, false},
        {"add sp,#4", 4, false, false},
        {"vpush {s0-s31}", -128, true, false},
        {"str r4,[sp,#-252]!", -252, true, false},
    };
    for (const auto& [text, bytes, stores, loads] : moves) {
        const auto move = move_of(text);
        ASSERT_TRUE(move) << text;
        EXPECT_EQ(move->bytes, bytes) << text;
        EXPECT_EQ(move->stores, stores) << text;
        EXPECT_EQ(move->loads, loads) << text;
    }
    for (const char* text : {"add r0,sp,#16", "str r0,[sp,#4]", "ldr r0,[sp,#4]", "stmia r0!,{r1,r2}", "mov sp,r7",
                             "sub.w r0,r0,#16", "vldr s0,[sp]", "stmdb r0!,{r1,r2}", "str r0,[r1,#-4]!", "bx lr"}) {
        EXPECT_FALSE(move_of(text)) << text;
    }
}

TEST(StackDepth, IsWhatACallGoesBelowItsCaller) {
    timing::StackDepth stack;
    const qemu::Access pushed[] = {{0x20000FF8, 4, true}, {0x20000FFC, 4, true}};
    stack.begin();
    stack.follow({-8, true, false}, pushed);
    stack.follow({-24, false, false}, {});
    EXPECT_EQ(stack.deepest(), 32U);
    stack.follow({24, false, false}, {});
    const qemu::Access popped[] = {{0x20000FF8, 4, false}, {0x20000FFC, 4, false}};
    stack.follow({8, false, true}, popped);
    EXPECT_EQ(stack.deepest(), 32U);
    // The next call, whose stack pointer was moved by a register: its callee's push shows by how much.
    stack.begin();
    const qemu::Access deeper[] = {{0x20000F00, 4, true}};
    stack.follow({-4, true, false}, deeper);
    EXPECT_EQ(stack.deepest(), 0x100U);
    // A push whose condition was false moves nothing; a stack above is another one.
    stack.begin();
    stack.follow({-4, true, false}, {});
    EXPECT_EQ(stack.deepest(), 0U);
    const qemu::Access above[] = {{0x20010000, 4, true}};
    stack.follow({-4, true, false}, above);
    EXPECT_EQ(stack.deepest(), 0U);
}

// Until an access shows where it points all is relative; a pop shows where it pointed before.
TEST(StackDepth, IsKnownByTheFirstAccess) {
    const qemu::Access at[] = {{0x20000FFC, 4, false}, {0x20000FF8, 4, false}};
    timing::StackDepth pushed;
    pushed.begin();
    pushed.follow({-16, false, false}, {});
    pushed.follow({-8, true, false}, at);
    EXPECT_EQ(pushed.deepest(), 24U);
    pushed.follow({-8, false, false}, {});
    EXPECT_EQ(pushed.deepest(), 32U);
    timing::StackDepth popped;
    popped.begin();
    popped.follow({-16, false, false}, {});
    popped.follow({8, false, true}, at);  // to 0x20001000, 8 below where it began
    EXPECT_EQ(popped.deepest(), 16U);
    popped.begin();
    const qemu::Access lower[] = {{0x20000F00, 4, true}};
    popped.follow({-4, true, false}, lower);
    EXPECT_EQ(popped.deepest(), 0x100U);
    // A pop whose condition was false moves nothing either.
    popped.begin();
    popped.follow({64, false, true}, {});
    popped.follow({-4, true, false}, std::vector<qemu::Access>{{0x20000EFC, 4, true}});
    EXPECT_EQ(popped.deepest(), 4U);
}

}  // namespace
