// The instructions of the Armv7E-M DSP extension that kernels use, with the same result in portable C++ elsewhere.
#pragma once

#include <stdint.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__ARM_ARCH_7EM__) && defined(__GNUC__) && !defined(__PIC__)
/// Where there are loops in the order that a Cortex-M7 or Cortex-M4 loses least in: the same sums, bit by bit.
#define GLSUM_M7
#include "glsum/window/cortex-m/dot_words.h"
#if defined(__ARM_FP) && (__ARM_FP & 4)
/// And a unit for single precision, which some have not.
#define GLSUM_M7_FLOATS
#include "glsum/window/cortex-m/dot_floats.h"
#include "glsum/window/cortex-m/horner_floats.h"
#endif
#endif

namespace glsum::dsp {

#if defined(GLSUM_M7)
GLSUM_DOT_WORDS(dot_smlal, "smlal")
GLSUM_DOT_WORDS(dot_smlald, "smlald")
#endif
#if defined(GLSUM_M7_FLOATS)
GLSUM_DOT_FLOATS(dot_floats)
GLSUM_HORNER_FLOATS(horner_floats)
#endif

/// Two 16-bit numbers as one word; the lower address in the lower half (little-endian).
[[nodiscard]] inline std::int32_t load_pair(const std::int16_t* pair) {
    std::int32_t word;
    std::memcpy(&word, pair, sizeof word);
    return word;
}

/// sum + low(a) low(b) + high(a) high(b), in 64 bits.
[[nodiscard]] inline std::int64_t smlald(std::int32_t a, std::int32_t b, std::int64_t sum) {
#if defined(__ARM_FEATURE_DSP)
    return __builtin_arm_smlald(a, b, sum);
#else
    // C99: two products
    const std::int32_t low = static_cast<std::int16_t>(a) * static_cast<std::int16_t>(b);
    const std::int32_t high = (a >> 16) * (b >> 16);
    return sum + low + high;
    // C99 end
#endif
}

/// The same in 32 bits. The sum must not overflow.
[[nodiscard]] inline std::int32_t smlad(std::int32_t a, std::int32_t b, std::int32_t sum) {
#if defined(__ARM_FEATURE_DSP)
    return __builtin_arm_smlad(a, b, sum);
#else
    const std::int32_t low = static_cast<std::int16_t>(a) * static_cast<std::int16_t>(b);
    const std::int32_t high = (a >> 16) * (b >> 16);
    return sum + low + high;
#endif
}

}  // namespace glsum::dsp
