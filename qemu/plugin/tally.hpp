// A number that the emulator adds to by itself, without a call into the plugin, whichever way this emulator has.
#pragma once

#include <cstdint>

#include "qemu/plugin/api.h"

namespace qemu {

class Tally {
public:
    Tally() {
        if (qemu_plugin_scoreboard_new != nullptr) {
            slot_ = {qemu_plugin_scoreboard_new(sizeof(std::uint64_t)), 0};
        }
    }
    // The emulator holds its address.
    Tally(const Tally&) = delete;
    Tally& operator=(const Tally&) = delete;

    /// Counts each execution of an instruction.
    void count_executions(qemu_plugin_insn* instruction) {
        if (slot_.score != nullptr) {
            qemu_plugin_register_vcpu_insn_exec_inline_per_vcpu(instruction, QEMU_PLUGIN_INLINE_ADD_U64, slot_, 1);
        } else {
            qemu_plugin_register_vcpu_insn_exec_inline(instruction, QEMU_PLUGIN_INLINE_ADD_U64, &count_, 1);
        }
    }
    /// Counts each of its accesses. Reads and writes alike: QEMU 7.2 mixes them up.
    void count_accesses(qemu_plugin_insn* instruction) {
        if (slot_.score != nullptr) {
            qemu_plugin_register_vcpu_mem_inline_per_vcpu(instruction, QEMU_PLUGIN_MEM_RW, QEMU_PLUGIN_INLINE_ADD_U64,
                                                          slot_, 1);
        } else {
            qemu_plugin_register_vcpu_mem_inline(instruction, QEMU_PLUGIN_MEM_RW, QEMU_PLUGIN_INLINE_ADD_U64, &count_,
                                                 1);
        }
    }
    [[nodiscard]] std::uint64_t value() const {
        return slot_.score != nullptr ? qemu_plugin_u64_get(slot_, 0) : count_;  // the boards have one core
    }

private:
    std::uint64_t count_ = 0;
    qemu_plugin_u64 slot_{};
};

}  // namespace qemu
