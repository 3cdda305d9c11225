// The parts of every header that no kernel brings, in its order. Places as in text.hpp.
#pragma once

namespace generate::texts {

inline constexpr const char* head = R"(
#include <stddef.h>
#include <stdint.h>
#include <string.h>
@includes@
#define @NAME@_TAPS @taps@U               /* L: coefficients, a_0 included */
#define @NAME@_PAST @past@U               /* past samples that a sum reads */
#define @NAME@_SAMPLES @samples@U            /* past samples that the instance holds */
@constants@
/* Define them before the inclusion to place the table (flash) and the step (tightly coupled memory). */
#ifndef @NAME@_TABLE_ATTRIBUTES
#define @NAME@_TABLE_ATTRIBUTES
#endif
#ifndef @NAME@_STEP_ATTRIBUTES
#define @NAME@_STEP_ATTRIBUTES
#endif

#if defined(__GNUC__)
#define @NAME@_HELPER static inline __attribute__((always_inline))
#else
#define @NAME@_HELPER static inline
#endif
)";

inline constexpr const char* guard_floating = R"(
/* The bits are promised for IEEE arithmetic as written. A compiler may still fuse a product with the addition behind it
   (GCC does so by default, for a core with fused instructions): KEEP passes the rounded product through an empty
   instruction, which costs nothing and cannot be fused. Others are told by the standard's pragma. */
#if defined(__FAST_MATH__)
#error "@name@: -ffast-math reorders sums; compile without it"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "@name@: arithmetic in excess precision (x87) does not give the bits of this kernel"
#endif
#if defined(__GNUC__) && (defined(__SSE2__) || defined(__x86_64__))
#define @NAME@_KEEP(value) __asm__("" : "+x"(value))
#elif defined(__GNUC__) && (defined(__aarch64__) || (defined(__ARM_FP) && (__ARM_FP & @fp_bit@)))
#define @NAME@_KEEP(value) __asm__("" : "+@fp_register@"(value))
#elif defined(__GNUC__) && defined(__arm__)
#define @NAME@_KEEP(value) ((void)(value)) /* in software: nothing is fused there */
#elif defined(__GNUC__) && defined(__riscv_flen)
#define @NAME@_KEEP(value) __asm__("" : "+f"(value))
#elif defined(__GNUC__)
#define @NAME@_KEEP(value) __asm__("" : "+m"(value))
#else
#pragma STDC FP_CONTRACT OFF
#define @NAME@_KEEP(value) ((void)(value))
#endif
)";

inline constexpr const char* guard_fixed = R"(
#if (-1 >> 1) != -1
#error "@name@: needs arithmetic shifts of negative numbers"
#endif
)";

// Before a loop in software double. In one that is unrolled each turn would call the addition from a place of its own,
// and a core without a return stack guesses that it returns to the place before: a tenth more cycles.
inline constexpr const char* not_unrolled =
    R"(#if defined(@NAME@_SOFT_DOUBLE) && !defined(__clang__) && __GNUC__ >= 8
#pragma GCC unroll 1
#endif
)";

inline constexpr const char* soft_double =
    R"(#if defined(__GNUC__) && defined(__arm__) && !(defined(__ARM_FP) && (__ARM_FP & 8))
#define @NAME@_SOFT_DOUBLE /* double precision takes calls */
#endif
)";

inline constexpr const char* keep_word = R"(#if defined(__GNUC__)
#define @NAME@_KEEP_WORD(value) __asm__("" : "+r"(value))
#else
#define @NAME@_KEEP_WORD(value) ((void)(value))
#endif
)";

inline constexpr const char* instance = R"(
/** What changes from sample to sample; the caller owns it. One for each signal. */
typedef struct {
@fields@} @prefix@_@f@_instance;

/** Forgets the past: x = 0 before the next sample. Call it before the first step. */
static inline void @prefix@_init_@f@(@prefix@_@f@_instance *S)
{
    size_t i;
@reset@}
)";

inline constexpr const char* step = R"(
/** One sample in, one sum out: S_k of x_k = newest and @reads@ before it. */
@NAME@_STEP_ATTRIBUTES
static inline @output@ @prefix@_step_@f@(@prefix@_@f@_instance *S, @sample@ newest)
{
@body@}
)";

inline constexpr const char* dsp = R"(
/* Two samples as one word, the lower address in the lower half, and two products added at once. */
#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>
#endif
@NAME@_HELPER int32_t @name@_load_pair(const int16_t *pair)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    int32_t word;
    memcpy(&word, pair, sizeof word);
    return word;
#else
    return (int32_t)((uint32_t)(uint16_t)pair[0] | ((uint32_t)(uint16_t)pair[1] << 16));
#endif
}
@NAME@_HELPER @wide@ @name@_@word@(int32_t a, int32_t b, @wide@ sum)
{
#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32)
    return __@word@((int16x2_t)a, (int16x2_t)b, sum);
#else
@two_products@#endif
}
)";

inline constexpr const char* written_out = R"(
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 8
#define @NAME@_UNROLLED _Pragma("GCC unroll @turns@")
#else
#define @NAME@_UNROLLED
#endif
)";

inline constexpr const char* self_check = R"(
/* The self-check: inputs, repeated, and what the registered kernel gave for them, bit by bit. */
@inputs@@first@@last@
/**
 * Runs @steps@ samples through the instance, which is initialised before and after, and compares every output with
 * those of the kernel that this header was made from.
 * Returns 0 when all bits are the same, else the number of the first sample that is known to differ, from 1.
 */
static inline uint32_t @prefix@_self_check_@f@(@prefix@_@f@_instance *S)
{
    uint64_t hash = UINT64_C(0xCBF29CE484222325); /* FNV-1a of all outputs, the lowest byte first */
    uint32_t wrong = 0U;
    uint32_t k;
    @prefix@_init_@f@(S);
    for (k = 0U; k < @steps@U; ++k) {
        const @output@ output = @prefix@_step_@f@(S, @name@_check_input[k % @check@U]);
        @bits@ bits;
        unsigned int byte;
        memcpy(&bits, &output, sizeof bits);
        for (byte = 0U; byte < sizeof bits; ++byte) {
            hash = (hash ^ ((bits >> (8U * byte)) & 0xFFU)) * UINT64_C(0x100000001B3);
        }
        if (wrong == 0U && ((k < @check@U && bits != @name@_check_first[k]) ||
                            (k >= @from@U && bits != @name@_check_last[k - @from@U]))) {
            wrong = k + 1U;
        }
    }
    @prefix@_init_@f@(S);
    return wrong != 0U ? wrong : hash == @hash@ ? 0U : @steps@U;
}

#endif /* @NAME@_H */
)";

}  // namespace generate::texts
