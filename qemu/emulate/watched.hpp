// What a firmware program offers to the instruments, read from its ELF.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "qemu/emulate/elf.hpp"
#include "qemu/timing/marked_timer.hpp"

namespace qemu {

/// Address of a symbol that the program must have. \throws glsum::Failure (bad input) when it has not.
[[nodiscard]] std::uint32_t address_of(const Elf& elf, const std::string& symbol);

struct WatchedKernel {
    std::uint32_t step;
    std::uint32_t answer;  ///< its first half; 0 where there are none
};

/// Entries of the registered kernels by name, as targets/firmware/watched.hpp lays them out.
[[nodiscard]] std::map<std::string, WatchedKernel> watched_kernels(const Elf& elf);

/// targets/firmware/marks.hpp
[[nodiscard]] Marks marks_of(const Elf& elf);

}  // namespace qemu
