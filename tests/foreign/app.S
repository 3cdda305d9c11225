// Three functions that call no other, each with a place for what a gate shall find (CURRENT, SPEED), and one that none calls.
    .syntax unified
    .cpu cortex-m7
    .thumb
    .section .vectors, "a"
    .word 0x20010000, start + 1, 0, 0
    .text
    .macro function name
    .balign 16
    .thumb_func
    .global \name
    .type \name, %function
\name:
    .endm
    .macro ends name
    bx lr
    .size \name, . - \name
    .balign 64
    .endm
    function start
    ldr r4, =0x20000100
    movs r5, #50
1:  bl ctrl_current
    bl ctrl_speed
    bl ctrl_position
    subs r5, r5, #1
    bne 1b
    movs r0, #0x20
    ldr r1, =leave
    bkpt 0xab
    .balign 4
leave: .word 0x20026, 0
    .ltorg
    .size start, . - start
    function ctrl_current
    push {r4-r7}
    ldr r0, [r4]
    ldr r1, [r4, #8]
    adds r2, r0, r1
#ifdef CURRENT
    CURRENT
#endif
    pop {r4-r7}
    ends ctrl_current
    function ctrl_speed
    ldr r0, [r4]
    movs r1, #1
    adds r2, r0, r1
#ifdef SPEED
    SPEED
#endif
    str r2, [r4, #4]
    ends ctrl_speed
    function ctrl_position
    movs r1, #10
2:  subs r1, r1, #1
    bne 2b
    ends ctrl_position
    function ctrl_unused
    nop
    ends ctrl_unused
