/**
 * ring_plain_f32, 200 taps: the Grünwald-Letnikov sum of order v = 0.5
 *
 *   S_k = sum_{j=0..min(k, L-1)} a_j x_(k-j),   a_0 = 1,   a_j = a_(j-1) (1 - (1+v)/j)
 *
 * one sum a sample; h^-v S_k approximates the derivative of order v (v < 0: the integral).
 * Made by glsum; make it again rather than edit it.
 *
 *   static half_f32_instance line;
 *   half_init_f32(&line);
 *   float sum = half_step_f32(&line, x);  once a sample
 *
 * History: samples stay in place, the head moves down and wraps.
 * Sum: newest first, one accumulator.
 * Numbers: single precision.
 *
 * Scaling and overflow behaviour
 * No scaling: any input below overflow (about 1e38).
 * Overflow as in IEEE 754: no saturation; infinities and NaN pass through and stay in the past for the
 * length of the memory, until init. Denormal numbers are kept.
 *
 * Error bounds, absolute, of S_k for |x| <= 1, before h^-v
 * against the exact sum of 200 taps, rounding of coefficients and inputs included: 2.31e-05
 * of that sum against full memory (truncation): 0.04
 *
 * Measured error 0.343 (ramp): the largest of S_k over 1000 samples at h = 0.001 s,
 * relative to the largest exact full-memory sum, the worst of step, ramp, sine1, sine5, sine50, noise, drive
 * Measured cost a sample of the kernel that this is made from: 1227.6 model cycles, at most 1289.2, for stm32f746-itcm
 *
 * Command: glsum generate --order 0.5 --kernel ring_plain_f32 --taps 200 --quick --prefix half --out targets/example/half_derivative.h
 * glsum 0.1.0, commit d83c3914e575af7f58c891dbc255bac078608a57 with changes
 * Errors and expected bits: GNU 12.2.0, -O3 -DNDEBUG -ffp-contract=off
 * Cost: GNU 12.2.1, -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16 -falign-functions=8 -ffunction-sections -fdata-sections -fno-threadsafe-statics -Wno-psabi -O3 -DNDEBUG -ffp-contract=off
 * QEMU emulator version 7.2.22 (Debian 1:7.2+dfsg-7+deb12u18+b3)
 */
#if defined(HALF_F32_H) && !defined(HALF_F32_IS_37CB5CCD9331D4D3)
#pragma message("half_f32 was included before as: " HALF_F32_DESIGN)
#error "half_f32: two designs of one prefix, the one of the message above and ring_plain_f32, 200, v = 0.5, h = 0.001 s; make one with another --prefix"
#endif
#ifndef HALF_F32_H
#define HALF_F32_H
#define HALF_F32_IS_37CB5CCD9331D4D3
#define HALF_F32_DESIGN "ring_plain_f32, 200, v = 0.5, h = 0.001 s"

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define HALF_F32_TAPS 200U               /* L: coefficients, a_0 included */
#define HALF_F32_PAST 199U               /* past samples that a sum reads */
#define HALF_F32_SAMPLES 199U            /* past samples that the instance holds */
#define HALF_F32_STEP_FACTOR 31.622776F /* h^-v: times S_k it is the derivative */

/* Define them before the inclusion to place the table (flash) and the step (tightly coupled memory). */
#ifndef HALF_F32_TABLE_ATTRIBUTES
#define HALF_F32_TABLE_ATTRIBUTES
#endif
#ifndef HALF_F32_STEP_ATTRIBUTES
#define HALF_F32_STEP_ATTRIBUTES
#endif

#if defined(__GNUC__)
#define HALF_F32_HELPER static inline __attribute__((always_inline))
#else
#define HALF_F32_HELPER static inline
#endif

/* The bits are promised for IEEE arithmetic as written. A compiler may still fuse a product with the addition behind it
   (GCC does so by default, for a core with fused instructions): KEEP passes the rounded product through an empty
   instruction, which costs nothing and cannot be fused. Others are told by the standard's pragma. */
