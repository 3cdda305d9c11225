// What `bench` and `merge` end with.
#pragma once

#include <filesystem>
#include <string>

#include "bench/rows/result_file.hpp"
#include "cli/command.hpp"

namespace cli {

/// Adds `--table`: which of a run's tables `finish_run` prints.
void add_table_option(Command& command, std::string& table);

/// Writes the result file and, beside it, .csv, .svg and .png; prints the table. \param table  "front": the cheapest
/// kernels of each order; "all": every kernel at every length; empty: all where that fits a screen
/// \throws glsum::Failure (check failed) when rows are wrong, after all is written.
void finish_run(const std::filesystem::path& out, const bench::Results& results, unsigned jobs,
                const std::string& table);

/// \throws glsum::Failure (check failed) when rows are wrong.
void check_rows(const bench::Results& results);

}  // namespace cli
