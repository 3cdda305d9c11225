// The subcommand `score`.
#pragma once

#include <CLI/CLI.hpp>

namespace cli {

/// `score`: verdicts on blind cases against the truth that was sealed.
void add_score(CLI::App& app);

}  // namespace cli
