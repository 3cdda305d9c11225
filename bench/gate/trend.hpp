// Every counter over several runs: where it changed, and how it stands to the first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/gnuplot.hpp"
#include "bench/gate/compare.hpp"
#include "bench/rows/merge.hpp"

namespace bench::gate {

/// A change point: one counter of one kernel between a run and the one before it.
struct Change {
    std::size_t run;  ///< index of the later one, from 1
    std::string kernel;
    std::string counter;
    std::size_t rows = 0;           ///< that changed: another value; of repeated host times an interval without 1
    std::size_t of = 0;             ///< rows that both runs have
    double log_ratio = 0.0;         ///< mean over the rows that changed, of the later to the earlier value
    double lowest = 0.0;            ///< of a row
    double highest = 0.0;           ///< of a row
    std::size_t without_ratio = 0;  ///< of them those that were 0 or became it
    std::size_t better = 0;
    std::size_t worse = 0;
};

struct TrendRun {
    std::string name;
    std::string commit;
    std::string date;
    std::size_t rows = 0;
    std::size_t changed = 0;  ///< counters of rows, against the run before; likewise the next two
    std::size_t better = 0;
    std::size_t worse = 0;
};

/// One counter of one kernel that changed somewhere.
struct Series {
    std::string kernel;
    std::string counter;
    std::vector<double>
        level;  ///< of each run, to the first: steps of the geometric mean over rows that two runs share
    std::vector<bool> changed;  ///< whether that run is a change point
};

struct Trend {
    std::vector<TrendRun> runs;
    std::vector<Change> changes;            ///< by run, then the largest first
    std::vector<Series> series;             ///< the one that moved furthest first
    std::vector<std::string> incomparable;  ///< pairs of runs, and why; empty: all can be compared
};

/// \param runs  two or more, the oldest first \param rows, counters  globs
[[nodiscard]] Trend trend(const std::vector<NamedResults>& runs, const Rules& rules,
                          const std::vector<std::string>& rows, const std::vector<std::string>& counters);

/// The runs, then the changes. \param shown  how many of them
[[nodiscard]] std::string to_table(const Trend& trend, std::size_t shown);

/// {"schema": "glsum-trend-1", ...}: all of it.
[[nodiscard]] std::string to_json(const Trend& trend);

/// The eight series that moved furthest over the runs, their change points marked; nothing where none moved.
[[nodiscard]] std::optional<base::Picture> picture(const Trend& trend);

}  // namespace bench::gate
