/* Horner forms of floats in four chains, in the order that a Cortex-M7 or a Cortex-M4 loses least in. C99 and C++; generated
 * headers hold this very text.
 *
 *   void name(float chains[4], const float *c, const float *x, size_t groups)
 *     for i = groups - 1 ... 0:  chains[r] = x[4 i + r] + c[4 i + 4 + r] chains[r],  r = 0 ... 3
 *
 * Product and sum are rounded each: the bits are those of the loop in C.
 *
 * Basic assembly in a function without prologue: compilers take it to read and write any memory. */
#if defined(GLSUM_CORTEX_M4) /* no compiler says which of the two it compiles for */
/* A load lets only another load go beside it, so they come in fours, for a cycle more: a group is 18 cycles. Eight groups a
 * turn, the first of which is entered in its middle. */
#define GLSUM_HORNER_FLOATS(name)                                                                       \
    __attribute__((naked, noinline, aligned(8), unused)) static void name(                              \
        float *chains __attribute__((unused)), const float *c __attribute__((unused)),                  \
        const float *x __attribute__((unused)), size_t groups __attribute__((unused)))                  \
    {                                                                                                   \
        __asm__ volatile(                                                                               \
            "cmp.w r3, #0\n"                                                                            \
            "beq.w 3f\n"                                                                                \
            "add.w r1, r1, r3, lsl #4\n"                                                                \
            "add.w r2, r2, r3, lsl #4\n"                                                                \
            "vldmia r0, {s0-s3}\n"                                                                      \
            "rsb r12, r3, #0\n" /* groups that the first turn leaves out, 40 bytes of code each */      \
            "add.w r1, r1, #16\n"                                                                       \
            "and r12, r12, #7\n"                                                                        \
            "add.w r3, r3, #7\n"                                                                        \
            "add.w r12, r12, r12, lsl #2\n"                                                             \
            "lsr.w r3, r3, #3\n"                                                                        \
            "lsl.w r12, r12, #3\n"                                                                      \
            "add pc, r12\n" /* which reads as the address behind the next instruction */                \
            "nop\n"                                                                                     \
            "2:\n"                                                                                      \
            ".rept 8\n"                                                                                 \
            "vldmdb r1!, {s8-s11}\n"                                                                    \
            "vldmdb r2!, {s4-s7}\n"                                                                     \
            "vmul.f32 s0, s0, s8\n"                                                                     \
            "vmul.f32 s1, s1, s9\n"                                                                     \
            "vmul.f32 s2, s2, s10\n"                                                                    \
            "vmul.f32 s3, s3, s11\n"                                                                    \
            "vadd.f32 s0, s4, s0\n"                                                                     \
            "vadd.f32 s1, s5, s1\n"                                                                     \
            "vadd.f32 s2, s6, s2\n"                                                                     \
            "vadd.f32 s3, s7, s3\n"                                                                     \
            ".endr\n"                                                                                   \
            "subs.w r3, r3, #1\n"                                                                       \
            "bne.w 2b\n"                                                                                \
            "vstmia r0, {s0-s3}\n"                                                                      \
            "3:\n"                                                                                      \
            "bx lr\n");                                                                                 \
    }
#else
/* A group of four is eight cycles, sixteen issue slots with nothing lost: four products beside the loads of the samples
 * that are added to them, four sums beside the loads of the factors of the group before. No chain waits: a product and
 * a sum of it are there four cycles later. Sixteen groups a turn; the first turn is entered in its middle. Reads
 * c[0 ... 3] too, which the last group needs no more. */
#define GLSUM_HORNER_FLOATS(name)                                                                         \
    __attribute__((naked, noinline, aligned(8), unused)) static void name(                              \
        float *chains __attribute__((unused)), const float *c __attribute__((unused)),                  \
        const float *x __attribute__((unused)), size_t groups __attribute__((unused)))                  \
    {                                                                                                   \
        __asm__ volatile(                                                                               \
            "cmp r3, #0\n"                                                                              \
            "beq.w 3f\n"                                                                                \
            "push {r0, r4, r5, lr}\n"                                                                   \
            "rsb r4, r3, #0\n" /* groups that the first turn leaves out, 64 bytes of code each */       \
            "add.w r5, r1, r3, lsl #4\n"                                                                \
            "and r4, r4, #15\n"                                                                         \
            "vldmia r0, {s0-s3}\n"                                                                      \
            "add.w r3, r3, #15\n"                                                                       \
            "adr r12, 2f\n"                                                                             \
            "lsr.w r3, r3, #4\n"                                                                        \
            "vldmia r5, {s8-s11}\n"                                                                     \
            "sub.w r5, r3, #1\n"                                                                        \
            "add r12, r12, r4, lsl #6\n"                                                                \
            "add r1, r1, r5, lsl #8\n"                                                                  \
            "add.w r12, r12, #1\n"                                                                      \
            "add r2, r2, r5, lsl #8\n"                                                                  \
            "bx r12\n"                                                                                  \
            ".balign 8\n"                                                                               \
            "2:\n"                                                                                      \
            ".set .Lgroup, 240\n"                                                                       \
            ".rept 16\n"                                                                                \
            "vmul.f32 s0, s0, s8\n"                                                                     \
            "vldr s4, [r2, #.Lgroup]\n"                                                                 \
            "vmul.f32 s1, s1, s9\n"                                                                     \
            "vldr s5, [r2, #.Lgroup + 4]\n"                                                             \
            "vmul.f32 s2, s2, s10\n"                                                                    \
            "vldr s6, [r2, #.Lgroup + 8]\n"                                                             \
            "vmul.f32 s3, s3, s11\n"                                                                    \
            "vldr s7, [r2, #.Lgroup + 12]\n"                                                            \
            "vadd.f32 s0, s4, s0\n"                                                                     \
            "vldr s8, [r1, #.Lgroup]\n"                                                                 \
            "vadd.f32 s1, s5, s1\n"                                                                     \
            "vldr s9, [r1, #.Lgroup + 4]\n"                                                             \
            "vadd.f32 s2, s6, s2\n"                                                                     \
            "vldr s10, [r1, #.Lgroup + 8]\n"                                                            \
            "vadd.f32 s3, s7, s3\n"                                                                     \
            "vldr s11, [r1, #.Lgroup + 12]\n"                                                           \
            ".set .Lgroup, .Lgroup - 16\n"                                                              \
            ".endr\n"                                                                                   \
            "subs r3, r3, #1\n"                                                                         \
            "sub.w r1, r1, #256\n"                                                                      \
            "sub.w r2, r2, #256\n"                                                                      \
            "bne.w 2b\n"                                                                                \
            "pop {r0, r4, r5, lr}\n"                                                                    \
            "vstmia r0, {s0-s3}\n"                                                                      \
            "3:\n"                                                                                      \
            "bx lr\n");                                                                                 \
    }
#endif
