// Which instructions call, and what is under way behind them.
#include "qemu/timing/call_stack.hpp"

#include <gtest/gtest.h>

#include "qemu/timing/decode.hpp"

namespace {

constexpr std::uint32_t from = 0x10;
constexpr std::uint32_t to = 0x200;

// The stack behind one instruction at `from` that control left to `to`.
timing::CallStack behind(std::uint32_t encoding, std::uint8_t bytes) {
    timing::CallStack stack({});
    (void)stack.arrive(from);
    stack.leave(timing::decode(encoding, bytes), from, to);
    return stack;
}

TEST(CallStack, CallsByNameAndByRegisterReturnBehindThem) {
    const struct {
        const char* text;
        std::uint32_t encoding;
        std::uint8_t bytes;
    } calls[] = {{"bl", 0xF000F8F6, 4}, {"blx r3", 0x4798, 2}};
    for (const auto& [text, encoding, bytes] : calls) {
        timing::CallStack stack = behind(encoding, bytes);
        EXPECT_TRUE(stack.called()) << text;
        EXPECT_EQ(stack.arrive(to), 0U) << text << ": its own call is not one of those before";
        EXPECT_EQ(stack.depth(), 1U) << text;
        stack.leave(timing::decode(0x4770, 2), to, from + bytes);  // bx lr
        EXPECT_FALSE(stack.called()) << text;
        EXPECT_EQ(stack.arrive(from + bytes), 0U) << text;
        EXPECT_EQ(stack.depth(), 0U) << text;
    }
}

TEST(CallStack, JumpsAreNoCalls) {
    const struct {
        const char* text;
        std::uint32_t encoding;
        std::uint8_t bytes;
    } jumps[] = {{"b", 0xE0F6, 2},
                 {"bx r3", 0x4718, 2},
                 {"mov pc, r3", 0x469F, 2},
                 {"ldr.w pc, [r3]", 0xF8D3F000, 4},
                 {"ldm.w r3, {lr, pc}", 0xE893C000, 4}};
    for (const auto& [text, encoding, bytes] : jumps) {
        timing::CallStack stack = behind(encoding, bytes);
        EXPECT_FALSE(stack.called()) << text;
        EXPECT_EQ(stack.arrive(to), 0U) << text;
        EXPECT_EQ(stack.depth(), 0U) << text;
    }
}

// What sets all registers leaves calls for the middle of a function further down: so does its first instruction, its
// last, and none beside them.
TEST(CallStack, OnlyARestorerLeavesCallsWithoutReturning) {
    constexpr std::uint32_t first = 0x40;
    constexpr std::uint32_t end = 0x50;
    const auto depth_after_a_jump_from = [&](std::uint32_t address) {
        timing::CallStack stack({});
        stack.watch_unwinding({{{first, end}}, {{0x100, 1}, {0x180, 2}, {0x200, 3}}});
        const timing::Decoded call = timing::decode(0x4798, 2);  // blx r3
        (void)stack.arrive(0x110);                               // in function 1
        stack.leave(call, 0x110, 0x180);
        (void)stack.arrive(0x180);  // in function 2
        stack.leave(call, 0x180, address);
        (void)stack.arrive(address);
        EXPECT_EQ(stack.depth(), 2U);
        stack.leave(timing::decode(0x4718, 2), address, 0x130);  // bx r3, to function 1, not behind its call
        (void)stack.arrive(0x130);
        return stack.depth();
    };
    EXPECT_EQ(depth_after_a_jump_from(first - 2), 2U);
    EXPECT_EQ(depth_after_a_jump_from(first), 0U);
    EXPECT_EQ(depth_after_a_jump_from(end - 2), 0U);
    EXPECT_EQ(depth_after_a_jump_from(end), 2U);
}

}  // namespace
