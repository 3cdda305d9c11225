// Result files of any size that no run made: for the report's tests and for measuring it.
#pragma once

#include <cstddef>

#include "bench/rows/result_file.hpp"

namespace test {

/// A file shaped as `glsum bench` writes it, with at least `rows` rows of 40 kernels, 9 orders and 7 signals at as many
/// lengths as that takes; errors fall and costs rise with the length, every number from a seeded generator. The last
/// order's rows of core `pretend` have modelled cycles with a band and stall causes.
[[nodiscard]] bench::Results pretend_results(std::size_t rows, std::uint64_t seed);

}  // namespace test
