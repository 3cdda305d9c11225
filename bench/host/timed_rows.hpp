// What is asked of Google Benchmark, and what its rows are called, where the iterations of a timing are fixed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bench/rows/row.hpp"

namespace bench {

/// Google Benchmark looks for a number of iterations by wall time: on a busy machine it may stop at one. For
/// repetitions we fix it: some 2 ms, in whole turns of a ring of that many taps, where a sample's time depends on the
/// place of the head.
/// \param ns  a sample, as estimated; taken for 0.1 where it is less
/// \return at least one turn, and at most a million
[[nodiscard]] std::int64_t iterations_for(double ns, std::size_t taps);

/// Google Benchmark says in the name that the iterations were fixed; the name is what later runs are joined by.
/// \param key  of a text in the row; of another nothing is done
void drop_iterations(Json& row, const char* key);

}  // namespace bench
