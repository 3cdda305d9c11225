// Functions of anybody's firmware held against what they took before: modelled cycles, instructions and bytes are the
// same on every machine for the same ELF, so that any change is one of the program, and none is too small.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/function_time.hpp"
#include "qemu/emulate/gated_program.hpp"

namespace qemu {

/// \param time  nothing where the program never called it
[[nodiscard]] GatedFunction gated_function(const Function& function, const Elf& elf,
                                           const std::optional<FunctionTime>& time);

/// How one function changed.
struct FunctionChange {
    std::string name;
    bool worse = false;
    std::string text;  ///< what changed by how much, and what cycles were lost to: one line
};

/// Worse is more of anything, and a function that is gone or no longer called; less of everything that changed, and a
/// function that is new, are told and pass. \return the functions that changed, by name \throws glsum::Failure (not
/// comparable) when the core is another
[[nodiscard]] std::vector<FunctionChange> changes(const GatedProgram& before, const GatedProgram& now);

}  // namespace qemu
