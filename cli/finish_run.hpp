// What `bench` and `merge` end with.
#pragma once

#include <filesystem>

#include "bench/rows/result_file.hpp"

namespace cli {

/// Writes the result file and, beside it, .csv, .svg and .png; prints the table.
/// \throws glsum::Failure (check failed) when rows are wrong, after all is written.
void finish_run(const std::filesystem::path& out, const bench::Results& results, unsigned jobs);

/// \throws glsum::Failure (check failed) when rows are wrong.
void check_rows(const bench::Results& results);

}  // namespace cli
