// Timing on the host, by Google Benchmark.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/row.hpp"
#include "bench/sweep.hpp"

namespace bench {

struct HostTiming {
    std::vector<Json> rows;
    Json context;  ///< as Google Benchmark writes it
};

/// Times one sample at a time, with a sliding window in steady state and its upkeep inside, for every kernel, peer and
/// length of the sweep, once: at its first order, on which the time does not depend. After each timing the next output
/// is compared with the reference; a wrong one marks the row.
/// With `sweep.repetitions` above 1 each timing is taken so often, some 2 ms each, all in random turns.
/// \param flags  Google Benchmark's own, as given by the user
/// \throws glsum::Failure (bad input) for a flag that it does not know.
[[nodiscard]] HostTiming time_on_host(const Sweep& sweep, const std::vector<std::string>& flags);

/// The same for chosen pairs of a kernel and a length.
[[nodiscard]] HostTiming time_on_host(const std::vector<std::pair<std::string, Length>>& pairs, double order,
                                      unsigned repetitions, const std::vector<std::string>& flags);

}  // namespace bench
