// What one row's timed calls become, from logs written by hand.
#include "qemu/modelled_calls.hpp"

#include <gtest/gtest.h>

#include "qemu/failure.hpp"

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

}  // namespace
