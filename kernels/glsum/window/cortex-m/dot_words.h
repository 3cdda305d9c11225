/* Sums of products of 32-bit words in the order that a Cortex-M7 or a Cortex-M4 loses least in. C99 and C++; generated
 * headers hold this very text.
 *
 *   int64_t name_onto(int64_t sum, const void *a, const void *x, size_t words)     sum + the sum of a[i] x[i]
 *
 * `accumulate` is "smlal" (Q31: a word is a number) or "smlald" (Q15: a word is two). Exact in 64 bits where the sum
 * fits, so its order says nothing about its bits. a and x at multiples of four bytes. Reads nothing beyond the words.
 *
 * The caller says which registers change, and saves them with its own, at once. Words come in r4, since r12 belongs to a
 * linker's long branches; r7 may be the caller's frame. Not for position-independent code, which may not name the loop. */
#if defined(GLSUM_CORTEX_M4) /* no compiler says which of the two it compiles for */
/* Only another load, of the same memory, goes beside a load: so as many as there are registers come one behind the other.
 * Four words are 13 cycles, and 14 where a table in flash is another memory than the samples, which LDM takes always.
 * The words beyond a multiple of four come first. Then 32 a turn, the first of which is entered in its middle. */
#define GLSUM_FOUR_PRODUCTS(accumulate)                                                                 \
    accumulate " r0, r1, r4, r8\n" accumulate " r0, r1, r5, r9\n"                                       \
    accumulate " r0, r1, r6, r10\n" accumulate " r0, r1, r7, r11\n"
#define GLSUM_DOT_WORDS_LOOP(name, accumulate)                                                          \
    __attribute__((naked, noinline, aligned(8), unused)) static void name(void)                         \
    {                                                                                                   \
        __asm__ volatile(                                                                               \
            "cbz r4, 3f\n"                                                                              \
            "lsls r5, r4, #31\n" /* carry: two words; negative: one */                                  \
            "bcc.w 1f\n"                                                                                \
            "ldr.w r5, [r3, #4]\n"                                                                      \
            "ldr r6, [r3], #8\n"                                                                        \
            "ldr.w r8, [r2, #4]\n"                                                                      \
            "ldr r9, [r2], #8\n" accumulate " r0, r1, r5, r8\n" accumulate " r0, r1, r6, r9\n"          \
            "1:\n"                                                                                      \
            "bpl.w 2f\n"                                                                                \
            "ldr r5, [r3], #4\n"                                                                        \
            "ldr r8, [r2], #4\n" accumulate " r0, r1, r5, r8\n"                                         \
            "2:\n"                                                                                      \
            "subs.w r12, r4, #4\n" /* words behind the first group of four */                           \
            "bcc.w 3f\n"                                                                                \
            "ubfx r5, r12, #2, #3\n" /* groups of the first turn, less one; 48 bytes of code each */    \
            "adr.w r6, 4f + 337\n" /* the last of a turn's eight, and the bit of Thumb */               \
            "add.w r2, r2, r5, lsl #4\n"                                                                \
            "add.w r3, r3, r5, lsl #4\n"                                                                \
            "add.w r5, r5, r5, lsl #1\n"                                                                \
            "sub.w r6, r6, r5, lsl #4\n"                                                                \
            "strd r7, r11, [sp, #-8]!\n"                                                                \
            "bx r6\n"                                                                                   \
            "3:\n"                                                                                      \
            "bx lr\n"                                                                                   \
            ".balign 4\n"                                                                               \
            "4:\n"                                                                                      \
            ".set .Lword, -112\n"                                                                       \
            ".rept 7\n"                                                                                 \
            "ldr.w r4, [r3, #.Lword]\n"                                                                 \
            "ldr.w r5, [r3, #.Lword + 4]\n"                                                             \
            "ldr.w r6, [r3, #.Lword + 8]\n"                                                             \
            "ldr.w r7, [r3, #.Lword + 12]\n"                                                            \
            "ldr.w r8, [r2, #.Lword]\n"                                                                 \
            "ldr.w r9, [r2, #.Lword + 4]\n"                                                             \
            "ldr.w r10, [r2, #.Lword + 8]\n"                                                            \
            "ldr.w r11, [r2, #.Lword + 12]\n" GLSUM_FOUR_PRODUCTS(accumulate)                           \
            ".set .Lword, .Lword + 16\n"                                                                \
            ".endr\n"                                                                                   \
            "ldr.w r5, [r3, #4]\n"                                                                      \
            "ldr.w r6, [r3, #8]\n"                                                                      \
            "ldr.w r7, [r3, #12]\n"                                                                     \
            "ldr r4, [r3], #128\n"                                                                      \
            "ldr.w r9, [r2, #4]\n"                                                                      \
            "ldr.w r10, [r2, #8]\n"                                                                     \
            "ldr.w r11, [r2, #12]\n"                                                                    \
            "ldr r8, [r2], #128\n" GLSUM_FOUR_PRODUCTS(accumulate)                                      \
            "subs.w r12, r12, #32\n"                                                                    \
            "bcs.w 4b\n"                                                                                \
            "ldrd r7, r11, [sp], #8\n"                                                                  \
            "bx lr\n");                                                                                 \
    }
