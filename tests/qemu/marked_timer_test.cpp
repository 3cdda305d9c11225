// A program that marks what is to be timed, and which calls `measure` marks.
#include "qemu/timing/marked_timer.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "targets/shared/timed_calls.hpp"

namespace {

constexpr qemu::Marks marks{0x200, 0x210, 0x220};

// Calls f at 0x100 (movs r0, #1; it jumps over a line; bx lr) from 0x20, as an emulator would tell it.
void call(qemu::MarkedTimer& timer) {
    timer.executes({0x20, 0xF000F86E, 4, 0});
    timer.executes({0x100, 0x2001, 2, 1});
    timer.executes({0x102, 0xE01D, 2, 2});
    timer.executes({0x140, 0x4770, 2, 3});
    timer.executes({0x24, 0xBF00, 2, 4});
}

std::vector<timing::CoreFile> cores() { return {timing::read_core(TEST_CORES, "stm32f746-flash")}; }

TEST(MarkedTimer, WithoutMarksTheWholeProgramIsOnePart) {
    std::stringstream log;
    qemu::MarkedTimer timer({0x100}, cores(), {}, log);
    EXPECT_TRUE(timer.on());
    EXPECT_FALSE(timer.is_mark(0x200));
    call(timer);
    timer.finish();
    const timing::TimingLog read = timing::read_timing_log(log);
    ASSERT_EQ(read.runs.size(), 1U);
    EXPECT_EQ(read.runs[0].calls, 1U);
    EXPECT_EQ(read.runs[0].call.instructions, 3U);
}

// One that another calls has calls of its own: each function's log is as if it were timed alone.
TEST(MarkedTimer, WithoutMarksEachFunctionHasALogOfItsOwn) {
    const auto logs_of = [](const std::set<std::uint32_t>& entries) {
        std::stringstream text;
        qemu::MarkedTimer timer(entries, cores(), {}, text);
        call(timer);
        call(timer);
        timer.finish();
        return text.str();
    };
    const std::string outer = logs_of({0x100});
    const std::string inner = logs_of({0x140});
    EXPECT_EQ(logs_of({0x140, 0x100}), outer + inner);
    EXPECT_NE(inner.find("calls"), std::string::npos);
}

TEST(MarkedTimer, KnowsWhereTheProgramFaulted) {
    std::stringstream log;
    qemu::MarkedTimer timer({0x100}, cores(), {}, log, {}, {}, {0x140});
    EXPECT_FALSE(timer.fault());
    call(timer);
    EXPECT_EQ(timer.fault(), 0x102U);
    qemu::MarkedTimer none({0x100}, cores(), marks, log, {}, {0x140});
    EXPECT_FALSE(none.fault());  // before the first row there is no part
}

TEST(MarkedTimer, EachRowStartsColdAndHasALogOfItsOwn) {
    std::stringstream log;
    qemu::MarkedTimer timer({0x100}, cores(), marks, log);
    EXPECT_TRUE(timer.is_mark(0x200) && timer.is_mark(0x210) && timer.is_mark(0x220));
    EXPECT_FALSE(timer.is_mark(0x100));
    timer.meets_mark(marks.on);  // before any row: nothing to time
    EXPECT_FALSE(timer.on());
    for (int row = 0; row < 2; ++row) {
        timer.meets_mark(marks.row);
        EXPECT_FALSE(timer.on());
        timer.meets_mark(marks.on);
        EXPECT_TRUE(timer.on());
        call(timer);
        call(timer);
        timer.meets_mark(marks.off);
        EXPECT_FALSE(timer.on());
        timer.meets_mark(marks.on);
        call(timer);
        timer.meets_mark(marks.off);
    }
    timer.finish();
    std::vector<timing::TimingLog> rows;
    for (int row = 0; row < 2; ++row) {
        rows.push_back(timing::read_timing_log(log));
        ASSERT_GE(rows[row].runs.size(), 2U);
        std::uint64_t calls = 0;
        for (const auto& run : rows[row].runs) {
            calls += run.calls;
        }
        EXPECT_EQ(calls, 3U);
        // Lines are fetched once.
        EXPECT_GT(rows[row].runs.front().call.cores[0].half_cycles[0],
                  rows[row].runs.back().call.cores[0].half_cycles[0]);
    }
    EXPECT_EQ(log.peek(), std::stringstream::traits_type::eof());
    ASSERT_EQ(rows[0].runs.size(), rows[1].runs.size());
    for (std::size_t i = 0; i < rows[0].runs.size(); ++i) {
        EXPECT_EQ(rows[0].runs[i].call.cores[0].half_cycles, rows[1].runs[i].call.cores[0].half_cycles);
    }
}

TEST(TimedCalls, HoldFirstSteadyAndTheTurnsEnd) {
    for (const bool software_double : {false, true}) {
        for (const std::size_t taps : {1U, 2U, 31U, 32U, 33U, 64U, 65U, 600U, 5000U}) {
            const firmware::TimedCalls timed{taps, software_double};
            const std::size_t calls = timed.calls();
            EXPECT_EQ(calls, 1 + taps + (software_double ? 32 : std::max<std::size_t>(taps, 32)));
            std::size_t count = 0;
            std::size_t steady = 0;
            for (std::size_t call = 0; call < calls; ++call) {
                count += timed.contains(call) ? 1U : 0U;
                steady += timed.is_steady(call) ? 1U : 0U;
                EXPECT_TRUE(timed.contains(call) || !timed.is_steady(call));
            }
            EXPECT_EQ(steady, timed.steady()) << taps;
            EXPECT_TRUE(timed.contains(0));
            EXPECT_TRUE(timed.contains(calls - 1)) << taps;  // the ring wraps
            // The call before the steady ones settles what they meet; where it is costly they meet what the first left.
            EXPECT_TRUE(software_double || timed.contains(taps)) << taps;
            EXPECT_FALSE(timed.is_steady(taps));
            EXPECT_TRUE(timed.is_steady(taps + 1));
            EXPECT_LE(count, software_double ? 3U : 67U) << taps;
        }
    }
}

}  // namespace
