// Peers as lines to be timed.
#pragma once

#include <memory>
#include <vector>

#include "bench/host/peers/peer.hpp"
#include "bench/host/timed_line.hpp"
#include "reference/real.hpp"

namespace bench {

/// \param weights  of its window, newest first
[[nodiscard]] std::unique_ptr<TimedLine> timed_peer(const Peer& peer, const std::vector<reference::Real>& weights);

}  // namespace bench
