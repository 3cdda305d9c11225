// The counter on streams written by hand.
#include "qemu/call_counter.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

namespace {

constexpr std::uint32_t entry = 0x100;

// A program of instructions at fixed places.
struct Program {
    qemu::CallCounter counter{{entry}};
    std::map<std::uint32_t, qemu::Instruction> instructions;

    void run(std::uint32_t address, std::uint32_t encoding, std::uint8_t bytes) {
        const auto index = static_cast<std::uint32_t>(instructions.size());
        counter.executes(
            instructions.try_emplace(address, qemu::Instruction{address, encoding, bytes, index}).first->second);
    }
    void call() { run(0x10, 0xF000F876, 4); }  // bl 0x100
    void add(std::uint32_t address) { run(address, 0x3001, 2); }
    void load(std::uint32_t address, bool store = false) {
        run(address, 0x6808, 2);
        counter.accesses({0x20000000, 4, store});
    }
    void give_back(std::uint32_t address) { run(address, 0x4770, 2); }  // bx lr
};

TEST(CallCounter, CountsFromTheEntryToTheReturnAndNothingElse) {
    Program p;
    p.load(0x8);
    p.call();
    p.add(0x100);
    p.load(0x102);
    p.load(0x104, true);
    p.give_back(0x106);
    p.load(0x14);  // behind the call
    ASSERT_EQ(p.counter.runs().size(), 1U);
    EXPECT_EQ(p.counter.runs()[0].entry, entry);
    EXPECT_EQ(p.counter.runs()[0].calls, 1U);
    EXPECT_EQ(p.counter.runs()[0].counts, (qemu::CallCounts{4, 1, 1, 1}));
    EXPECT_EQ(p.counter.reached().at(entry), (std::set<std::uint32_t>{0x100, 0x102, 0x104, 0x106}));
}

TEST(CallCounter, CalleesCountAndEqualCallsAreJoined) {
    Program p;
    for (int i = 0; i < 3; ++i) {
        p.call();
        p.run(0x100, 0xF000F87E, 4);  // bl 0x200
        p.load(0x200);
        p.give_back(0x202);
        p.give_back(0x104);
        p.add(0x14);
    }
    p.call();
    p.give_back(0x100);
    p.add(0x14);
    ASSERT_EQ(p.counter.runs().size(), 2U);
    EXPECT_EQ(p.counter.runs()[0].calls, 3U);
    EXPECT_EQ(p.counter.runs()[0].counts, (qemu::CallCounts{4, 1, 0, 3}));
    EXPECT_EQ(p.counter.runs()[1].counts, (qemu::CallCounts{1, 0, 0, 1}));
}

TEST(CallCounter, WritesALogThatReadsBack) {
    Program p;
    p.call();
    p.load(0x100);
    p.give_back(0x102);
    p.add(0x14);
    std::stringstream log;
    p.counter.write(log);
    const qemu::CallLog read = qemu::read_call_log(log);
    ASSERT_EQ(read.runs.size(), 1U);
    EXPECT_EQ(read.runs[0].counts, (qemu::CallCounts{2, 1, 0, 1}));
    EXPECT_EQ(read.reached.at(entry), (std::set<std::uint32_t>{0x100, 0x102}));
}

TEST(CallCounter, RefusesToBeTrustedWhenItCannotKnow) {
    Program jumped;
    jumped.run(0x10, 0xE076, 2);  // b 0x100: no return address
    jumped.add(0x100);
    EXPECT_NE(jumped.counter.fault(), "");
    std::stringstream log;
    jumped.counter.write(log);
    EXPECT_THROW(qemu::read_call_log(log), std::runtime_error);

    Program stuck;
    stuck.call();
    stuck.add(0x100);
    std::stringstream cut;
    stuck.counter.write(cut);
    EXPECT_THROW(qemu::read_call_log(cut), std::runtime_error);

    std::stringstream empty;
    EXPECT_THROW(qemu::read_call_log(empty), std::runtime_error);
    std::stringstream damaged("calls 1 2 x\nend\n");
    EXPECT_THROW(qemu::read_call_log(damaged), std::runtime_error);
}

}  // namespace
