#include "qemu/emulate/foreign_program.hpp"

namespace qemu {
namespace {

// Of QEMU's mps2-an500: SSRAM1 with its mirror, SSRAM2 and 3 with theirs, PSRAM.
const std::vector<Elf::Extent> memories{
    {0x00000000U, 0x00800000U}, {0x20000000U, 0x20800000U}, {0x60000000U, 0x61000000U}};

}  // namespace

void check_runs_on_board(const Elf& elf) {
    elf.check_runs_on_cortex_m7();
    elf.check_lies_within(memories, "the emulated board");
    elf.check_starts();
}

}  // namespace qemu
