// The rules of the core, each on a few instructions whose cycles were derived by hand. The numbers are those of the
// rules in qemu/timing/README.md.
#include "probe.hpp"

#include <gtest/gtest.h>

#include <set>

namespace {

using probe::How;
using probe::lines_of;

struct Probe {
    const char* rule;
    const char* text;  // lines parted by ";"
    double cycles;
    const char* core = "stm32f746-itcm";
    How how = How::copies;
    bool data_in_axi = false;  // in place of the core's
};

// Where a copy is followed by the next one, the answer counts both: "eor, eor" dependent in a chain is 2, since nothing
// is left to pair.
constexpr Probe probes[] = {
    // 1: two instructions a cycle
    {"1.1", "add.w r0,r1,r2; add.w r3,r4,r5", 1},
    {"1.2", "eor.w r0,r1,r2; eor.w r3,r4,r5", 1},
    {"1.3", "nop.w", 0.5},
    {"1.4", "dsb; nop.w", 2},
    // 2: early and late ALU
    {"2.1", "add.w r0,r1,r2; add.w r3,r0,r4", 1},  // early, then late, in one cycle
    {"2.2", "add.w r1,r0,r3; add.w r1,r1,r2", 1},
    {"2.3", "eor.w r0,r0,r1", 1},  // late to late: the next cycle
    {"2.4", "eor.w r0,r0,r1; eor.w r0,r0,r2", 2},
    {"2.5", "movw r0,#1; movt r0,#2", 1},
    {"2.6", "lsl.w r0,r1,#2; eor.w r2,r0,r3", 1},  // a shift is early
    {"2.7", "eor.w r1,r0,r1,lsl #2", 2},           // the shifted operand is read early
    {"2.8", "eor.w r0,r0,r1,lsl #2", 1},
    {"2.9", "add.w r0,r0,r1; nop.w; eor.w r2,r3,r0,lsl #2; nop.w", 2},
    {"2.10", "eor.w r0,r0,r1; nop.w; eor.w r2,r3,r0,lsl #2; nop.w", 3},
    {"2.11", "eor.w r0,r1,r2; nop.w; ldr.w r3,[r0]; nop.w", 3},  // a late result as address: one cycle between
    {"2.12", "nop.w; add.w r4,r4,r2; ldr.w r3,[r4]; nop.w", 2},  // rule Y
    {"2.13", "nop.w; add.w r4,r4,r2; eor.w r3,r5,r4,lsl #1; nop.w", 3},
    // What is made of a late result is late itself, be it a sum or a shift; of an early one it is not.
    {"2.14", "eor.w r0,r1,r2; nop.w; add.w r3,r0,r4; nop.w; eor.w r5,r6,r3,lsl #2; nop.w", 4},
    {"2.15", "eor.w r0,r1,r2; nop.w; add.w r3,r7,r4; nop.w; eor.w r5,r6,r3,lsl #2; nop.w", 3},
    {"2.16", "eor.w r0,r1,r2; nop.w; lsl.w r3,r0,#1; nop.w; eor.w r5,r6,r3,lsl #2; nop.w", 4},
    // 3: flags
    {"3.1", "adcs.w r0,r1,r2; adcs.w r3,r4,r5", 2},
    {"3.2", "adc.w r0,r1,r2; adc.w r3,r4,r5", 1},
    {"3.3", "cmp.w r0,r1; it eq; addeq.w r2,r3,r4", 1.5},  // IT takes a slot; its member waits for the flags
    {"3.4", "it eq; moveq r0,r1", 1},
    // 4: one shifter
    {"4.1", "add.w r0,r1,r2,lsl #2; add.w r3,r4,r5,lsl #2", 2},
    {"4.2", "add.w r0,r1,r2,lsl #2; add.w r3,r4,r5", 1},
    {"4.3", "add.w r0,r1,#0xff00; eor.w r3,r4,#0xff00", 2},
    {"4.4", "add.w r0,r1,#0xff; eor.w r3,r4,#0x00ff00ff", 1},
    {"4.5", "lsl.w r0,r1,#2; lsl.w r3,r4,#2", 1},
    // 5: bit fields and SIMD: the older slot
    {"5.1", "uxtb.w r0,r1; uxtb.w r2,r3", 2},
    {"5.2", "uxtb.w r0,r1; eor.w r2,r3,r4", 1},
    {"5.3", "eor.w r2,r3,r4; uxtb.w r0,r1; eor.w r5,r6,r7", 2},
    {"5.4", "uxtb.w r0,r1; add.w r2,r3,r4,lsl #2", 1},
    {"5.5", "sadd16 r0,r0,r1", 1},
    {"5.6", "ubfx r0,r0,#1,#4", 2},  // reads its source early
    {"5.7", "uxtb.w r0,r1; nop.w; ldr.w r2,[r0]; nop.w", 3},
    {"5.8", "rev.w r0,r1; eor.w r2,r0,r3", 1},               // reversed before the ALU
    {"5.9", "rev.w r0,r1; nop.w; ldr.w r2,[r0]; nop.w", 3},  // and yet no address in the next cycle
    {"5.10", "ubfx r0,r1,#1,#4; eor.w r2,r0,r3", 2},
    // A rotated byte by itself is read as late as any; one that is added to, early, whether it is rotated or not.
    {"5.13", "eor.w r0,r1,r2; nop.w; uxtb.w r3,r0,ror #8; nop.w", 2},
    {"5.14", "eor.w r0,r1,r2; nop.w; uxtab r3,r4,r0,ror #8; nop.w", 3},
    {"5.15", "eor.w r0,r1,r2; nop.w; uxtab r3,r4,r0; nop.w", 3},
    {"5.16", "eor.w r0,r1,r2; nop.w; uxtab r3,r0,r4; nop.w", 2},
    {"5.17", "eor.w r0,r1,r2; nop.w; pkhbt r3,r4,r0; nop.w", 3},
    {"5.18", "eor.w r0,r1,r2; nop.w; pkhtb r3,r0,r4,asr #1; nop.w", 3},
    {"5.19", "ubfx r0,r1,#1,#4; add.w r2,r3,r4,lsl #2", 2},  // one shifter
    {"5.20", "rev.w r0,r1; nop.w; eor.w r2,r3,r0,lsl #2; nop.w", 3},
    {"5.11", "qadd r0,r0,r1", 2},
    {"5.12", "ssat r0,#16,r0", 3},  // reads early, too
    // 6: products
    {"6.1", "smlal r0,r1,r2,r3", 1},
    {"6.2", "smlad r0,r1,r2,r0", 1},
    {"6.3", "smlald r0,r1,r2,r3", 1},
    {"6.4", "smmlar r0,r1,r2,r0", 1},
    {"6.5", "mul r0,r1,r2; mul r3,r4,r5", 2},
    {"6.6", "mul r0,r0,r1", 2},
    {"6.7", "mul r0,r1,r2; nop.w; eor.w r3,r0,r4; nop.w", 3},
    {"6.8", "smlabb r0,r1,r2,r0; uxtb.w r3,r4", 1},  // uxtb in the older slot, the next smlabb beside it
    {"6.9", "smlabb r0,r1,r2,r0; add.w r3,r4,r5,lsl #2", 1},
    {"6.10", "smlad r0,r1,r2,r0; str.w r4,[r5]", 2},
    {"6.11", "smlad r0,r1,r2,r0; ldr.w r4,[r5]", 1},
    {"6.12", "ldr.w r0,[r1]; nop.w; mul r2,r0,r3; nop.w", 3},
    {"6.13", "ldr.w r0,[r1]; nop.w; mla r2,r3,r4,r0; nop.w", 2},
    {"6.14", "ldrb.w r0,[r1]; nop.w; mla r2,r3,r4,r0; nop.w", 2},
    {"6.21", "ldrb.w r0,[r1]; nop.w; mul r2,r0,r3; nop.w", 3},  // a byte no later than to the ALU
    {"6.15", "eor.w r0,r1,r2; mla r3,r4,r5,r0", 1},             // a late result of the same cycle
    {"6.16", "mul r0,r1,r2; nop.w; ldr.w r3,[r0]; nop.w", 5},
    {"6.17", "sdiv r0,r1,r2", 7},
    {"6.18", "sdiv r0,r1,r2; nop.w", 8},
    {"6.19", "sdiv r0,r1,r2; ldr.w r3,[r0]", 9},  // as of any late result: one cycle between it and an address
    {"6.20", "sdiv r0,r1,r2; ldr.w r3,[r4]", 8},
    // 7: loads
    {"7.1", "ldr.w r0,[r1]; nop.w; eor.w r2,r0,r3; nop.w", 2},
    {"7.2", "ldrb.w r0,[r1]; nop.w; eor.w r2,r0,r3; nop.w", 3},
    {"7.3", "ldr.w r0,[r1]; nop.w; eor.w r2,r3,r0,lsl #2; nop.w", 3},
    {"7.4", "ldr.w r0,[r0]", 2},
    {"7.5", "ldrb.w r0,[r0]", 3},
    {"7.12", "ldr.w r0,[r1]; nop.w; ldr.w r2,[r3,r0]; nop.w", 4},  // 3 to the register that is added
    {"7.13", "ldrb.w r0,[r1]; nop.w; ldr.w r2,[r3,r0]; nop.w", 4},
    // The early bypass of a word leads to no instruction that reads another operand early.
    {"7.14", "ldr.w r0,[r1]; nop.w; eor.w r2,r0,r3,lsl #2; nop.w", 3},
    {"7.15", "ldrb.w r0,[r1]; nop.w; eor.w r2,r0,r3,lsl #2; nop.w", 3},
    {"7.16", "ldr.w r0,[r1]; nop.w; uxtab r2,r0,r3; nop.w", 3},
    {"7.6", "ldr.w r0,[r1]; ldr.w r2,[r3,#4]", 1},
    {"7.7", "ldr.w r0,[r1]; ldr.w r2,[r3,#8]", 2},
    {"7.8", "ldr r0,[r1],#8; ldr.w r2,[r1]", 2},  // the base is used anew
    {"7.9", "ldr.w r0,[r1,#1]", 4},
    {"7.10", "nop.w; ldr.w r0,[r1,#1]", 5},
    {"7.11", "ldrb.w r0,[r1,#1]", 1},
    // 8: several registers
    {"8.1", "ldrd r0,r1,[r2]", 1},
    {"8.2", "ldrd r0,r1,[r2]; nop.w", 2},
    {"8.3", "ldm r0,{r1,r2,r3}", 2},
    {"8.4", "ldm r0,{r1,r2,r3,r4,r5,r6}", 3},
    {"8.5", "stm r0,{r1,r2,r3,r4}", 2},
    {"8.6", "stm r0!,{r1,r2,r3}; stm r0!,{r1,r2,r3,r4}; add.w r5,r5,r6; str r7,[r0],#4",
     6},  // 2; 3, as its place is odd; 1
    {"8.7", "vldm r0,{s0-s7}", 4},
    {"8.8", "ldm r0,{r1,r2,r3,r4}; eor.w r5,r4,r6", 3},  // the last register is there when it has issued
    {"8.9", "stm r0!,{r1,r2,r3}", 2},                    // an odd number, wherever its place is
    // 9: stores
    {"9.1", "str.w r0,[r1]; str.w r2,[r3,#4]", 2},
    {"9.2", "ldr.w r0,[r1]; str.w r2,[r3]", 1},
    {"9.3", "ldr.w r0,[r1]; str.w r0,[r3]", 1},  // stores what was loaded in the same cycle
    {"9.4", "strb.w r0,[r1]", 4},
    {"9.5", "strb.w r0,[r1]; strb.w r0,[r1,#4]", 4},
    {"9.6", "strh.w r0,[r1],#2", 2},
    {"9.7", "strb.w r0,[r1],#1", 2},  // runs of four on either bank, four cycles each
    // His twenty copies go over five words and begin anew: 12 of 20 on one bank, 48 cycles; 10 of 20 of halves.
    {"9.10", "1: .rept 19; strb.w r0,[r1],#1; .endr; strb.w r0,[r1],#-19; bne 1b", 48, "stm32f746-itcm", How::turns},
    {"9.11", "1: .rept 19; strh.w r0,[r1],#2; .endr; strh.w r0,[r1],#-38; bne 1b", 40, "stm32f746-itcm", How::turns},
    {"9.8", "str.w r0,[r1,#1]", 4},
    {"9.9", "str.w r0,[r1]; ldr.w r2,[r1]", 4},
    // In the fourth cycle behind the store of its word, however many others came between, and of another word at once.
    {"9.12", "str.w r0,[r1],#4; ldr.w r2,[r1,#-4]", 4},
    {"9.13", "str.w r0,[r1],#4; str.w r0,[r1],#4; ldr.w r2,[r1,#-8]", 4},
    {"9.14", "str.w r0,[r1],#4; str.w r0,[r1],#4; str.w r0,[r1],#4; ldr.w r2,[r1,#-12]", 4},
    {"9.15", "str.w r0,[r1],#8; ldr.w r2,[r1,#-4]", 1},
    // 10: single precision
    {"10.1", "vadd.f32 s0,s1,s2; vmul.f32 s3,s4,s5", 2},
    {"10.2", "vadd.f32 s0,s1,s2; add.w r0,r1,r2", 1},
    {"10.3", "vadd.f32 s0,s0,s1", 3},
    {"10.4", "vmul.f32 s0,s0,s1", 3},
    {"10.5", "vadd.f32 s0,s1,s2; vmul.f32 s3,s0,s0; vadd.f32 s1,s3,s3", 9},
    {"10.6", "vfma.f32 s0,s1,s2", 3},
    {"10.7", "vmla.f32 s0,s1,s2", 3},
    {"10.8", "vfma.f32 s1,s0,s2; vfma.f32 s0,s1,s2", 10},
    {"10.9", "vmla.f32 s1,s0,s2; vmla.f32 s0,s1,s2", 12},
    {"10.10", "vfma.f32 s0,s10,s11; vfma.f32 s1,s10,s11; vfma.f32 s2,s10,s11", 3},
    {"10.11", "vmla.f32 s0,s10,s11; vfma.f32 s1,s10,s11; nop.w; nop.w; nop.w; nop.w", 4},
    {"10.12", "vmul.f32 s0,s1,s2; vfma.f32 s0,s3,s4", 4},  // 3 to the accumulator; VMUL is not barred
    {"10.13", "vdiv.f32 s0,s1,s2", 16},
    {"10.14", "vdiv.f32 s0,s1,s2; add.w r0,r1,r2", 16},
    // Every other division is the younger of its pair, and none goes with it.
    {"10.14a", "vdiv.f32 s0,s1,s2; add.w r0,r1,r2; add.w r3,r4,r5", 16.5},
    {"10.15", "vsqrt.f32 s0,s1", 14},
    {"10.16", "vldr s0,[r0]; vldr s1,[r1,#4]", 1},
    {"10.17", "vldr s0,[r0]; vldr s1,[r1,#8]", 2},
    {"10.18", "vadd.f32 s0,s1,s2; nop.w; vstr s0,[r0]; nop.w", 2},
    {"10.19", "vfma.f32 s0,s1,s2; nop.w; vstr s0,[r0]; nop.w", 5},  // 3, and no VFMA in the cycle behind the store
    {"10.20", "vmla.f32 s0,s1,s2; nop.w; vstr s0,[r0]; nop.w", 6},  // 4
    {"10.21", "vmov s0,r0; vmov s1,r1", 2},
    {"10.22", "vmov r0,s0; nop.w; eor.w r1,r0,r2; nop.w", 2},
    {"10.23", "vmov s0,r0; nop.w; vadd.f32 s1,s0,s2; nop.w", 4},
    {"10.24", "vmov.f32 s0,s1", 4},
    {"10.25", "vfma.f32 s0,s1,s2; vadd.f32 s3,s4,s5", 5},  // barred for 3 cycles
    {"10.26", "vfma.f32 s0,s1,s2; vldr s3,[r0]", 5},       // barred for 3
    {"10.27", "vadd.f32 s0,s1,s2; vfma.f32 s0,s3,s4", 7},  // 3, then barred for 3
    {"10.28", "vadd.f32 s0,s1,s2; vmla.f32 s0,s3,s4", 6},
    {"10.29", "vmul.f32 s0,s1,s2; vmla.f32 s0,s3,s4", 3},
    {"10.30", "vmul.f32 s0,s1,s2; nop.w; vstr s0,[r0]; nop.w", 2},
    {"10.31", "vfma.f32 s0,s1,s2; vmla.f32 s0,s3,s4", 6},  // 2 and 4
    {"10.32", "vldr s0,[r0]; nop.w; vadd.f32 s1,s0,s2; nop.w", 2},
    {"10.33", "vldr s0,[r0]; nop.w; vfma.f32 s0,s1,s2; nop.w", 7},  // 3 to the accumulator, then barred for 3
    {"10.34", "vldr s0,[r0]; nop.w; vmla.f32 s0,s1,s2; nop.w", 6},
    {"10.35", "vldr s0,[r0]; vstr s0,[r1,#4]", 1},  // a store beside the next load
    {"10.36", "vcvt.f32.s32 s0,s0", 3},
    {"10.37", "vmov.f32 s0,s1; nop.w; vadd.f32 s2,s0,s3; nop.w", 4},
    {"10.38", "vmov.f32 s0,#1.0; nop.w; vadd.f32 s2,s0,s3; nop.w", 4},
    {"10.39", "vcmp.f32 s0,s1; nop.w; vmrs apsr_nzcv,fpscr; nop.w", 3},  // VMRS alone
    {"10.40", "vfma.f32 s0,s1,s2; nop.w; nop.w; vmov s3,r0; vfma.f32 s4,s5,s6; nop.w; nop.w; vmov s7,r0", 6},
    {"10.41", "vfma.f32 s0,s1,s2; vldr s1,[r0]", 5},
    {"10.42", "vmov s0,s1,r0,r1; nop.w", 2},                                 // both ports: alone
    {"10.43", "vfma.f32 s0,s1,s2; vstr s5,[r0]; .rept 7; nop.w; .endr", 5},  // not beside a MAC, though it be the first
    {"10.44", "vldm r0,{s0-s3}; vfma.f32 s3,s10,s11", 8},  // s3 comes a cycle later, 3 to the accumulator; 4
    {"10.45", "vstr s5,[r0]; vfma.f32 s0,s1,s2", 3},       // not beside, not in the next cycle; then VSTR
    // 11: double precision, other exponents
    {"11.1", "vadd.f64 d0,d1,d2", 2},
    {"11.2", "vmul.f64 d0,d1,d2", 5},
    {"11.3", "vfma.f64 d0,d1,d2", 7},
    {"11.4", "vmla.f64 d0,d1,d2", 7},
    {"11.5", "vdiv.f64 d0,d1,d2", 30},
    {"11.6", "vfma.f64 d0,d1,d2; vadd.f64 d3,d4,d5", 10},
    {"11.7", "vmla.f64 d0,d1,d2; vadd.f64 d3,d4,d5", 11},
    {"11.8", "vsqrt.f64 d0,d1", 30},
    {"11.9", "vadd.f64 d0,d0,d1", 4},
    {"11.10", "vmul.f64 d0,d0,d1", 7},
    {"11.11", "vfma.f64 d0,d1,d2; vmul.f64 d1,d0,d3", 18},  // 11 and 7
    // 12: branches
    {"12.1", "1: add.w r0,r1,r2; eor.w r3,r4,r5; subs.w r6,r6,#1; bne 1b", 2, "stm32f746-itcm", How::turns},
    {"12.2", "1: subs.w r6,r6,#1; bne 1b", 1, "stm32f746-itcm", How::turns},
    {"12.3", "beq 2f; add.w r0,r1,r2; 2:", 1},  // not taken: pairs
    {"12.4", "1: add.w r0,r1,r2; subs.w r6,r6,#1; bne 1b", 2, "stm32f746-itcm", How::turns},
    {"12.5", "9: subs.w r6,r6,#1; bne 9b", 8},  // not taken, against the static guess
    {"12.6", "9: subs.w r6,r6,#1; nop.w; nop.w; nop.w; nop.w; nop.w; bne 9b", 9},  // the flags are known by then
    {"12.7", "b 9f; nop.w; 9:", 3},                                                // met for the first time
    {"12.8", "beq 9f; beq 9f; nop.w; 9:", 2},
    // A foreseen branch issues with the first instruction at its target, where the fetch is ahead of it.
    {"12.11", "1: add r0,r0,r1; subs r6,r6,#1; bne 1b", 1.5, "stm32f746-itcm", How::turns},
    {"12.12", "1: add r0,r0,r1; b 2f; .p2align 3; 2: subs r6,r6,#1; bne 1b", 2, "stm32f746-itcm", How::turns},
    {"12.10", "1: bl 8f; bl 8f; b 9f; 8: bx lr; 9: subs r6,r6,#1; bne 1b", 6, "stm32f746-itcm", How::turns},
    {"12.9", "beq 9f; add.w r0,r1,r2; add.w r3,r4,r5; 9:", 1.5},  // no slot is lost behind a branch that is not taken
    // 13: fetching
    {"13.1", ".p2align 3; nop; nop; nop; 1: nop; nop.w; nop.w; bne 1b", 3, "stm32f746-itcm", How::turns},
    {"13.2", "nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w", 16, "stm32f746-flash"},
    {"13.3", "nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w", 28, "stm32f746-flash-nocache"},
    {"13.4", "1: b 2f; .p2align 11; 2: b 3f; .p2align 11; 3: bne 1b", 39, "stm32f746-flash",
     How::turns},                                                                                  // 3 lines, 2 ways
    {"13.5", "nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w", 8, "stm32f746-flash-art"},  // read ahead
    // 14: data memories
    {"14.1", "1: ldr r0,[r1],#32; bne 1b", 15, "stm32h747-axi", How::turns},  // 14 more each, behind which the branch
    {"14.2", "1: ldr r0,[r1],#4; bne 1b", 2.75, "stm32h747-axi",
     How::turns},  // one in eight; the next load is beside it
    {"14.3", "1: ldr.w r0,[r1]; ldr.w r0,[r2]; ldr.w r0,[r3]; ldr.w r0,[r4]; bne 1b", 4, "stm32h747-axi", How::turns},
    {"14.4",
     "1: ldr.w r0,[r1]; ldr.w r0,[r1,#1024]; ldr.w r0,[r1,#2048]; ldr.w r0,[r1,#3072]; ldr.w r0,[r9,#2048]; bne 1b", 35,
     "stm32f746-itcm", How::turns, true},  // five lines of one set of four: 7 each
    {"14.5", "1: ldr.w r0,[r1]; ldr.w r0,[r1,#1024]; ldr.w r0,[r1,#2048]; ldr.w r0,[r1,#3072]; bne 1b", 4,
     "stm32f746-itcm", How::turns, true},
    // 15: an FP store's data is late in DTCM: the next load of its bank waits one cycle
    {"15.1", "vstr s0,[r0]; nop.w; ldr.w r2,[r1]; nop.w", 3},
    {"15.2", "vstr s0,[r0]; nop.w; ldr.w r2,[r1,#4]; nop.w", 2},
};

probe::Setting setting_of(const Probe& probe) {
    probe::Setting setting = probe::core(probe.core);
    setting.placement.data = probe.data_in_axi ? timing::DataPlace::axi : setting.placement.data;
    return setting;
}

double cycles_of(const Probe& probe, const probe::Setting& setting) {
    return probe::steady(probe.text, probe.how, setting);
}

TEST(Probe, TakesTheCyclesDerivedByHand) {
    static_assert(std::size(probes) >= 60);
    for (const Probe& probe : probes) {
        EXPECT_EQ(cycles_of(probe, setting_of(probe)), probe.cycles) << probe.rule << ": " << probe.text;
    }
}

TEST(Probe, OnTheIdealCoreEverythingTakesHalfACycle) {
    for (const Probe& probe : probes) {
        const probe::Outcome outcome = probe::run(lines_of(probe.text), probe::core("m7-ideal"));
        EXPECT_EQ(outcome.positions.back(), static_cast<std::int64_t>(outcome.positions.size()) - 1) << probe.text;
        EXPECT_EQ(outcome.unknown, 0U) << probe.text;
    }
}

TEST(Probe, LossesSumExactlyToWhatIsAboveHalfACycleAnInstruction) {
    for (const Probe& probe : probes) {
        for (const char* core : {"stm32f746-itcm", "stm32f746-flash", "stm32f746-flash-nocache", "stm32h747-axi"}) {
            probe::expect_losses_to_sum(probe.text, core);
        }
    }
}

TEST(Probe, AnEffectThatIsOffLosesNothing) {
    for (const Probe& probe : probes) {
        probe::expect_effects_to_switch_off(probe.text, probe.core);
    }
}

struct Row {
    const char* name;
    std::int64_t timing::Figures::*figure;
};
constexpr Row figures[] = {
#define ROW(section, name) {#section "." #name, &timing::Figures::section##_##name},
#include "qemu/timing/m7_rows.def"
#include "qemu/timing/rows.def"
#undef ROW
};

// Without an answer of their own: what only they reach.
constexpr Probe movers[] = {
    {"fetch.queue", "vdiv.f32 s0,s1,s2; .rept 15; nop.w; .endr", 0, "stm32f746-flash"},
    {"branch.target_entries", "1: .rept 300; b 5f; nop; 5:; .endr; bne.w 1b", 0, "stm32f746-itcm", How::turns},
};

// Not of the core: used by `glsum silicon`, whose rows hold them, and by the band, which has tests of its own.
const std::set<std::string> of_measurements{"measurement.counter_reads", "measurement.maintenance",
                                            "band.published_permille", "band.predicted_permille",
                                            "band.fitted_permille"};
// What the model divides by.
const std::set<std::string> powers_of_two{"fetch.bytes", "cache.line_bytes", "memory.flash_line_bytes",
                                          "memory.sram_beat_bytes"};

TEST(Probe, EveryRowOfACoreFileMovesOne) {
    std::vector<const Probe*> all;
    for (const Probe& probe : probes) {
        all.push_back(&probe);
    }
    for (const Probe& probe : movers) {
        all.push_back(&probe);
    }
    std::vector<double> before;
    for (const Probe* probe : all) {
        before.push_back(cycles_of(*probe, setting_of(*probe)));
    }
    for (const Row& row : figures) {
        bool moved = false;
        for (std::size_t i = 0; i < all.size() && !moved; ++i) {
            probe::Setting setting = setting_of(*all[i]);
            const std::int64_t value = setting.figures.*row.figure;
            for (const std::int64_t other :
                 {value + 1, value * 2, value / 2, std::int64_t{value == 0 ? 1 : 0}, value + 8}) {
                const bool allowed = !powers_of_two.contains(row.name) || (other > 0 && (other & (other - 1)) == 0);
                if (other != value && allowed && !moved) {
                    setting.figures.*row.figure = other;
                    moved = cycles_of(*all[i], setting) != before[i];
                }
            }
        }
        EXPECT_NE(moved, of_measurements.contains(row.name)) << row.name;
    }
}

// How many registers of a transfer move in a cycle is a figure. Where it is 0 the transfer issues in one, and they move
// one by one.
TEST(Probe, RegistersMoveAsManyACycleAsTheFigureSays) {
    const auto cycles_between = [](const char* text, std::int64_t a_cycle) {
        probe::Setting setting = probe::core("stm32f746-itcm");
        setting.figures.issue_registers_per_cycle = a_cycle;
        const auto positions = probe::run(lines_of(text), setting).positions;
        return positions.at(1) / 2 - positions.at(0) / 2;
    };
    constexpr const char* load_of_the_last = "stm r0,{r1,r2,r3,r4}; ldr.w r5,[r0,#12]";
    EXPECT_EQ(cycles_between(load_of_the_last, 0), 3 + 4);  // in the fourth cycle behind its store
    EXPECT_EQ(cycles_between(load_of_the_last, 1), 3 + 4);
    EXPECT_EQ(cycles_between(load_of_the_last, 2), 1 + 4);
    constexpr const char* use_of_the_last = "ldm r0,{r1,r2,r3,r4}; eor.w r5,r4,r6";
    EXPECT_EQ(cycles_between(use_of_the_last, 0), 3 + 1);
    EXPECT_EQ(cycles_between(use_of_the_last, 1), 4);
    EXPECT_EQ(cycles_between(use_of_the_last, 2), 2);
}

// What each wait is called, in half cycles: of instructions that go half a cycle apart where nothing holds them.
TEST(Probe, LossesHaveTheNameOfTheirCause) {
    struct Case {
        const char* text;
        const char* losses;
        const char* core = "stm32f746-itcm";
    };
    constexpr const char* nops = "nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w";
    constexpr Case cases[] = {
        {nops, ""},
        {nops, "icache_misses 24", "stm32f746-flash"},                          // 12 cycles, one line
        {nops, "flash_wait_states 48", "stm32f746-flash-nocache"},              // 12, then 4 for each of three words
        {nops, "flash_wait_states 16", "stm32f746-flash-art"},                  // 8 without the bus
        {"sdiv r0,r1,r2; nop.w", "result_latency 13"},                          // 7 cycles
        {"eor.w r0,r0,r1; eor.w r0,r0,r2", "result_latency 1"},                 // the next cycle
        {"ldr.w r0,[r0]; ldr.w r0,[r0]", "load_use 3"},                         // 2
        {"mul r0,r0,r1; mul r0,r0,r1", "mac_latency 3"},                        // 2
        {"vadd.f32 s0,s0,s1; vadd.f32 s0,s0,s1", "fpu_latency 5"},              // 3
        {"vfma.f32 s0,s1,s2; vldr s3,[r0]", "fpu_latency 7"},                   // barred for 3: the fourth behind it
        {"vfma.f32 s0,s1,s2; vstr s3,[r0]", "single_issue 1"},                  // barred from nothing but its cycle
        {"uxtb.w r0,r1; uxtb.w r2,r3", "single_issue 1"},                       // one bit field a cycle
        {"ldm r0,{r1,r2,r3,r4}; nop.w", "single_issue 3"},                      // two cycles
        {"ldr.w r0,[r1]; ldr.w r2,[r3,#8]", "load_bank_conflict 1"},            // the next cycle
        {"vstr s0,[r0]; nop.w; ldr.w r2,[r1]; nop.w", "load_bank_conflict 2"},  // one cycle
        {"str.w r0,[r1]; ldr.w r2,[r1]", "store_buffer 7"},                     // 4
        {"ldr.w r0,[r1,#1]; nop.w", "unaligned_access 7"},                      // 3 more in the older slot
        {"b 9f; nop.w; 9: nop.w", "branch_mispredict 5"},                       // met for the first time: 2 more
        {"ldr.w r0,[r1]; ldr.w r2,[r1,#64]; nop.w", "icache_misses 36 dcache_misses 58", "stm32h747-axi"},
        {"ldr.w r0,[pc,#64]; nop.w; eor.w r2,r0,r3", "icache_misses 24 dcache_misses 25", "stm32f746-flash"},
    };
    for (const Case& test : cases) {
        const probe::Outcome outcome = probe::run(lines_of(test.text), probe::core(test.core));
        std::string losses;
        for (std::size_t effect = 0; effect < timing::effect_count; ++effect) {
            if (outcome.losses[effect] != 0) {
                losses += (losses.empty() ? "" : " ") + std::string(timing::effect_names[effect]) + ' ' +
                          std::to_string(outcome.losses[effect]);
            }
        }
        EXPECT_EQ(losses, test.losses) << test.text << " on " << test.core;
    }
}

}  // namespace
