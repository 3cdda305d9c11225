// Two runs side by side: any counter, no verdict.
#pragma once

#include <string>
#include <vector>

#include "bench/gate/conditions.hpp"
#include "bench/gate/rules.hpp"
#include "bench/rows/result_file.hpp"

namespace bench::gate {

/// One counter of one row in both runs.
struct Pair {
    std::string row;
    std::string counter;
    double a = 0.0;
    double b = 0.0;
    double log_ratio =
        0.0;           ///< of b to a; of repeated host times that of their ratios to the anchor; 0 where a or b is 0
    double low = 0.0;  ///< bounds of the same, of repeated host times; equal to it otherwise
    double high = 0.0;
    bool to_anchor = false;
    int better = 0;  ///< 1 where b is better, -1 where it is worse, 0 where it is the same or no rule says
};

struct Comparison {
    std::vector<Difference> differences;
    std::vector<Pair> pairs;  ///< of every counter that both have
    std::vector<std::string> only_a;
    std::vector<std::string> only_b;
    std::vector<std::string> wrong;  ///< rows that are wrong in either: not compared
};

/// \param rows, counters  globs of what to compare
/// \param rules  which direction of a counter is better, and what anchor host times have
[[nodiscard]] Comparison compare(const Results& a, const Results& b, const Rules& rules,
                                 const std::vector<std::string>& rows, const std::vector<std::string>& counters);

/// Per counter: how many changed, geometric mean and standard deviation of the ratios; then the largest changes.
[[nodiscard]] std::string to_table(const Comparison& comparison, std::size_t shown);

/// {"schema": "glsum-compare-1", ...}: every pair.
[[nodiscard]] std::string to_json(const Comparison& comparison);

}  // namespace bench::gate