#else
/* Two words are three cycles, six issue slots with nothing lost: load x_0 and x_1, which lie in different banks of the
 * memory wherever they are; accumulate x_-1 a_-1 and load a_1; accumulate x_0 a_0 and load a_2. A register is loaded
 * anew beside its last use: five hold all that is under way, x_0, a_0, a_1, and x_1 of this pair and of the last.
 *
 * 64 words a turn, in halves whose offsets are the same: loads move the pointers, so that a turn has two slots beside
 * its words. The first turn is entered in its middle, by a jump that is the same at each call: the end of a loop over
 * what is left would be guessed wrong, as the end of this one is, for 6 cycles and not 8, since its flags are a turn
 * old. A word is 12 bytes of code. An even count enters where a pair begins, with a_0 loaded and a_-1 zero; an odd one
 * half a pair later, with x_1 loaded, whichever register that is, and x_0 zero. The a_2 of a turn's last pair is loaded
 * in the next turn, which there may not be. Negative offsets and those behind have no narrow encoding. */
#define GLSUM_HALF_TURN(accumulate)                                                                     \
    "ldr.w r5, [r3, #4]\n"                                                                              \
    "ldr r4, [r3], #128\n" accumulate " r0, r1, r6, r9\n"                                               \
    "ldr r9, [r2, #-120]\n" accumulate " r0, r1, r4, r8\n"                                              \
    "ldr r8, [r2, #-116]\n"                                                                             \
    ".set .Lword, -120\n"                                                                               \
    ".rept 7\n"                                                                                         \
    "ldr r4, [r3, #.Lword]\n"                                                                           \
    "ldr r6, [r3, #.Lword + 4]\n" accumulate " r0, r1, r5, r9\n"                                        \
    "ldr r9, [r2, #.Lword + 8]\n" accumulate " r0, r1, r4, r8\n"                                        \
    "ldr r8, [r2, #.Lword + 12]\n"                                                                      \
    "ldr r4, [r3, #.Lword + 8]\n"                                                                       \
    "ldr r5, [r3, #.Lword + 12]\n" accumulate " r0, r1, r6, r9\n"                                       \
    "ldr r9, [r2, #.Lword + 16]\n" accumulate " r0, r1, r4, r8\n"                                       \
    "ldr r8, [r2, #.Lword + 20]\n"                                                                      \
    ".set .Lword, .Lword + 16\n"                                                                        \
    ".endr\n"                                                                                           \
    "ldr r4, [r3, #-8]\n"                                                                               \
    "ldr r6, [r3, #-4]\n" accumulate " r0, r1, r5, r9\n"                                                \
    "ldr r9, [r2], #128\n" accumulate " r0, r1, r4, r8\n"
#define GLSUM_DOT_WORDS_LOOP(name, accumulate)                                                          \
    __attribute__((naked, noinline, aligned(8), unused)) static void name(void)                         \
    {                                                                                                   \
        __asm__ volatile(                                                                               \
            "subs.w r12, r4, #1\n"                                                                      \
            "bcc.w 3f\n"                                                                                \
            "and r6, r12, #63\n" /* words of the first turn, less one */                                \
            "mov.w r5, #12\n"                                                                           \
            "and r9, r12, #31\n"                                                                        \
            "adr.w r10, 2f + 757\n" /* the last of a turn's 64, and the bit of Thumb */                 \
            "and r4, r4, #31\n"                                                                         \
            "ldr.w r8, [r2]\n"                                                                          \
            "add.w r2, r2, r9, lsl #2\n"                                                                \
            "mls r10, r6, r5, r10\n"                                                                    \
            "ldr.w r5, [r3]\n"                                                                          \
            "lsrs.w r12, r12, #6\n" /* turns behind the first */                                        \
            "ldr.w r6, [r3]\n"                                                                          \
            "add.w r3, r3, r4, lsl #2\n"                                                                \
            "mov.w r4, #0\n"                                                                            \
            "mov.w r9, #0\n"                                                                            \
            "bx r10\n"                                                                                  \
            ".balign 8\n"                                                                               \
            "1:\n"                                                                                      \
            "ldr r8, [r2, #-124]\n"                                                                     \
            "subs.w r12, r12, #1\n"                                                                     \
            "2:\n" GLSUM_HALF_TURN(accumulate)                                                          \
            "ldr r8, [r2, #-124]\n" GLSUM_HALF_TURN(accumulate)                                         \
            "bne.w 1b\n" accumulate " r0, r1, r6, r9\n"                                                 \
            "3:\n"                                                                                      \
            "bx lr\n");                                                                                 \
    }
#endif
#define GLSUM_DOT_WORDS(name, accumulate)                                                               \
    GLSUM_DOT_WORDS_LOOP(name, accumulate)                                                              \
    __attribute__((always_inline, unused)) static inline int64_t name##_onto(                           \
        int64_t sum, const void *a, const void *x, size_t words)                                        \
    {                                                                                                   \
        register int64_t sum_in __asm__("r0") = sum;                                                    \
        register const void *a_in __asm__("r2") = a;                                                    \
        register const void *x_in __asm__("r3") = x;                                                    \
        register size_t words_in __asm__("r4") = words;                                                 \
        __asm__ volatile("bl %c[loop]"                                                                  \
                         : "+r"(sum_in), "+r"(a_in), "+r"(x_in), "+r"(words_in)                         \
                         : [loop] "i"(name)                                                             \
                         : "r5", "r6", "r8", "r9", "r10", "r12", "lr", "cc", "memory");                 \
        return sum_in;                                                                                  \
    }
