/* Sums of products of 32-bit words in the order of a Cortex-M7's issue slots. C99 and C++; generated headers hold this
 * very text.
 *
 *   int64_t name(const void *a, const void *x, size_t words)     sum of a[i] x[i]
 *
 * `accumulate` is "smlal" (Q31: a word is a number) or "smlald" (Q15: a word is two). Exact in 64 bits where the sum
 * fits, so its order says nothing about its bits. a and x at multiples of four bytes. Reads nothing beyond the words.
 *
 * Two words are three cycles, six issue slots with nothing lost: load x_0 and x_1, which lie in different banks of the
 * memory wherever they are; load a_0 while x_-2 a_-2 is accumulated; load a_1 while x_-1 a_-1 is. A pair is accumulated
 * one later than it is loaded, so the two halves of the registers alternate, and the first pair meets coefficients of
 * zero. 64 words a turn. The first turn is entered in its middle, by a jump that is the same at each call: the end of
 * a loop over what is left would be guessed wrong.
 *
 * Basic assembly in a function without prologue: compilers take it to read and write any memory. */
#define GLSUM_DOT_WORDS(name, accumulate)                                                               \
    __attribute__((naked, noinline, aligned(8), unused)) static int64_t name(                           \
        const void *a __attribute__((unused)), const void *x __attribute__((unused)),                   \
        size_t words __attribute__((unused)))                                                           \
    {                                                                                                   \
        __asm__ volatile(                                                                               \
            "push {r4-r11, lr}\n"                                                                       \
            "mov.w r3, #0\n"                                                                            \
            "mov.w r12, #0\n"                                                                           \
            "mov.w r6, #0\n"                                                                            \
            "mov.w r7, #0\n"                                                                            \
            "mov.w r10, #0\n"                                                                           \
            "mov.w r11, #0\n"                                                                           \
            "mov.w r8, #0\n"                                                                            \
            "lsrs r2, r2, #1\n" /* pairs, and an odd word by itself */                                  \
            "itt cs\n"                                                                                  \
            "ldrcs r8, [r1], #4\n"                                                                      \
            "ldrcs r9, [r0], #4\n"                                                                      \
            "negs r4, r2\n" /* pairs that the first of the turns leaves out, 24 bytes of code each */   \
            "adr r5, 2f\n"                                                                              \
            "and r4, r4, #31\n"                                                                         \
            "add.w r2, r2, #31\n" accumulate " r3, r12, r8, r9\n"                                       \
            "beq.w 3f\n"                                                                                \
            "adds r5, r5, #1\n"                                                                         \
            "mov.w lr, #24\n"                                                                           \
            "lsrs r2, r2, #5\n"                                                                         \
            "mla r5, r4, lr, r5\n"                                                                      \
            "sub r0, r0, r4, lsl #3\n"                                                                  \
            "sub r1, r1, r4, lsl #3\n"                                                                  \
            "bx r5\n"                                                                                   \
            ".balign 8\n"                                                                               \
            "2:\n"                                                                                      \
            ".set .Lword, 0\n"                                                                          \
            ".rept 16\n"                                                                                \
            "ldr.w r4, [r1, #.Lword]\n"                                                                 \
            "ldr.w r5, [r1, #.Lword + 4]\n"                                                             \
            "ldr.w r6, [r0, #.Lword]\n" accumulate " r3, r12, r8, r10\n"                                \
            "ldr.w r7, [r0, #.Lword + 4]\n" accumulate " r3, r12, r9, r11\n"                            \
            "ldr.w r8, [r1, #.Lword + 8]\n"                                                             \
            "ldr.w r9, [r1, #.Lword + 12]\n"                                                            \
            "ldr.w r10, [r0, #.Lword + 8]\n" accumulate " r3, r12, r4, r6\n"                            \
            "ldr.w r11, [r0, #.Lword + 12]\n" accumulate " r3, r12, r5, r7\n"                           \
            ".set .Lword, .Lword + 16\n"                                                                \
            ".endr\n"                                                                                   \
            "add.w r1, r1, #256\n"                                                                      \
            "subs.w r2, r2, #1\n"                                                                       \
            "add.w r0, r0, #256\n"                                                                      \
            "bne.w 2b\n" accumulate " r3, r12, r8, r10\n" accumulate " r3, r12, r9, r11\n"              \
            "3:\n"                                                                                      \
            "mov r0, r3\n"                                                                              \
            "mov r1, r12\n"                                                                             \
            "pop {r4-r11, pc}\n");                                                                      \
    }
