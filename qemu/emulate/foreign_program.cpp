#include "qemu/emulate/foreign_program.hpp"

namespace qemu {
namespace {

// Of QEMU's mps2-an500: SSRAM1 with its mirror, SSRAM2 and 3 with theirs, PSRAM, which lies elsewhere on its others.
std::vector<Elf::Extent> memories_of(const base::Machine& machine) {
    const Elf::Extent psram =
        machine.board == "mps2-an500" ? Elf::Extent{0x60000000U, 0x61000000U} : Elf::Extent{0x21000000U, 0x22000000U};
    return {{0x00000000U, 0x00800000U}, {0x20000000U, 0x20800000U}, psram};
}

}  // namespace

const base::Machine& machine_of(const timing::TimingRequest::Core& core, const std::filesystem::path& cores_folder) {
    const timing::TimingRequest request{cores_folder.string(), {core}};
    return base::machine_of_core(timing::name_of(timing::cores_of(request).front().core));
}

void check_runs_on_board(const Elf& elf, const base::Machine& machine) {
    const std::string core(machine.name);
    elf.check_runs_on(core);
    elf.check_lies_within(memories_of(machine), "the emulated board");
    elf.check_starts(core);
}

}  // namespace qemu
