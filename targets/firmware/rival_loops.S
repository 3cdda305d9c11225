@ Loops on which rival rule sets of the timing model (qemu/cores) disagree: run on a board, they say which set is right.
@ Each holds one question eight times a turn; r0: 32 bytes of memory, aligned to 8; r1: turns >= 1. Two turns' difference
@ is free of what a call costs. Encodings are wide and the loops aligned to 8, so that fetching is not the question.
    .syntax unified
    .thumb
    .text

    .macro function name
    .global \name
    .type \name, %function
    .p2align 3
    .thumb_func
\name:
    .endm

    .macro prologue
    push.w {r4, lr}
    vldr s0, [r0]
    vldr s1, [r0, #4]
    vldr s2, [r0, #8]
    vmov.f32 s4, s0
    vmov.f32 s5, s0
    vmov.f32 s6, s0
    vmov.f32 s8, s0
    vmov.f32 s9, s0
    .p2align 3
    .endm

    .macro again
    subs.w r1, r1, #1
    bne.w 1b
    pop.w {r4, pc}
    .endm

@ A VFMA accumulates on the one before it: every 3 cycles, or every 8?
function glsum_silicon_rival_fma_chain
    prologue
1:
    .rept 8
    vfma.f32 s0, s1, s2
    .endr
    again
    .size glsum_silicon_rival_fma_chain, . - glsum_silicon_rival_fma_chain

@ A VLDR behind a VFMA that has nothing to do with it: free, or barred for 3 or 4 cycles?
function glsum_silicon_rival_load_behind_fma
    prologue
1:
    .rept 4
    vfma.f32 s0, s1, s2
    vldr s8, [r0]
    vfma.f32 s4, s1, s2
    vldr s9, [r0, #4]
    .endr
    again
    .size glsum_silicon_rival_load_behind_fma, . - glsum_silicon_rival_load_behind_fma

@ The same VLDR, but into a register that the VFMA reads: later than the loop above?
function glsum_silicon_rival_overwrite_behind_fma
    prologue
1:
    .rept 4
    vfma.f32 s0, s1, s2
    vldr s1, [r0]
    vfma.f32 s4, s5, s6
    vldr s5, [r0, #4]
    .endr
    again
    .size glsum_silicon_rival_overwrite_behind_fma, . - glsum_silicon_rival_overwrite_behind_fma

@ A VFMA in the second cycle behind a VLDR that has nothing to do with it, the VLDR 8 cycles behind the last VFMA.
function glsum_silicon_rival_fma_behind_load
    prologue
1:
    .rept 8
    vldr s8, [r0]
    vfma.f32 s0, s1, s2
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    .endr
    again
    .size glsum_silicon_rival_fma_behind_load, . - glsum_silicon_rival_fma_behind_load

@ What a VLDR loads is accumulated on: after 3 cycles, or 2?
function glsum_silicon_rival_load_to_accumulator
    prologue
1:
    .rept 8
    vldr s0, [r0]
    vfma.f32 s0, s1, s2
    vstr s0, [r0, #16]
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    add.w r2, r2, r3
    .endr
    again
    .size glsum_silicon_rival_load_to_accumulator, . - glsum_silicon_rival_load_to_accumulator

@ Moves between FP registers in a row: one a cycle, or one every 4?
function glsum_silicon_rival_moves
    prologue
1:
    vmov.f32 s4, s0
    vmov.f32 s5, s1
    vmov.f32 s6, s2
    vmov.f32 s8, s0
    vmov.f32 s9, s1
    vmov.f32 s4, s2
    vmov.f32 s5, s0
    vmov.f32 s6, s1
    again
    .size glsum_silicon_rival_moves, . - glsum_silicon_rival_moves

@ A loop of three instructions: 2 cycles a turn, or fewer when the taken branch issues with its target?
function glsum_silicon_rival_folding
    prologue
1:
    add.w r2, r2, #1
    again
    .size glsum_silicon_rival_folding, . - glsum_silicon_rival_folding

@ An FP store and then loads, first of the same bank: does its late data keep the load waiting? In DTCM and cached.
function glsum_silicon_rival_store_then_load
    prologue
1:
    .rept 8
    vstr s4, [r0, #16]
    add.w r2, r2, r3
    vldr s8, [r0]
    add.w r2, r2, r3
    vldr s9, [r0, #4]
    add.w r2, r2, r3
    .endr
    again
    .size glsum_silicon_rival_store_then_load, . - glsum_silicon_rival_store_then_load
