@ What the speed of the timing model is measured on: the work that it is for. Each function runs r0 times over small arrays.
    .syntax unified
    .cpu cortex-m7
    .fpu fpv5-sp-d16
    .thumb
    .section .vectors, "a"
    .word 0x20010000
    .word start + 1
    .text
    .thumb_func
start:
    ldr r0, =0xE000ED88     @ the FPU is off at reset
    ldr r1, [r0]
    orr r1, r1, #0xF00000
    str r1, [r0]
    dsb
    isb
    ldr r7, =calls
again:
    bl timed
    subs r7, r7, #1
    bne again
    ldr r1, =ended
    movs r0, #0x20          @ SYS_EXIT_EXTENDED
    bkpt 0xab
    .align 2
ended:
    .word 0x20026, 0
    .ltorg

    @ 64 taps each: a q15 dot product, a q31 FIR that shifts, an f32 dot product with four sums, a table lookup, a copy.
    .global timed
    .type timed, %function
    .thumb_func
timed:
    push {r4-r11, lr}
    ldr r0, =0x20001000
    ldr r1, =0x20002004
    movs r2, #32
    movs r3, #0
    movs r4, #0
1:  ldr r5, [r0], #4
    ldr r6, [r1], #4
    smlald r3, r4, r5, r6
    subs r2, r2, #1
    bne 1b
    ldr r0, =0x20001000
    movs r1, #64
    movs r4, #0
2:  ldr r2, [r0, #516]
    subs r1, r1, #1
    ldr r3, [r0]
    add r0, r0, #4
    str r2, [r0, #508]
    smmlar r4, r2, r3, r4
    bne 2b
    ldr r0, =0x20003000
    ldr r1, =0x20004004
    movs r2, #16
3:  vldmia r0!, {s0-s3}
    vldmia r1!, {s4-s7}
    subs r2, r2, #1
    vfma.f32 s8, s0, s4
    vfma.f32 s9, s1, s5
    vfma.f32 s10, s2, s6
    vfma.f32 s11, s3, s7
    bne 3b
    ldr r0, =0x20001000
    ldr r5, =0x20005000
    movs r2, #64
4:  ldrb r3, [r0], #1
    eor r3, r3, r4
    uxtb r3, r3
    ldr r3, [r5, r3, lsl #2]
    eor r4, r3, r4, lsr #8
    subs r2, r2, #1
    bne 4b
    ldr r0, =0x20001000
    ldr r1, =0x20006000
    movs r2, #8
5:  ldmia r0!, {r3-r10}
    stmia r1!, {r3-r10}
    subs r2, r2, #1
    bne 5b
    pop {r4-r11, pc}
    .size timed, . - timed
