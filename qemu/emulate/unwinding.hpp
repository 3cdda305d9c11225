// What in a program leaves calls without returning from them: exceptions of C++, and longjmp.
#pragma once

#include "qemu/emulate/elf.hpp"
#include "qemu/timing/call_stack.hpp"

namespace qemu {

/// By the names of libgcc's unwinder and of the C library. Empty where the program has neither.
[[nodiscard]] timing::Unwinding unwinding_of(const Elf& elf);

}  // namespace qemu
