// bench --equal-cost: what a number of multiplications a sample buys, kernel by kernel and beside Oustaloup's filter.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

struct EqualCostBench {
    std::vector<std::string> costs;    ///< multiplications a sample, 4 to 600; in any order
    std::vector<double> orders;        ///< in (-2, 2]; empty: 0.2, 0.5, 0.9, 1.5 and -0.5
    std::vector<std::string> signals;  ///< empty: all
    bool quick = false;                ///< records of 1000 samples instead of 5000
    unsigned jobs = 1;
    std::filesystem::path out;
};

/// Measures, prints, writes the rows and draws them beside.
/// \throws glsum::Failure (bad input, or missing without gnuplot)
void run_equal_cost_bench(const EqualCostBench& options);

}  // namespace cli