#if defined(__FAST_MATH__)
#error "half_f32: -ffast-math reorders sums; compile without it"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "half_f32: arithmetic in excess precision (x87) does not give the bits of this kernel"
#endif
#if defined(__GNUC__) && (defined(__SSE2__) || defined(__x86_64__))
#define HALF_F32_KEEP(value) __asm__("" : "+x"(value))
#elif defined(__GNUC__) && (defined(__aarch64__) || (defined(__ARM_FP) && (__ARM_FP & 4)))
#define HALF_F32_KEEP(value) __asm__("" : "+t"(value))
#elif defined(__GNUC__) && defined(__arm__)
#define HALF_F32_KEEP(value) ((void)(value)) /* in software: nothing is fused there */
#elif defined(__GNUC__) && defined(__riscv_flen)
#define HALF_F32_KEEP(value) __asm__("" : "+f"(value))
#elif defined(__GNUC__)
#define HALF_F32_KEEP(value) __asm__("" : "+m"(value))
#else
#pragma STDC FP_CONTRACT OFF
#define HALF_F32_KEEP(value) ((void)(value))
#endif
#if defined(__GNUC__)
#define HALF_F32_KEEP_WORD(value) __asm__("" : "+r"(value))
#else
#define HALF_F32_KEEP_WORD(value) ((void)(value))
#endif

/* The coefficients. */
HALF_F32_TABLE_ATTRIBUTES
static const float half_f32_table[199] = {
    -0.5F, -0.125F, -0.0625F, -0.0390625F, -0.02734375F, -0.020507812F, -0.016113281F, -0.013092041F, -0.010910034F,
    -0.009273529F, -0.008008957F, -0.0070078373F, -0.0061992407F, -0.0055350363F, -0.0049815327F, -0.004514514F,
    -0.0041161748F, -0.00377316F, -0.0034752788F, -0.003214633F, -0.0029850164F, -0.0027814924F, -0.0026000908F,
    -0.0024375853F, -0.0022913301F, -0.002159138F, -0.0020391857F, -0.0019299437F, -0.001830119F, -0.0017386131F,
    -0.0016544866F, -0.0015769326F, -0.0015052538F, -0.0014388455F, -0.0013771808F, -0.0013197983F, -0.0012662929F,
    -0.0012163076F, -0.0011695266F, -0.0011256693F, -0.0010844864F, -0.0010457546F, -0.0010092749F, -0.0009748678F,
    -0.0009423722F, -0.0009116426F, -0.00088254764F, -0.00085496804F, -0.00082879554F, -0.0008039317F,
    -0.0007802866F, -0.00075777835F, -0.0007363318F, -0.00071587815F, -0.0006963542F, -0.00067770184F,
    -0.0006598676F, -0.00064280204F, -0.00062645966F, -0.00061079813F, -0.0005957785F, -0.0005813645F,
    -0.0005675225F, -0.0005542212F, -0.0005414315F, -0.0005291262F, -0.00051728013F, -0.0005058695F, -0.00049487234F,
    -0.00048426795F, -0.00047403693F, -0.00046416116F, -0.0004546236F, -0.00044540825F, -0.0004365001F,
    -0.00042788495F, -0.00041954956F, -0.00041148128F, -0.00040366835F, -0.00039609955F, -0.0003887644F,
    -0.00038165285F, -0.0003747555F, -0.00036806345F, -0.0003615682F, -0.00035526179F, -0.00034913656F,
    -0.00034318538F, -0.00033740138F, -0.00033177802F, -0.00032630915F, -0.00032098888F, -0.00031581163F,
    -0.0003107721F, -0.00030586516F, -0.00030108602F, -0.00029643005F, -0.00029189285F, -0.00028747023F,
    -0.00028315818F, -0.00027895288F, -0.0002748506F, -0.00027084793F, -0.00026694147F, -0.00026312802F,
    -0.0002594045F, -0.000255768F, -0.0002522157F, -0.00024874482F, -0.00024535283F, -0.00024203726F,
    -0.00023879569F, -0.00023562583F, -0.0002325255F, -0.00022949255F, -0.00022652498F, -0.00022362081F,
    -0.00022077818F, -0.00021799526F, -0.00021527032F, -0.00021260168F, -0.00020998772F, -0.0002074269F,
    -0.0002049177F, -0.00020245869F, -0.00020004847F, -0.00019768569F, -0.00019536905F, -0.00019309732F,
    -0.00019086928F, -0.00018868376F, -0.00018653962F, -0.00018443579F, -0.00018237121F, -0.00018034487F,
    -0.00017835577F, -0.00017640296F, -0.00017448554F, -0.00017260261F, -0.0001707533F, -0.00016893676F,
    -0.00016715222F, -0.00016539887F, -0.00016367597F, -0.00016198277F, -0.00016031857F, -0.00015868267F,
    -0.00015707439F, -0.00015549311F, -0.00015393818F, -0.00015240899F, -0.00015090495F, -0.0001494255F,
    -0.00014797004F, -0.00014653808F, -0.00014512906F, -0.00014374248F, -0.00014237783F, -0.00014103464F,
    -0.00013971244F, -0.00013841077F, -0.0001371292F, -0.00013586727F, -0.00013462458F, -0.00013340072F,
    -0.00013219529F, -0.00013100791F, -0.0001298382F, -0.00012868579F, -0.00012755033F, -0.00012643146F,
    -0.00012532886F, -0.0001242422F, -0.00012317115F, -0.0001221154F, -0.000121074634F, -0.00012004858F,
    -0.00011903693F, -0.00011803942F, -0.00011705575F, -0.00011608568F, -0.00011512893F, -0.00011418525F,
    -0.00011325439F, -0.000112336114F, -0.00011143018F, -0.00011053635F, -0.000109654415F, -0.00010878414F,
    -0.00010792532F, -0.000107077736F, -0.00010624119F, -0.000105415485F, -0.00010460041F, -0.0001037958F,
    -0.00010300144F, -0.000102217164F, -0.00010144279F, -0.000100678146F,
};

