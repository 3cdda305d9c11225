// glsum diagnose cycles: where predicted and measured cycles part, and which effects explain it.
#pragma once

#include <CLI/CLI.hpp>

namespace cli {

void add_diagnose_cycles(CLI::App& diagnose);

}  // namespace cli
