// A sweep in pieces, and which of them a shard measures.
#pragma once

#include <cstddef>
#include <vector>

#include "base/machines.hpp"
#include "bench/rows/shard.hpp"
#include "bench/sweep/sweep.hpp"

namespace bench {

/// What is measured in one go because it shares its costly part:
///   accuracy  one order and signal, all kernels and lengths: they are held against one exact sum
///   target    one kernel and length on one machine, or one kernel with modes: all orders, which share their counts
///   host      all timings: rows of one run are compared by ratio, so none is taken elsewhere or at another time
/// The rows of a run are those of its pieces, one piece after the other.
struct Piece {
    enum class Kind { accuracy, target, host };
    Kind kind;
    std::size_t number;  ///< among those of its kind: order * signals + signal; as in `TargetPlan::Row::piece`; 0
    double cost;         ///< seconds on one core, roughly: only shards of about equal cost depend on it
    const base::Machine* machine = nullptr;  ///< of `target`
};

/// All pieces of the sweep's targets: accuracy first, then target, then host.
[[nodiscard]] std::vector<Piece> make_pieces(const Sweep& sweep);

/// Indices of the pieces that a shard measures, rising; may be none. Shards cost about the same, every piece is one
/// shard's, and the host's timings are the last shard's, so that it can be run alone on its machine.
[[nodiscard]] std::vector<std::size_t> pieces_of(const std::vector<Piece>& pieces, const Shard& shard);

}  // namespace bench