/** What changes from sample to sample; the caller owns it. One for each signal. */
typedef struct {
    uint32_t head; /* where x_(k-1) lies; x_(k-2) behind it */
    float past[HALF_F32_SAMPLES];
} half_f32_instance;

/** Forgets the past: x = 0 before the next sample. Call it before the first step. */
static inline void half_init_f32(half_f32_instance *S)
{
    size_t i;
    S->head = 0U;
    for (i = 0; i < HALF_F32_SAMPLES; ++i) {
        S->past[i] = 0;
    }
}

HALF_F32_HELPER float half_f32_start(float newest)
{
    return newest;
}

HALF_F32_HELPER float half_f32_product(float a, float b)
{
    float rounded = a * b;
    HALF_F32_KEEP(rounded);
    return rounded;
}

HALF_F32_HELPER float half_f32_multiply(float a, float x)
{
    return half_f32_product((float)(a), (float)(x));
}

HALF_F32_HELPER float half_f32_multiply_add(float sum, float a, float x)
{
    return sum + half_f32_multiply(a, x);
}

HALF_F32_HELPER float half_f32_finish(half_f32_instance *S, float sum)
{
    (void)S;
    return (float)sum;
}

HALF_F32_HELPER uint32_t half_f32_next_head(uint32_t head, size_t past) {
    return (head == 0 ? (uint32_t)(past) : head) - 1;
}

/** One sample in, one sum out: S_k of x_k = newest and the 199 samples before it. */
HALF_F32_STEP_ATTRIBUTES
static inline float half_step_f32(half_f32_instance *S, float newest)
{
    uint32_t head = S->head;
    float *samples = S->past;
    size_t past = HALF_F32_PAST;
    HALF_F32_KEEP_WORD(past);
    const float *table = half_f32_table;
    const float* const newer = samples + head;
    const size_t newer_count = past - head;
    const float* const older = samples;
    const size_t older_count = head;
    float sum = half_f32_start(newest);
    for (size_t i = 0; i < newer_count; ++i) {
        sum = half_f32_multiply_add(sum, table[i], newer[i]);
    }
    table += newer_count;
    for (size_t i = 0; i < older_count; ++i) {
        sum = half_f32_multiply_add(sum, table[i], older[i]);
    }
    head = half_f32_next_head(head, HALF_F32_PAST);
    HALF_F32_KEEP_WORD(head);
    S->past[head] = newest;
    S->head = head;
    return half_f32_finish(S, sum);
}

