// What rows of measured cycles are predicted by: a core file, changed.
#pragma once

#include <string>
#include <vector>

namespace qemu {

/// A core file, with its placement replaced by each row's.
struct CoreVariant {
    std::string core;      ///< a name, or a path (`timing::names_core_file`); empty: of rows that name one, their own
    std::string set = {};  ///< one of its rule sets alone; empty: all of them
    std::vector<std::string> without = {};  ///< effects that cost nothing
};

}  // namespace qemu
