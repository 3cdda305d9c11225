// Rows as CSV (RFC 4180).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

/// A text as one field of a line: in quotes where it holds a comma, a quote or a line's end.
[[nodiscard]] std::string csv_field(const std::string& text);

/// One line a row; the columns are the parts of the name and every counter that occurs.
[[nodiscard]] std::string to_csv(const std::vector<Json>& rows);
void write_csv(const std::filesystem::path& path, const std::vector<Json>& rows);

/// One line a number, for data frames: kernel, order, taps, target (accuracy, host, m7:<core>), signal, amplitude,
/// repetition, counter, value, unit. Of sums' rows that are not wrong; what says which measurement it is, is no counter.
[[nodiscard]] std::string to_tidy_csv(const std::vector<Json>& rows);
void write_tidy_csv(const std::filesystem::path& path, const std::vector<Json>& rows);

}  // namespace bench
