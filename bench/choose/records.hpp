// What a choice is measured on: the records of one order and step, with their exact sums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/choose/conditions.hpp"
#include "reference/sums.hpp"

namespace choose {

struct Record {
    std::string signal;
    std::vector<double> samples;
    reference::Sums exact;           ///< full memory
    double peak;                     ///< max_k |exact_k|, above 0
    std::vector<double> truncation;  ///< [L - 1]: max_k |sum of L taps - full memory| / peak, to 1e-12, of every L
};

/// \throws glsum::Failure (bad input) for a signal whose exact sums are all zero.
[[nodiscard]] std::vector<Record> make_records(const Conditions& conditions, unsigned jobs);

}  // namespace choose
