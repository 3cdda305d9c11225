// Rows that a logger stamped as it received them: they come in bursts, each with one stamp, though they were measured
// one after the other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace drive {

/// Consecutive samples of one stamp.
struct Burst {
    std::size_t first = 0;
    std::size_t size = 0;
    double time_s = 0.0;
};

/// \param time_s  that do not fall
[[nodiscard]] std::vector<Burst> bursts_of(std::span<const double> time_s);

/// Stamps for the samples of each burst, evenly from its own to that of the next; a burst before a gap, and the last
/// one, as dense as is usual. Where bursts hold more and fewer samples in turn, though they arrive evenly, it was the
/// transport that packed them so: the stamp of each burst is read off a straight line of stamps against samples
/// through its neighbours, which leaves equal intervals.
/// \param bursts  at least two
/// \return stamps that rise, or nothing where doubles do not hold them apart
[[nodiscard]] std::vector<double> spread(std::span<const Burst> bursts);

}  // namespace drive
