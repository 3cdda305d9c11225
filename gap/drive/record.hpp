// A log, ready to be simulated: stamps that rise, and the even grid that a simulation of it steps on.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "drive/log.hpp"

namespace gap {

/// Nodes at first_s + k step_s, k = 0 .. count - 1; the interval k lies behind node k.
struct Grid {
    double first_s = 0.0;
    double step_s = 1.0;
    std::size_t count = 0;
    [[nodiscard]] double at(std::size_t k) const { return first_s + static_cast<double>(k) * step_s; }
};

struct Record {
    std::string name;
    std::vector<double> time_s;
    std::vector<double> input;   ///< held from its stamp to the next
    std::vector<double> output;  ///< as read
    double usual_interval_s = 0.0;
    std::vector<std::vector<double>> more_inputs = {};  ///< further logged inputs, held likewise
    std::vector<double> simulated = {};                 ///< what the user's own simulator gave; empty: there is none

    [[nodiscard]] std::size_t size() const { return time_s.size(); }
    /// From the first stamp to the last, `per_interval` nodes to the usual interval; below 1 a node spans several.
    [[nodiscard]] Grid grid(double per_interval) const;
};

/// \throws glsum::Failure (bad input): fewer than 32 samples, an output that never moves. An input of 0
/// throughout is a free motion.
[[nodiscard]] Record to_record(drive::Log log);

/// What lies before a time.
[[nodiscard]] Record up_to(const Record& record, double until_s);

/// Every so many-th sample, its input the mean of what was held until the next one.
[[nodiscard]] Record thinned(const Record& record, std::size_t every);

/// The mean over each interval of the grid of levels that are held from their stamp to the next.
[[nodiscard]] std::vector<double> held_on(const Grid& grid, std::span<const double> time_s,
                                          std::span<const double> levels);

/// Values at nodes, read at times by straight lines.
[[nodiscard]] std::vector<double> read_at(const Grid& grid, std::span<const double> nodes,
                                          std::span<const double> times_s);

}  // namespace gap
