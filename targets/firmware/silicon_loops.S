@ The loops behind the measured rows of results/silicon/h747_per_sample_fir.csv, as the compilers of their time made them
@ (GCC 8 and 9): the store stands before the multiply-accumulate. Written here from that order.
@
@ One pass over coefficients and delay line for each new sample. Memory at r0: 128 coefficients, then 130 samples, the
@ oldest first; r1: taps >= 1; the new sample in s0 or r2. Result in s0 or r0.
    .syntax unified
    .thumb
    .text
    .equ line, 512

    .macro function name
    .global \name
    .type \name, %function
    .p2align 3
    .thumb_func
\name:
    .endm

function glsum_silicon_shift_firfma_f32
    vldr s14, zero
    add r3, r0, r1, lsl #2
    vstr s0, [r3, #line]
1:  vldr s15, [r0, #line + 4]
    subs r1, r1, #1
    vldr s13, [r0]
    add r0, r0, #4
    vstr s15, [r0, #line - 4]
    vfma.f32 s14, s15, s13
    bne 1b
    vmov.f32 s0, s14
    bx lr
    .p2align 2
zero:
    .word 0
    .size glsum_silicon_shift_firfma_f32, . - glsum_silicon_shift_firfma_f32

function glsum_silicon_shift_fir_q31
    push {r4, r5}
    add r3, r0, r1, lsl #2
    str r2, [r3, #line]
    movs r4, #0
1:  ldr r2, [r0, #line + 4]
    subs r1, r1, #1
    ldr r3, [r0]
    add r0, r0, #4
    str r2, [r0, #line - 4]
    smmlar r4, r2, r3, r4
    bne 1b
    ssat r4, #31, r4
    lsl r0, r4, #1
    pop {r4, r5}
    bx lr
    .size glsum_silicon_shift_fir_q31, . - glsum_silicon_shift_fir_q31
