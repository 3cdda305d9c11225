// bench --horizons: what an error over a longer and longer past costs, with a window, with blocks and with modes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

struct HorizonBench {
    std::vector<std::string> horizons;  ///< numbers of samples, 100 to 10 000 000; in any order
    std::vector<double> orders;         ///< in (-1, 2], not whole; empty: 0.2, 0.5, 0.9, 1.5 and -0.5
    std::string core;                   ///< of the timing model; empty: none, multiplications alone
    std::filesystem::path out;
};

/// Measures and prints, writes rows `horizon/<kernel>/order:<v>/error:<e>/samples:<N>` and draws them beside.
/// \throws glsum::Failure: bad input, something missing, or a check that failed where a design errs more than it
/// promises
void run_horizon_bench(const HorizonBench& options);

}  // namespace cli
