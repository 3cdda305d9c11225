// Two runs row by row.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench::report {

/// A counter of a row that is not the same in two runs.
struct Difference {
    std::string name;     ///< of the row
    std::string counter;  ///< empty for a row that only one run has, or that is wrong in one
    std::optional<double> a;
    std::optional<double> b;
    std::string note;  ///< only in A, only in B, wrong in A, wrong in B; else empty
    /// |ln(b / a)|; infinite where that is no number.
    [[nodiscard]] double size() const;
};

/// What differs, the largest ratio first; of repetitions the median counts. Bookkeeping of Google Benchmark
/// (iterations, indices) is left out, and times of rows that are no host timing.
[[nodiscard]] std::vector<Difference> differences(const std::vector<Json>& a, const std::vector<Json>& b);

/// One line a difference: name, counter, a, b, ratio, note.
[[nodiscard]] std::string to_csv(const std::vector<Difference>& differences);

}  // namespace bench::report
