// bench --records: sums over whole records with full memory, at once and sample by sample, beside one plain
// convolution.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

struct RecordBench {
    std::vector<std::string> records;  ///< numbers of samples, 1000 to 10 000 000; in any order
    std::vector<double> orders;        ///< in (-2, 2]; empty: 0.5 and -0.5
    std::vector<std::string> signals;  ///< that errors are the worst of; empty: step, sine5, noise
    unsigned repetitions = 9;
    std::filesystem::path out;
};

/// Measures and prints, and writes rows `record/<how>/order:<v>/samples:<N>/host`.
/// \throws glsum::Failure: bad input, or a check that failed where an answer is wrong
void run_record_bench(const RecordBench& options);

}  // namespace cli
