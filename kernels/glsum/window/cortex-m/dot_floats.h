/* Sums of products of floats in four accumulators in turn, in the order that a Cortex-M7 or a Cortex-M4 loses least in. C99
 * and C++; generated headers hold this very text.
 *
 *   void name(float sums[4], const float *a, const float *x, size_t taps)     sums[i % 4] += a[i] x[i], i rising
 *
 * Product and sum are rounded each: the bits are those of the loop in C. Reads nothing beyond the taps.
 *
 * Basic assembly in a function without prologue: compilers take it to read and write any memory. */
#if defined(GLSUM_CORTEX_M4) /* no compiler says which of the two it compiles for */
/* A load lets only another load go beside it, so they come in fours, for a cycle more: four taps are 18 cycles, and no
 * product is summed right behind itself. 32 taps a turn, the first of which is entered in its middle. */
#define GLSUM_DOT_FLOATS(name)                                                                          \
    __attribute__((naked, noinline, aligned(8), unused)) static void name(                              \
        float *sums __attribute__((unused)), const float *a __attribute__((unused)),                    \
        const float *x __attribute__((unused)), size_t taps __attribute__((unused)))                    \
    {                                                                                                   \
        __asm__ volatile(                                                                               \
            "push {r0, r4}\n"                                                                           \
            "vldmia r0, {s0-s3}\n"                                                                      \
            "lsrs r4, r3, #2\n" /* groups of four */                                                    \
            "beq.w 2f\n"                                                                                \
            "rsb r12, r4, #0\n" /* those that the first turn leaves out, 40 bytes of code each */       \
            "adds r4, r4, #7\n"                                                                         \
            "and r12, r12, #7\n"                                                                        \
            "lsrs r4, r4, #3\n"                                                                         \
            "adr r0, 1f\n"                                                                              \
            "add r12, r12, r12, lsl #2\n"                                                               \
            "add r0, r0, r12, lsl #3\n"                                                                 \
            "adds r0, r0, #1\n"                                                                         \
            "bx r0\n"                                                                                   \
            ".balign 4\n"                                                                               \
            "1:\n"                                                                                      \
            ".rept 8\n"                                                                                 \
            "vldmia r1!, {s4-s7}\n"                                                                     \
            "vldmia r2!, {s8-s11}\n"                                                                    \
            "vmul.f32 s4, s4, s8\n"                                                                     \
            "vmul.f32 s5, s5, s9\n"                                                                     \
            "vmul.f32 s6, s6, s10\n"                                                                    \
            "vmul.f32 s7, s7, s11\n"                                                                    \
            "vadd.f32 s0, s0, s4\n"                                                                     \
            "vadd.f32 s1, s1, s5\n"                                                                     \
            "vadd.f32 s2, s2, s6\n"                                                                     \
            "vadd.f32 s3, s3, s7\n"                                                                     \
            ".endr\n"                                                                                   \
            "subs r4, r4, #1\n"                                                                         \
            "bne.w 1b\n"                                                                                \
            "2:\n"                                                                                      \
            "ands r3, r3, #3\n"                                                                         \
            "beq 3f\n"                                                                                  \
            "vldr s4, [r1]\n"                                                                           \
            "vldr s8, [r2]\n"                                                                           \
            "vmul.f32 s4, s4, s8\n"                                                                     \
            "subs r3, r3, #1\n"                                                                         \
            "vadd.f32 s0, s0, s4\n"                                                                     \
            "beq 3f\n"                                                                                  \
            "vldr s4, [r1, #4]\n"                                                                       \
            "vldr s8, [r2, #4]\n"                                                                       \
            "vmul.f32 s4, s4, s8\n"                                                                     \
            "subs r3, r3, #1\n"                                                                         \
            "vadd.f32 s1, s1, s4\n"                                                                     \
            "beq 3f\n"                                                                                  \
            "vldr s4, [r1, #8]\n"                                                                       \
            "vldr s8, [r2, #8]\n"                                                                       \
            "vmul.f32 s4, s4, s8\n"                                                                     \
            "vadd.f32 s2, s2, s4\n"                                                                     \
            "3:\n"                                                                                      \
            "pop {r0, r4}\n"                                                                            \
            "vstmia r0, {s0-s3}\n"                                                                      \
            "bx lr\n");                                                                                 \
    }
#else
/* A tap is two cycles, four issue slots with nothing lost: its product beside the load of the sample two taps on, the
 * sum of the product two taps back beside the load of the coefficient two taps on. Neither waits: a product is there
 * after three cycles, and an accumulator is met every eighth. 128 taps a turn. The first turn is entered in its middle,
 * at one of its sixteen groups of eight, with products of zero to be added; at most seven taps are left for the end. */
