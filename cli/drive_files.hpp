// What the commands of the drive share: models and logs by path, column options, results to a file or the terminal.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/output.hpp"
#include "drive/log.hpp"
#include "drive/model.hpp"
#include "gap/drive/improved.hpp"
#include "gap/drive/record.hpp"

namespace cli {

[[nodiscard]] drive::Model read_model(const std::filesystem::path& path);

/// A model that diagnose improved, at a log's stamps, from rest; without effects where it has none.
[[nodiscard]] gap::Improved simulate_effects(const drive::Model& model, const drive::Log& log, const std::string& name);

/// Says the log's warnings on standard error.
[[nodiscard]] drive::Log read_log(const std::filesystem::path& path, const drive::Columns& columns);

/// The same with stamps that rise; what was odd about them is said on standard error.
[[nodiscard]] drive::Log read_ordered_log(const std::filesystem::path& path, const drive::Columns& columns);

/// The same as records of a diagnosis, in the order of their paths.
[[nodiscard]] std::vector<gap::Record> read_records(const std::vector<std::filesystem::path>& paths,
                                                    const drive::Columns& columns);

/// Says on standard error that the model grows without bound, if it does. \param name  begins the message
void warn_if_unstable(const drive::Model& model, const std::string& name);

/// --time-column, --input-column, --output-column, --counts-per-unit, --counter-bits, --separator, --decimal,
/// --time-unit.
void add_column_options(Command& command, drive::Columns& columns);

/// The same for a diagnosis: --input-column is repeatable, and there is --simulated. \param columns  outlives the run
void add_diagnosis_column_options(Command& command, drive::Columns& columns);

/// Writes the file whole, or prints where no path was given.
void put(const std::string& text, const std::filesystem::path& path);

/// The text to `out`, or printed, and JSON where that is wanted; where it would be printed, it goes to `out` in the
/// text's place.
void put_either(const Output& json, const std::function<std::string()>& as_json,
                const std::function<std::string()>& as_text, const std::filesystem::path& out);

}  // namespace cli
