// The conditions of a run, for its record: what someone needs to take the same numbers again.
#pragma once

#include "bench/rows/row.hpp"
#include "bench/sweep/sweep.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

/// Adds our fields to a context that has Google Benchmark's, or makes those that apply without it.
/// \param board  null when nothing ran on the target
[[nodiscard]] Json make_context(Json google, const Sweep& sweep, const qemu::Board* board);

}  // namespace bench
