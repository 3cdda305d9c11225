// glsum diagnose cycles: where predicted and measured cycles part, and which effects explain it.
#pragma once

#include "cli/command.hpp"

namespace cli {

void add_diagnose_cycles(Command& diagnose);

}  // namespace cli
