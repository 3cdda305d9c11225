/* Marks a stretch of a program for `glsum time --marks`. This file alone is needed: copy it, or write the two instructions.
 *
 * An Arm core executes a move of a register to itself without an effect, and no compiler or assembler writes these two of
 * itself. So the program runs as before, on the chip too, but for an instruction at either end. A stretch lasts from the
 * issue of the instruction behind the first to the issue of the second; neither counts.
 *
 * No access to memory moves across a mark. What a compiler keeps in registers alone may: let it come out of memory and go
 * back there within the stretch. */
#ifndef GLSUM_MARK_H
#define GLSUM_MARK_H

__attribute__((always_inline)) static inline void glsum_mark_begin(void) { __asm__ volatile("mov r10, r10" ::: "memory"); }
__attribute__((always_inline)) static inline void glsum_mark_end(void) { __asm__ volatile("mov r11, r11" ::: "memory"); }

#endif
