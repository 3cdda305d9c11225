// Baselines: the part of a run that later runs are held against, small and stable enough to be kept under version
// control.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/gate/verdict.hpp"
#include "bench/rows/result_file.hpp"

namespace bench::gate {

/// What `current` looks like as a baseline: the rows that a glob of `rows` matches, sorted by name, without the fields
/// that say nothing in a baseline; its context with `baseline_rows` and, behind the entries of `previous`, a new
/// `history` entry.
/// \param previous  context of the baseline that it takes the place of; empty without one
/// \throws glsum::Failure (check failed) when a selected row is wrong, (bad input) when none is selected
[[nodiscard]] Results make_baseline(const Results& current, const std::vector<std::string>& rows, const Json& previous,
                                    const std::string& reason, const std::string& changed);

/// One sentence about what a verdict says would change.
[[nodiscard]] std::string summary_of_changes(const Verdict& verdict);

/// Writes a baseline with one row a line, so that a difference reads well. Loads as any result file.
void write_baseline(const std::filesystem::path& path, const Results& baseline);

}  // namespace bench::gate
