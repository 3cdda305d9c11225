// A command's options as a table for other programs: shells that complete them, a manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cli {

/// A line for each name of an option, and for each subcommand, with tabs between: the command, the name, what follows
/// it (nothing, "number", "text", or "words" with the words that may), those words, what it is for. \param command
/// "diagnose"
[[nodiscard]] std::string option_rows(const CLI::App& app, const std::string& command);

}  // namespace cli
