// Timing on the host, by Google Benchmark.
#pragma once

#include <string>
#include <vector>

#include "bench/rows/row.hpp"
#include "bench/sweep/sweep.hpp"

namespace bench {

struct HostTiming {
    std::vector<Json> rows;
    Json context;  ///< as Google Benchmark writes it
};

/// What is timed: a kernel or peer at a length. `order` chooses a design's modes, and the coefficients; the time
/// depends on neither.
struct Timed {
    std::string name;
    Length length;
    double order;
    Discretisation weights = Discretisation::gl;
};

/// Times one sample at a time, with a sliding window in steady state and its upkeep inside, for every kernel, peer and
/// length of the sweep, once: at its first order that has the length. After each timing the next output, with modes
/// that behind a record from rest, is compared with the reference; a wrong one marks the row.
/// With `sweep.repetitions` above 1 each timing is taken so often, some 2 ms each, all in random turns.
/// \param flags  Google Benchmark's own, as given by the user
/// \throws glsum::Failure (bad input) for a flag that it does not know.
[[nodiscard]] HostTiming time_on_host(const Sweep& sweep, const std::vector<std::string>& flags);

/// The same for chosen cases, at least one. \param samples  of the record that designs with modes are for
[[nodiscard]] HostTiming time_on_host(const std::vector<Timed>& cases, std::size_t samples, unsigned repetitions,
                                      const std::vector<std::string>& flags);

}  // namespace bench
