// What a program without a double unit computes double precision with: the routines of its compiler's library.
#pragma once

#include <vector>

#include "qemu/elf.hpp"
#include "qemu/timing/call_timer.hpp"

namespace qemu {

/// Where those routines lie, by the names of the Arm run-time ABI (IHI 0043, 4.1.2) and of libgcc, sorted.
[[nodiscard]] std::vector<timing::AddressRange> double_routines(const Elf& elf);

}  // namespace qemu
