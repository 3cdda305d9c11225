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
    } jumps[] = {{"b", 0xE0F6, 2}, {"bx r3", 0x4718, 2}, {"mov pc, r3", 0x469F, 2}, {"ldr.w pc, [r3]", 0xF8D3F000, 4}};
    for (const auto& [text, encoding, bytes] : jumps) {
        timing::CallStack stack = behind(encoding, bytes);
        EXPECT_FALSE(stack.called()) << text;
        EXPECT_EQ(stack.arrive(to), 0U) << text;
        EXPECT_EQ(stack.depth(), 0U) << text;
    }
}

}  // namespace