/* The self-check: inputs, repeated, and what the registered kernel gave for them, bit by bit. */
static const float half_f32_check_input[37] = {
    0.42916164F, 0.35866404F, 0.30492845F, 0.19046313F, 0.56503934F, -0.5716229F, -0.42219633F, 0.7137219F,
    -0.019994928F, 0.37740242F, -0.79091907F, 0.16965552F, -0.2769354F, 0.41510642F, 0.67646635F, 0.106513165F,
    0.1592602F, -0.5251012F, 0.31719157F, -0.81103426F, -0.44494414F, -0.6000012F, -0.73515457F, 0.8745079F,
    0.38700593F, 0.3732911F, 0.3893131F, -0.11381062F, 0.02544961F, 0.34268242F, -0.7379822F, 0.7455614F,
    -0.74255663F, -0.056971397F, -0.680662F, 0.08887337F, -0.62944925F,
};
static const uint32_t half_f32_check_first[37] = {
    0x3EDBBB13U, 0x3E138A8DU, 0x3D935B2AU, 0xBD09DB9EU, 0x3EC8F736U, 0xBF6C3996U, 0xBE7F6CC7U, 0x3F6E5015U,
    0xBEAAA476U, 0x3EA062C2U, 0xBF821122U, 0x3EFC5BE6U, 0xBE9C6F14U, 0x3F0D3CABU, 0x3F002C39U, 0xBE8A4125U,
    0x3B127591U, 0xBF2C5179U, 0x3F045AABU, 0xBF71D014U, 0xBD9BCE42U, 0xBE9906BEU, 0xBEB12E7BU, 0x3FAE6648U,
    0x3DDA910EU, 0x3E220215U, 0x3E217928U, 0xBEBE4218U, 0x3B5271D2U, 0x3E9A9877U, 0xBF6EB003U, 0x3F871CB6U,
    0xBF8740D4U, 0x3E7A1FD0U, 0xBF182591U, 0x3EEB9F81U, 0xBF129810U,
};
static const uint32_t half_f32_check_last[37] = {
    0x3F4963E5U, 0x3E80EC05U, 0x3E079876U, 0x3BEA76FAU, 0x3ED86B46U, 0xBF663212U, 0xBE6BE094U, 0x3F726459U,
    0xBEA3BD42U, 0x3EA66400U, 0xBF80C29EU, 0x3F007E4CU, 0xBE98548AU, 0x3F0F165AU, 0x3F01D5DAU, 0xBE873349U,
    0x3BFDBA23U, 0xBF2B028BU, 0x3F059242U, 0xBF70AA77U, 0xBD93595CU, 0xBE97115CU, 0xBEAF4E6BU, 0x3FAED74BU,
    0x3DE150C2U, 0x3E251F97U, 0x3E2471ADU, 0xBEBCDC6DU, 0x3BBFA681U, 0x3E9BEB00U, 0xBF6E0D7FU, 0x3F876B12U,
    0xBF86F764U, 0x3E7C5BF3U, 0xBF17A15AU, 0x3EEC97CDU, 0xBF122499U,
};

/**
 * Runs 481 samples through the instance, which is initialised before and after, and compares every output with
 * those of the kernel that this header was made from.
 * Returns 0 when all bits are the same, else the number of the first sample that is known to differ, from 1.
 */
static inline uint32_t half_self_check_f32(half_f32_instance *S)
{
    uint64_t hash = UINT64_C(0xCBF29CE484222325); /* FNV-1a of all outputs, the lowest byte first */
    uint32_t wrong = 0U;
    uint32_t k;
    half_init_f32(S);
    for (k = 0U; k < 481U; ++k) {
        const float output = half_step_f32(S, half_f32_check_input[k % 37U]);
        uint32_t bits;
        unsigned int byte;
        memcpy(&bits, &output, sizeof bits);
        for (byte = 0U; byte < sizeof bits; ++byte) {
            hash = (hash ^ ((bits >> (8U * byte)) & 0xFFU)) * UINT64_C(0x100000001B3);
        }
        if (wrong == 0U && ((k < 37U && bits != half_f32_check_first[k]) ||
                            (k >= 444U && bits != half_f32_check_last[k - 444U]))) {
            wrong = k + 1U;
        }
    }
    half_init_f32(S);
    return wrong != 0U ? wrong : hash == UINT64_C(0x09E7BE10814673EC) ? 0U : 481U;
}

#endif /* HALF_F32_H */
