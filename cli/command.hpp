// One program a command: main parses and reports, this is what each program's own file gives to it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/command_name.hpp"

namespace cli {

/// What the user typed, for commands that want it as it was.
struct Words {
    std::string line;                    ///< the whole command but --jobs, for the record
    std::vector<std::string> passed_on;  ///< Google Benchmark's own flags, unread
};

/// Adds options, examples and what runs them. Each program defines it once. \param words  outlives the run
void add_options(CLI::App& command, const Words& words);

}  // namespace cli