#define GLSUM_DOT_FLOATS(name)                                                                          \
    __attribute__((naked, noinline, aligned(8), unused)) static void name(                              \
        float *sums __attribute__((unused)), const float *a __attribute__((unused)),                    \
        const float *x __attribute__((unused)), size_t taps __attribute__((unused)))                    \
    {                                                                                                   \
        __asm__ volatile(                                                                               \
            ".macro GLSUM_TAP product, coefficient, sum, before, next, its, at\n"                       \
            "vmul.f32 s\\product, s\\product, s\\coefficient\n"                                         \
            "vldr s\\next, [r2, #\\at]\n"                                                               \
            "vadd.f32 s\\sum, s\\sum, s\\before\n"                                                      \
            "vldr s\\its, [r1, #\\at]\n"                                                                \
            ".endm\n"                                                                                   \
            ".macro GLSUM_FOUR_TAPS at\n"                                                               \
            "GLSUM_TAP 6, 14, 0, 4, 8, 12, \\at + 16\n"                                                 \
            "GLSUM_TAP 7, 15, 1, 5, 9, 13, \\at + 20\n"                                                 \
            "GLSUM_TAP 8, 12, 2, 6, 10, 14, \\at + 24\n"                                                \
            "GLSUM_TAP 9, 13, 3, 7, 11, 15, \\at + 28\n"                                                \
            ".endm\n"                                                                                   \
            "push {r0, r4, r5, lr}\n"                                                                   \
            "vldmia r0, {s0-s3}\n"                                                                      \
            "mov.w r4, #0\n"                                                                            \
            "vmov s10, s11, r4, r4\n"                                                                   \
            "lsrs r5, r3, #3\n" /* groups of eight */                                                   \
            "beq.w 4f\n"                                                                                \
            "rsb r4, r5, #0\n" /* those that the first turn leaves out, 128 bytes of code each */       \
            "vldr s4, [r2]\n"                                                                           \
            "ands r4, r4, #15\n"                                                                        \
            "vldr s12, [r1]\n"                                                                          \
            "add.w r5, r5, #15\n"                                                                       \
            "vldr s5, [r2, #4]\n"                                                                       \
            "adr r12, 3f\n"                                                                             \
            "vldr s13, [r1, #4]\n"                                                                      \
            "sub r1, r1, r4, lsl #5\n"                                                                  \
            "add r12, r12, r4, lsl #7\n"                                                                \
            "lsr.w r5, r5, #4\n"                                                                        \
            "sub r2, r2, r4, lsl #5\n"                                                                  \
            "ite eq\n" /* the first group, with a beginning of its own, is longer */                    \
            "subeq r12, r12, #143\n"                                                                    \
            "subne r12, r12, #127\n"                                                                    \
            "bx r12\n"                                                                                  \
            ".balign 8\n"                                                                               \
            "2:\n"                                                                                      \
            "vadd.f32 s2, s2, s10\n"                                                                    \
            "vldr s4, [r2]\n"                                                                           \
            "vadd.f32 s3, s3, s11\n"                                                                    \
            "vldr s12, [r1]\n"                                                                          \
            "vldr s5, [r2, #4]\n"                                                                       \
            "vldr s6, [r2, #8]\n"                                                                       \
            "vldr s13, [r1, #4]\n"                                                                      \
            "vldr s14, [r1, #8]\n"                                                                      \
            "vmul.f32 s4, s4, s12\n"                                                                    \
            "vldr s7, [r2, #12]\n"                                                                      \
            "vmul.f32 s5, s5, s13\n"                                                                    \
            "vldr s15, [r1, #12]\n"                                                                     \
            "GLSUM_FOUR_TAPS 0\n"                                                                       \
            "GLSUM_TAP 10, 14, 0, 8, 4, 12, 32\n"                                                       \
            "GLSUM_TAP 11, 15, 1, 9, 5, 13, 36\n"                                                       \
            "3:\n"                                                                                      \
            ".set .Ltap, 32\n"                                                                          \
            ".rept 14\n"                                                                                \
            "GLSUM_TAP 4, 12, 2, 10, 6, 14, .Ltap + 8\n"                                                \
            "GLSUM_TAP 5, 13, 3, 11, 7, 15, .Ltap + 12\n"                                               \
            "GLSUM_FOUR_TAPS .Ltap\n"                                                                   \
            "GLSUM_TAP 10, 14, 0, 8, 4, 12, .Ltap + 32\n"                                               \
            "GLSUM_TAP 11, 15, 1, 9, 5, 13, .Ltap + 36\n"                                               \
            ".set .Ltap, .Ltap + 32\n"                                                                  \
            ".endr\n"                                                                                   \
            "GLSUM_TAP 4, 12, 2, 10, 6, 14, .Ltap + 8\n"                                                \
            "GLSUM_TAP 5, 13, 3, 11, 7, 15, .Ltap + 12\n"                                               \
            "GLSUM_FOUR_TAPS .Ltap\n"                                                                   \
            "vmul.f32 s10, s10, s14\n"                                                                  \
            "subs r5, r5, #1\n"                                                                         \
            "vadd.f32 s0, s0, s8\n"                                                                     \
            "add.w r2, r2, #512\n"                                                                      \
            "vmul.f32 s11, s11, s15\n"                                                                  \
            "add.w r1, r1, #512\n"                                                                      \
            "vadd.f32 s1, s1, s9\n"                                                                     \
            "bne.w 2b\n"                                                                                \
            "4:\n"                                                                                      \
            "lsls r5, r3, #30\n" /* carry: four or more are left; minus: two or more of the rest */     \
            "bcc 5f\n"                                                                                  \
            "vldr s4, [r2]\n"                                                                           \
            "vldr s5, [r2, #4]\n"                                                                       \
            "vldr s12, [r1]\n"                                                                          \
            "vldr s13, [r1, #4]\n"                                                                      \
            "vldr s6, [r2, #8]\n"                                                                       \
            "vldr s7, [r2, #12]\n"                                                                      \
            "vmul.f32 s4, s4, s12\n"                                                                    \
            "vldr s14, [r1, #8]\n"                                                                      \
            "vmul.f32 s5, s5, s13\n"                                                                    \
            "vldr s15, [r1, #12]\n"                                                                     \
            "vmul.f32 s6, s6, s14\n"                                                                    \
            "adds r2, r2, #16\n"                                                                        \
            "vmul.f32 s7, s7, s15\n"                                                                    \
            "adds r1, r1, #16\n"                                                                        \
            "vadd.f32 s2, s2, s10\n"                                                                    \
            "vadd.f32 s3, s3, s11\n"                                                                    \
            "vadd.f32 s0, s0, s4\n"                                                                     \
            "vadd.f32 s1, s1, s5\n"                                                                     \
            "vadd.f32 s2, s2, s6\n"                                                                     \
            "vadd.f32 s3, s3, s7\n"                                                                     \
            "6:\n"                                                                                      \
            "ands r3, r3, #3\n"                                                                         \
            "beq 8f\n"                                                                                  \
            "vldr s4, [r2]\n"                                                                           \
            "subs r3, r3, #2\n"                                                                         \
            "vldr s12, [r1]\n"                                                                          \
            "vmul.f32 s4, s4, s12\n"                                                                    \
            "blt 7f\n"                                                                                  \
            "vldr s5, [r2, #4]\n"                                                                       \
            "vldr s13, [r1, #4]\n"                                                                      \
            "vmul.f32 s5, s5, s13\n"                                                                    \
            "beq 9f\n"                                                                                  \
            "vldr s6, [r2, #8]\n"                                                                       \
            "vldr s14, [r1, #8]\n"                                                                      \
            "vmul.f32 s6, s6, s14\n"                                                                    \
            "vadd.f32 s0, s0, s4\n"                                                                     \
            "vadd.f32 s1, s1, s5\n"                                                                     \
            "vadd.f32 s2, s2, s6\n"                                                                     \
            "8:\n"                                                                                      \
            "pop {r0, r4, r5, lr}\n"                                                                    \
            "vstmia r0, {s0-s3}\n"                                                                      \
            "bx lr\n"                                                                                   \
            "5:\n"                                                                                      \
            "vadd.f32 s2, s2, s10\n"                                                                    \
            "vadd.f32 s3, s3, s11\n"                                                                    \
            "b 6b\n"                                                                                    \
            "9:\n"                                                                                      \
            "vadd.f32 s1, s1, s5\n"                                                                     \
            "7:\n"                                                                                      \
            "vadd.f32 s0, s0, s4\n"                                                                     \
            "b 8b\n"                                                                                    \
            ".purgem GLSUM_FOUR_TAPS\n"                                                                 \
            ".purgem GLSUM_TAP\n");                                                                     \
    }
#endif
