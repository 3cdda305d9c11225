/**
 * cascade_df2t_f32, 1 taps and 6 modes: a sum fitted to the derivative of order v = 0.5
 *
 * certified  within 1.87 % from 0.05 to 80 Hz (worst at 38.4 Hz), 3.78 % of a step's response until 60 s (worst at 41.3 s)
 * measured   1.78 % from 0.05 to 80 Hz (worst at 80 Hz), 3.39 % of a step's response until 60 s (worst at 42.4 s)
 *
 *   S_k = sum a_j x_(k-j), a_0 = 1, a_j of the table; w_0 h^-v S_k approximates the derivative of order v (v < 0: the integral).
 * Made by glsum; make it again rather than edit it.
 *
 *   static half_derivative_f32_instance line;
 *   half_derivative_init_f32(&line);
 *   float sum = half_derivative_step_f32(&line, x);  once a sample
 *
 * History: the newest samples as they are, all older ones in a cascade of second-order sections.
 * Sum: newest first, one accumulator; the last of the taps times a cascade in transposed direct form II.
 * Numbers: single precision.
 *
 * Scaling and overflow behaviour
 * No scaling: any input below overflow (about 1e38).
 * Overflow as in IEEE 754: no saturation; infinities and NaN pass through and stay in the past for the
 * length of the memory, until init. Denormal numbers are kept.
 *
 * Error bounds, absolute, of S_k for |x| <= 1, before h^-v
 * against the exact sum of these taps and modes, as designed in double, rounding of coefficients and inputs included: 0.205
 *
 * Measured cost a sample of the kernel that this is made from: 53 model cycles, at most 57.5, for stm32f746-itcm
 * Runner-up of 54 kernels: modes_plain_f32 with 1+5 taps, 54 model cycles, at most 59
 *
 * Command: glsum generate --order 0.5 --step-s 0.001 --derivative-error 5% --band 0.05..80 --step-until 60 --target m7 --out half_derivative.h --verify
 * glsum 0.1.0, commit 5b57146f550e384431454ccacbf3e7098324348d with changes
 * Errors and expected bits: GNU 12.2.0, -O3 -DNDEBUG -ffp-contract=off
 * Cost: GNU 12.2.1, -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16 -falign-functions=8 -ffunction-sections -fdata-sections -fno-threadsafe-statics -Wno-psabi -O3 -DNDEBUG -ffp-contract=off
 * QEMU emulator version 7.2.22 (Debian 1:7.2+dfsg-7+deb12u18+b3)
 */
#if defined(HALF_DERIVATIVE_F32_H) && !defined(HALF_DERIVATIVE_F32_IS_C13D01D4FDD3B0B4)
#define HALF_DERIVATIVE_F32_DESIGN "cascade_df2t_f32, 1+6, v = 0.5, h = 0.001 s, fitted to the derivative"
#error "half_derivative_f32: another design of this prefix was included before (see the two DESIGN); make one with another --prefix"
#endif
#ifndef HALF_DERIVATIVE_F32_H
#define HALF_DERIVATIVE_F32_H
#define HALF_DERIVATIVE_F32_IS_C13D01D4FDD3B0B4
#define HALF_DERIVATIVE_F32_DESIGN "cascade_df2t_f32, 1+6, v = 0.5, h = 0.001 s, fitted to the derivative"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define HALF_DERIVATIVE_F32_TAPS 13U               /* L: coefficients, a_0 included */
#define HALF_DERIVATIVE_F32_PAST 0U               /* past samples that a sum reads */
#define HALF_DERIVATIVE_F32_SAMPLES 6U            /* past samples that the instance holds */
#define HALF_DERIVATIVE_F32_STEP_FACTOR 38.659035F /* w_0 h^-v: times S_k it is the derivative */
#define HALF_DERIVATIVE_F32_SECTIONS 3U             /* of second order, each 2 modes */

/* Define them before the inclusion to place the table (flash) and the step (tightly coupled memory). */
#ifndef HALF_DERIVATIVE_F32_TABLE_ATTRIBUTES
#define HALF_DERIVATIVE_F32_TABLE_ATTRIBUTES
#endif
#ifndef HALF_DERIVATIVE_F32_STEP_ATTRIBUTES
#define HALF_DERIVATIVE_F32_STEP_ATTRIBUTES
#endif

#if defined(__GNUC__)
#define HALF_DERIVATIVE_F32_HELPER static inline __attribute__((always_inline))
#else
#define HALF_DERIVATIVE_F32_HELPER static inline
#endif

/* The bits are promised for IEEE arithmetic as written. A compiler may still fuse a product with the addition behind it
   (GCC does so by default, for a core with fused instructions): KEEP passes the rounded product through an empty
   instruction, which costs nothing and cannot be fused. Others are told by the standard's pragma. */
