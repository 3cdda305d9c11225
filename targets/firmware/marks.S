@ Where the program is, for the timing model that watches it: a row of the plan begins, calls to time begin, they end.
    .syntax unified
    .thumb
    .text

    .macro mark name
    .global \name
    .type \name, %function
    .p2align 3
    .thumb_func
\name:
    bx lr
    .size \name, . - \name
    .endm

mark glsum_mark_row
mark glsum_mark_on
mark glsum_mark_off
