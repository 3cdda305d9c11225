@ Loops whose counts are known by reading: the counting instrument is checked on them before every measurement.
@ r0: turns >= 1; r1: address of one word (of four for `multiple` and `wide`). n turns give, with the return:
@
@              instructions   loads   stores   branches
@   steps         4n + 1        n        n       n + 1
@   one_more      4n + 2        n        n       n + 1
@   multiple      4n + 3       4n + 2   4n + 2   n + 1     LDM and STM of four, PUSH and POP of two
@   wide          8n + 1       7n       7n       n + 1     LDRD, VLDM of four, VLDR of a double, and their stores
@   edge          4n + 3        n        n       n + 1     its second instruction in the loop lies on two pages of 1 KB
@   skipped       5n + 1        0        0       n + 1     a load in an IT block whose condition is false
@   nested        6n + 3       n + 2    n + 2   3n + 1     calls `leaf` (2 instructions), saves two registers
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

function glsum_check_steps
1:  ldr r2, [r1]
    str r2, [r1]
    subs r0, #1
    bne 1b
    bx lr
    .size glsum_check_steps, . - glsum_check_steps

function glsum_check_one_more
    nop
1:  ldr r2, [r1]
    str r2, [r1]
    subs r0, #1
    bne 1b
    bx lr
    .size glsum_check_one_more, . - glsum_check_one_more

function glsum_check_multiple
    push {r4, r5}
1:  ldm r1, {r2, r3, r4, r5}
    stm r1, {r2, r3, r4, r5}
    subs r0, #1
    bne 1b
    pop {r4, r5}
    bx lr
    .size glsum_check_multiple, . - glsum_check_multiple

function glsum_check_wide
1:  ldrd r2, r3, [r1]
    strd r2, r3, [r1]
    vldm r1, {s0-s3}
    vstm r1, {s0-s3}
    vldr d0, [r1]
    vstr d0, [r1]
    subs r0, #1
    bne 1b
    bx lr
    .size glsum_check_wide, . - glsum_check_wide

@ QEMU looks one halfword ahead where an instruction may lie on two pages, and tells a plugin too long a str.
    .p2align 10
    .space 1016
function glsum_check_edge
    mov r2, r1
    nop
1:  str r3, [r2]
    ldr.w r3, [r2]
    subs r0, #1
    bne 1b
    bx lr
    .size glsum_check_edge, . - glsum_check_edge

function glsum_check_skipped
1:  cmp r0, #0
    it eq
    ldreq r2, [r1]
    subs r0, #1
    bne 1b
    bx lr
    .size glsum_check_skipped, . - glsum_check_skipped

function glsum_check_leaf
    str r2, [r1]
    bx lr
    .size glsum_check_leaf, . - glsum_check_leaf

function glsum_check_nested
    push {r4, lr}
    mov r4, r0
1:  ldr r2, [r1]
    bl glsum_check_leaf
    subs r4, #1
    bne 1b
    pop {r4, pc}
    .size glsum_check_nested, . - glsum_check_nested
