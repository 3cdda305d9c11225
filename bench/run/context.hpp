// The conditions of a run, for its record: what someone needs to take the same numbers again.
#pragma once

#include "bench/rows/row.hpp"
#include "bench/sweep/sweep.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

/// Adds our fields to a context that has Google Benchmark's, or makes those that apply without it.
/// \param boards  on which something ran: the fields of those behind the first begin with their machine's word
[[nodiscard]] Json make_context(Json google, const Sweep& sweep, const std::vector<qemu::Board>& boards);

}  // namespace bench
