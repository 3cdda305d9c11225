// What one row's timed calls become, from logs written by hand.
#include "qemu/emulate/modelled_calls.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/failure.hpp"

namespace {

constexpr firmware::TimedCalls timed{2, false};
constexpr std::uint64_t instructions = 7;

timing::TimedRun run(std::uint64_t calls, std::int64_t half_cycles) {
    return {calls, {.entry = 0x100, .instructions = instructions, .cores = {{.half_cycles = {half_cycles}}}}};
}

// The calls of a row, ten cycles each, and behind them `halves`.
timing::TimingLog log_of(const std::vector<timing::TimedRun>& halves) {
    timing::TimingLog log;
    for (std::size_t call = 0; call < timed.calls(); ++call) {
        if (timed.contains(call)) {
            log.runs.push_back(run(1, 20));
        }
    }
    log.runs.insert(log.runs.end(), halves.begin(), halves.end());
    return log;
}

qemu::ModelledCall modelled(const timing::TimingLog& log, std::size_t answers) {
    return qemu::modelled_calls(log, timed, timed.calls(), 1, instructions, "made up", answers).at(0);
}

TEST(ModelledCalls, LatencyIsTheMeanOfTheFirstHalvesAndElseTheWholeCall) {
    EXPECT_EQ(modelled(log_of({}), 0).latency_cycles, 10.0);
    const auto halves = modelled(log_of({run(3, 6), run(1, 10)}), 4);
    EXPECT_EQ(halves.latency_cycles, 3.5);
    EXPECT_EQ(halves.cycles, 10.0);
    EXPECT_EQ(halves.worst_cycles, 10.0);
}

TEST(ModelledCalls, AFirstHalfTooManyOrTooFewIsAFault) {
    EXPECT_THROW((void)modelled(log_of({run(3, 6)}), 4), glsum::Failure);
    EXPECT_THROW((void)modelled(log_of({run(3, 6)}), 0), glsum::Failure);
    EXPECT_THROW((void)modelled(log_of({run(5, 6)}), 4), glsum::Failure);
}

// Two cores, of three rule sets and one; every number by hand from calls that differ.
TEST(ModelledCalls, EachCoreHasItsMeansItsBandAndItsLosses) {
    constexpr firmware::TimedCalls row{2, false};
    timing::TimingLog log;
    std::size_t steady = 0;
    for (std::size_t call = 0; call < row.calls(); ++call) {
        if (!row.contains(call)) {
            continue;
        }
        timing::CoreTime first;
        timing::CoreTime second;
        if (call == 0) {
            first.half_cycles = {200, 180, 260};
            second.half_cycles = {400};
        } else if (row.is_steady(call)) {
            // 16 of 32 take 20 half cycles, 16 take 30: 12.5 cycles a call.
            const bool slow = steady++ % 2 == 1;
            first.half_cycles = {slow ? 30 : 20, slow ? 24 : 16, slow ? 50 : 30};
            first.losses[0] = slow ? 8 : 4;
            first.losses[timing::effect_count - 1] = 2;
            first.double_in_software = slow ? 6 : 2;
            second.half_cycles = {100};
        } else {
            first.half_cycles = {row.is_full(call) ? 44 : 1000, 1, 2000};
            second.half_cycles = {row.is_full(call) ? 120 : 1000};
        }
        log.runs.push_back({1, {.entry = 0x100, .instructions = 7, .cores = {first, second}}});
    }
    ASSERT_EQ(steady, 32U);
    const auto found = qemu::modelled_calls(log, row, row.calls(), 2, 7, "made up");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_DOUBLE_EQ(found[0].cycles, 12.5);
    EXPECT_DOUBLE_EQ(found[0].low, 10.0);
    EXPECT_DOUBLE_EQ(found[0].high, 20.0);
    EXPECT_EQ(found[0].first_cycles, 100.0);
    EXPECT_DOUBLE_EQ(found[0].lost[0], 3.0);
    EXPECT_DOUBLE_EQ(found[0].lost[timing::effect_count - 1], 1.0);
    EXPECT_EQ(found[0].lost[1], 0.0);
    EXPECT_DOUBLE_EQ(found[0].double_in_software, 2.0);
    EXPECT_EQ(found[0].latency_cycles, found[0].cycles);
    EXPECT_DOUBLE_EQ(found[1].cycles, 50.0);
    EXPECT_DOUBLE_EQ(found[1].low, 50.0);
    EXPECT_EQ(found[1].first_cycles, 200.0);
    // The worst of all that were timed with a full past, the steady ones among them.
    EXPECT_EQ(found[0].worst_cycles, row.turn() > row.steady() ? 22.0 : 15.0);
    EXPECT_EQ(found[1].worst_cycles, row.turn() > row.steady() ? 60.0 : 50.0);
}

TEST(ModelledCalls, ALogOfOtherCallsIsAFaultThatSaysSo) {
    const auto said = [](const timing::TimingLog& log, std::size_t cores, std::uint64_t first) {
        try {
            (void)qemu::modelled_calls(log, timed, timed.calls(), cores, first, "made up");
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::check_failed);
            return std::string(failure.what());
        }
        return std::string("nothing");
    };
    EXPECT_EQ(said(log_of({}), 1, instructions), "nothing");
    EXPECT_EQ(said(log_of({}), 1, instructions + 1),
              "the timing model, made up: its first call has 7 instructions, the counter's 8");
    EXPECT_EQ(said(log_of({}), 2, instructions),
              "the timing model, made up: it saw fewer calls than the program marked");
    timing::TimingLog fewer = log_of({});
    fewer.runs.pop_back();
    EXPECT_EQ(said(fewer, 1, instructions), "the timing model, made up: it saw fewer calls than the program marked");
    EXPECT_EQ(said(log_of({run(1, 20)}), 1, instructions),
              "the timing model, made up: it saw more calls than the program marked");
    // Only the first call's instructions are held against the counter's.
    timing::TimingLog other = log_of({});
    other.runs[1].call.instructions = 9;
    EXPECT_EQ(said(other, 1, instructions), "nothing");
}

}  // namespace
