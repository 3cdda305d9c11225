// What a program without a double unit computes double precision with: the routines of its compiler's library.
#pragma once

#include <string>
#include <vector>

#include "qemu/emulate/elf.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

/// Whether it is one of them, by the names of the Arm run-time ABI (IHI 0043, 4.1.2) and of libgcc.
[[nodiscard]] bool is_double_routine(const std::string& symbol);
/// Where those routines lie, sorted.
[[nodiscard]] std::vector<timing::AddressRange> double_routines(const Elf& elf);
/// The request as that of a program: with its double routines.
[[nodiscard]] timing::TimingRequest for_program(timing::TimingRequest request, const Elf& elf);

}  // namespace qemu
