// One run: measures a sweep, or one shard of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/rows/result_file.hpp"
#include "bench/run/pieces.hpp"
#include "bench/sweep/sweep.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

/// Measures the pieces of a sweep one after the other; host timings come last and alone.
/// \param shard  if any, only its pieces; the context's `shard` tells which, for `merge`
/// \param boards  of the emulated machines that the sweep wants
/// \param flags  Google Benchmark's own, as given by the user
[[nodiscard]] Results measure(const Sweep& sweep, const std::optional<Shard>& shard,
                              const std::vector<qemu::Board>& boards, const std::vector<std::string>& flags);

}  // namespace bench
