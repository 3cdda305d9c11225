// Shards into one: the rows of the run that was never divided.
#pragma once

#include <string>
#include <vector>

#include "bench/rows/result_file.hpp"

namespace bench {

/// A result file and what messages call it.
struct NamedResults {
    std::string name;
    Results results;
};

/// Puts all shards of one sweep together, in whatever order they come. The context is that of the shard that timed the
/// host, or else of the first; its `shards` lists when and where each one ran.
/// \param allow_mixed_hosts  lets shards come from different CPUs, and marks the context with `mixed_hosts`. The rows
/// of
///        host timing are one shard's in any case; of the others the CPU decides at most a last bit, where the system's
///        mathematical functions choose their code by it.
/// \throws glsum::Failure naming the files and what differs or is missing:
///         bad input when a file is no shard, is damaged, or a shard is missing or there twice;
///         not comparable when the shards are of different sweeps or conditions.
[[nodiscard]] Results merge(std::vector<NamedResults> shards, bool allow_mixed_hosts);

}  // namespace bench
