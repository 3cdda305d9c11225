// One run of Google Benchmark: the flags that it gets, and the rows that it gives.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

/// Sets Google Benchmark's flags for the next run. It keeps its flags from one run to the next, so that each says all
/// that it wants; of two that contradict each other the later counts.
/// \throws glsum::Failure (bad input) for a flag that it does not know.
void set_benchmark_flags(const std::vector<std::string>& flags);

/// Runs what was registered, shows the progress, and forgets what was registered.
/// \param benchmarks  how many were registered
/// \return what Google Benchmark's own JSON reporter writes: "context" and "benchmarks"
/// \throws glsum::Failure (bad input) where a filter among the flags left none.
[[nodiscard]] Json run_benchmarks(std::size_t benchmarks);

}  // namespace bench
