// Timing one line, and checking what it answers.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "bench/host/timed_line.hpp"
#include "reference/real.hpp"

namespace bench {

/// A sample in ns, the shortest of some short tries in steady state.
/// \param taps  samples until the steady state
[[nodiscard]] double estimated_ns(TimedLine& line, std::size_t taps);

/// Feeds the line for as long as Google Benchmark wants, then checks the output that follows; a wrong one is an error
/// of the row.
/// \param weights  of the exact sum, newest first
/// \param rests    the line's past has no end: it is emptied, and filled as far as the weights reach, before the check
void time_line(benchmark::State& state, TimedLine& line, const std::vector<reference::Real>& weights, bool rests);

}  // namespace bench
