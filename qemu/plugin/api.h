// The part of QEMU's plugin interface that the plugin uses, declared here because Debian ships no header for it. Names
// and types as in QEMU's include/qemu/qemu-plugin.h; the emulator checks `qemu_plugin_version` when it loads a plugin.
// The interface has changed: version 1 (QEMU 7.2) adds inline to any address; from version 2 (QEMU 9.0) on only to
// scoreboards, a slot for each core; from version 3 (9.1) on an instruction's bytes are copied. What only some have is
// weak, so that one build loads into all of them: a null address where the emulator lacks it.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef uint32_t qemu_plugin_meminfo_t;

typedef struct {
    const char* target_name;
    struct {
        int min;
        int cur;
    } version;
    bool system_emulation;
    struct {
        int smp_vcpus;
        int max_vcpus;
    } system;
} qemu_info_t;

enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
enum qemu_plugin_mem_rw { QEMU_PLUGIN_MEM_R = 1, QEMU_PLUGIN_MEM_W, QEMU_PLUGIN_MEM_RW };
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };

typedef void (*qemu_plugin_vcpu_tb_trans_cb_t)(qemu_plugin_id_t, struct qemu_plugin_tb*);
typedef void (*qemu_plugin_vcpu_udata_cb_t)(unsigned int vcpu, void* userdata);
typedef void (*qemu_plugin_vcpu_mem_cb_t)(unsigned int vcpu, qemu_plugin_meminfo_t, uint64_t address, void* userdata);
typedef void (*qemu_plugin_udata_cb_t)(qemu_plugin_id_t, void* userdata);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, qemu_plugin_vcpu_tb_trans_cb_t);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb*, qemu_plugin_vcpu_udata_cb_t,
                                          enum qemu_plugin_cb_flags, void* userdata);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn*, qemu_plugin_vcpu_udata_cb_t,
                                            enum qemu_plugin_cb_flags, void* userdata);
void qemu_plugin_register_vcpu_mem_cb(struct qemu_plugin_insn*, qemu_plugin_vcpu_mem_cb_t, enum qemu_plugin_cb_flags,
                                      enum qemu_plugin_mem_rw, void* userdata);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, qemu_plugin_udata_cb_t, void* userdata);

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t index);
// Versions 1 and 2: `const void* (const struct qemu_plugin_insn*)`; from 3 on as here.
size_t qemu_plugin_insn_data(const struct qemu_plugin_insn*, void* copy, size_t bytes);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn*);
unsigned int qemu_plugin_mem_size_shift(qemu_plugin_meminfo_t);
bool qemu_plugin_mem_is_store(qemu_plugin_meminfo_t);

// Version 1.
__attribute__((weak)) void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn*, enum qemu_plugin_op,
                                                                      void* counter, uint64_t added);
__attribute__((weak)) void qemu_plugin_register_vcpu_mem_inline(struct qemu_plugin_insn*, enum qemu_plugin_mem_rw,
                                                                enum qemu_plugin_op, void* counter, uint64_t added);
// From version 2 on.
struct qemu_plugin_scoreboard;
typedef struct {
    struct qemu_plugin_scoreboard* score;
    size_t offset;
} qemu_plugin_u64;
__attribute__((weak)) struct qemu_plugin_scoreboard* qemu_plugin_scoreboard_new(size_t slot_bytes);
__attribute__((weak)) uint64_t qemu_plugin_u64_get(qemu_plugin_u64, unsigned int vcpu);
__attribute__((weak)) void qemu_plugin_register_vcpu_insn_exec_inline_per_vcpu(struct qemu_plugin_insn*,
                                                                               enum qemu_plugin_op, qemu_plugin_u64,
                                                                               uint64_t added);
__attribute__((weak)) void qemu_plugin_register_vcpu_mem_inline_per_vcpu(struct qemu_plugin_insn*,
                                                                         enum qemu_plugin_mem_rw, enum qemu_plugin_op,
                                                                         qemu_plugin_u64, uint64_t added);
// From version 4 (9.2) on; not used, it tells the version.
__attribute__((weak)) void qemu_plugin_read_memory_vaddr(void);

// What QEMU looks up in the plugin.
extern __attribute__((visibility("default"))) int qemu_plugin_version;
__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t, const qemu_info_t*, int argc,
                                                               char** argv);

#ifdef __cplusplus
}
#endif