#if defined(__FAST_MATH__)
#error "half_derivative_f32: -ffast-math reorders sums; compile without it"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "half_derivative_f32: arithmetic in excess precision (x87) does not give the bits of this kernel"
#endif
#if defined(__GNUC__) && (defined(__SSE2__) || defined(__x86_64__))
#define HALF_DERIVATIVE_F32_KEEP(value) __asm__("" : "+x"(value))
#elif defined(__GNUC__) && (defined(__aarch64__) || (defined(__ARM_FP) && (__ARM_FP & 4)))
#define HALF_DERIVATIVE_F32_KEEP(value) __asm__("" : "+t"(value))
#elif defined(__GNUC__) && defined(__arm__)
#define HALF_DERIVATIVE_F32_KEEP(value) ((void)(value)) /* in software: nothing is fused there */
#elif defined(__GNUC__) && defined(__riscv_flen)
#define HALF_DERIVATIVE_F32_KEEP(value) __asm__("" : "+f"(value))
#elif defined(__GNUC__)
#define HALF_DERIVATIVE_F32_KEEP(value) __asm__("" : "+m"(value))
#else
#pragma STDC FP_CONTRACT OFF
#define HALF_DERIVATIVE_F32_KEEP(value) ((void)(value))
#endif

/* The coefficients. */
HALF_DERIVATIVE_F32_TABLE_ATTRIBUTES
static const float half_derivative_f32_table[12] = {
    -1.9904503F, 0.9904603F, 1.9748567F, -0.9749265F, -1.9431387F, 0.94314814F, 1.8616942F, -0.86175644F,
    -1.6627717F, 0.66277564F, 1.1045601F, -0.1046094F,
};

/** What changes from sample to sample; the caller owns it. One for each signal. */
typedef struct {
    float past[HALF_DERIVATIVE_F32_SAMPLES]; /* x_(k-1), x_(k-2), ...; then of each section its state */
} half_derivative_f32_instance;

/** Forgets the past: x = 0 before the next sample. Call it before the first step. */
static inline void half_derivative_init_f32(half_derivative_f32_instance *S)
{
    size_t i;
    for (i = 0; i < HALF_DERIVATIVE_F32_SAMPLES; ++i) {
        S->past[i] = 0;
    }
}

HALF_DERIVATIVE_F32_HELPER float half_derivative_f32_product(float a, float b)
{
    float rounded = a * b;
    HALF_DERIVATIVE_F32_KEEP(rounded);
    return rounded;
}

HALF_DERIVATIVE_F32_HELPER float half_derivative_f32_multiply(float a, float x)
{
    return half_derivative_f32_product((float)(a), (float)(x));
}

HALF_DERIVATIVE_F32_HELPER float half_derivative_f32_finish(half_derivative_f32_instance *S, float sum)
{
    (void)S;
    return (float)sum;
}

typedef struct {
    float value;
    float first;
    float second;
} half_derivative_f32_passed;
HALF_DERIVATIVE_F32_HELPER half_derivative_f32_passed half_derivative_f32_pass(const float *of_section, const float *kept, float before)
{
    const float of_before = kept[1] + half_derivative_f32_multiply(of_section[0], before);
    const float second_of_before = half_derivative_f32_multiply(of_section[1], before);
    const float after = before + kept[0];
    const float first = of_before + half_derivative_f32_multiply(of_section[2], after);
    const half_derivative_f32_passed passed = {after, first, second_of_before + half_derivative_f32_multiply(of_section[3], after)};
    return passed;
}

HALF_DERIVATIVE_F32_HELPER void half_derivative_f32_keep(float *kept, half_derivative_f32_passed passed)
{
    kept[0] = passed.first;
    kept[1] = passed.second;
}

/** One sample in, one sum out: S_k of x_k = newest and all samples before it. */
HALF_DERIVATIVE_F32_STEP_ATTRIBUTES
static inline float half_derivative_step_f32(half_derivative_f32_instance *S, float newest)
{
    size_t i;
    float value = newest;
    {
        const float *of_section = half_derivative_f32_table + HALF_DERIVATIVE_F32_PAST;
        float *kept = S->past + HALF_DERIVATIVE_F32_PAST;
        {
            const half_derivative_f32_passed alone = half_derivative_f32_pass(of_section, kept, value);
            value = alone.value;
            half_derivative_f32_keep(kept, alone);
            of_section += 4;
            kept += 2;
        }
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 8
#pragma GCC unroll 8
#endif
        for (i = HALF_DERIVATIVE_F32_SECTIONS / 2U; i > 0U; --i) {
            const half_derivative_f32_passed one = half_derivative_f32_pass(of_section, kept, value);
            const half_derivative_f32_passed other = half_derivative_f32_pass(of_section + 4, kept + 2, one.value);
            value = other.value;
            half_derivative_f32_keep(kept, one);
            half_derivative_f32_keep(kept + 2, other);
            of_section += 8;
            kept += 4;
        }
    }
    float sum = value;
    return half_derivative_f32_finish(S, sum);
}

