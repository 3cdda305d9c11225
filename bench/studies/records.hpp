// Sums over whole records with full memory, at once and sample by sample, beside one plain convolution.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/studies/study.hpp"

namespace bench {

struct Records {
    std::vector<std::size_t> samples;                            ///< of each record, 1000 to 10000000; rising
    std::vector<double> orders{0.5, -0.5};                       ///< in (-2, 2]
    std::vector<std::string> signals{"step", "sine5", "noise"};  ///< that errors are the worst of
    unsigned repetitions = 9;                                    ///< interleaved turns, whose median is taken
    double planning_s = 5.0;                                     ///< each way, of the peer that plans by timing
};

/// Rows `record/<how>/order:<v>/samples:<N>/host`, with processor time, ratios to the peer and `error_max`, relative to
/// the largest sum.
[[nodiscard]] Study measure_records(const Records& wanted);

}  // namespace bench
