// What the commands of the drive share: models and logs by path, column options, results to a file or the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "drive/log.hpp"
#include "drive/model.hpp"

namespace cli {

[[nodiscard]] drive::Model read_model(const std::filesystem::path& path);

/// Says the log's warnings on standard error.
[[nodiscard]] drive::Log read_log(const std::filesystem::path& path, const drive::Columns& columns);

/// The same with stamps that rise; what was odd about them is said on standard error.
[[nodiscard]] drive::Log read_ordered_log(const std::filesystem::path& path, const drive::Columns& columns);

/// --time-column, --input-column, --output-column, --counts-per-unit, --counter-bits.
void add_column_options(CLI::App& command, drive::Columns& columns);

/// Writes the file whole, or prints where no path was given.
void put(const std::string& text, const std::filesystem::path& path);

}  // namespace cli