/* The self-check: inputs, repeated, and what the registered kernel gave for them, bit by bit. */
static const float half_derivative_f32_check_input[37] = {
    0.42916164F, 0.35866404F, 0.30492845F, 0.19046313F, 0.56503934F, -0.5716229F, -0.42219633F, 0.7137219F,
    -0.019994928F, 0.37740242F, -0.79091907F, 0.16965552F, -0.2769354F, 0.41510642F, 0.67646635F, 0.106513165F,
    0.1592602F, -0.5251012F, 0.31719157F, -0.81103426F, -0.44494414F, -0.6000012F, -0.73515457F, 0.8745079F,
    0.38700593F, 0.3732911F, 0.3893131F, -0.11381062F, 0.02544961F, 0.34268242F, -0.7379822F, 0.7455614F,
    -0.74255663F, -0.056971397F, -0.680662F, 0.08887337F, -0.62944925F,
};
static const uint32_t half_derivative_f32_check_first[37] = {
    0x3EDBBB13U, 0x3D9EA140U, 0x3D02DA88U, 0xBD570044U, 0x3ECAC444U, 0xBF7ACFC8U, 0xBDF42778U, 0x3F810DBCU,
    0xBEEBD046U, 0x3EA759E2U, 0xBF877C9CU, 0x3F23A44FU, 0xBEAEC782U, 0x3F159018U, 0x3ED86776U, 0xBEBE15E6U,
    0x3C9B1EB8U, 0xBF2A0F56U, 0x3F203562U, 0xBF7E96FCU, 0x3D5CCC80U, 0xBE810082U, 0xBE961A8CU, 0x3FB667E0U,
    0xBDC10E00U, 0x3DA704ACU, 0x3DEFA0ACU, 0xBECE106EU, 0x3D6BCD76U, 0x3EA4494FU, 0xBF7909EFU, 0x3F98679AU,
    0xBF974CC8U, 0x3EBDDB99U, 0xBF1854D1U, 0x3F0C4510U, 0xBF1F65B1U,
};
static const uint32_t half_derivative_f32_check_last[37] = {
    0x3F5B243DU, 0x3E160144U, 0x3D775E50U, 0xBCFE0FD0U, 0x3ED42F80U, 0xBF76B471U, 0xBDD76678U, 0x3F82A132U,
    0xBEE64626U, 0x3EAC3AB2U, 0xBF86690AU, 0x3F258C07U, 0xBEAB65FCU, 0x3F171136U, 0x3EDB1706U, 0xBEBBAE19U,
    0x3CBDB5E8U, 0xBF2915BDU, 0x3F21175CU, 0xBF7DC999U, 0x3D688320U, 0xBE7F523CU, 0xBE94DEB2U, 0x3FB6B0CEU,
    0xBDBCD3F0U, 0x3DAAF3E4U, 0x3DF34DCCU, 0xBECD33C6U, 0x3D724AE6U, 0x3EA50D6EU, 0xBF78AD07U, 0x3F9893BEU,
    0xBF9722B8U, 0x3EBE7C59U, 0xBF1807D6U, 0x3F0C8EF1U, 0xBF1F1EA2U,
};

/**
 * Runs 111 samples through the instance, which is initialised before and after, and compares every output with
 * those of the kernel that this header was made from.
 * Returns 0 when all bits are the same, else the number of the first sample that is known to differ, from 1.
 */
static inline uint32_t half_derivative_self_check_f32(half_derivative_f32_instance *S)
{
    uint64_t hash = UINT64_C(0xCBF29CE484222325); /* FNV-1a of all outputs, the lowest byte first */
    uint32_t wrong = 0U;
    uint32_t k;
    half_derivative_init_f32(S);
    for (k = 0U; k < 111U; ++k) {
        const float output = half_derivative_step_f32(S, half_derivative_f32_check_input[k % 37U]);
        uint32_t bits;
        unsigned int byte;
        memcpy(&bits, &output, sizeof bits);
        for (byte = 0U; byte < sizeof bits; ++byte) {
            hash = (hash ^ ((bits >> (8U * byte)) & 0xFFU)) * UINT64_C(0x100000001B3);
        }
        if (wrong == 0U && ((k < 37U && bits != half_derivative_f32_check_first[k]) ||
                            (k >= 74U && bits != half_derivative_f32_check_last[k - 74U]))) {
            wrong = k + 1U;
        }
    }
    half_derivative_init_f32(S);
    return wrong != 0U ? wrong : hash == UINT64_C(0x4A93133372434108) ? 0U : 111U;
}

#endif /* HALF_DERIVATIVE_F32_H */
