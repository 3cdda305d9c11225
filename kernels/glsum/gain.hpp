// The factor h^-v that makes a derivative of the sum, in fixed point: applied after the sum, as mantissa and exponent.
// No fraction holds it: 31.6 at v = 0.5, 939 000 at v = 1.9909 for h = 1 ms.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "glsum/format/fixed.hpp"

namespace glsum {

/// factor = mantissa 2^(exponent - 30), mantissa in [2^30, 2^31): a relative error of 2^-31 at most.
struct Gain {
    std::int32_t mantissa;
    int exponent;
};

/// \param factor  a normal number above 0
[[nodiscard]] constexpr Gain make_gain(double factor) {
    const auto bits = std::bit_cast<std::uint64_t>(factor);
    int exponent = static_cast<int>(bits >> 52) - 1023;
    // The 52 stored bits and the hidden one, rounded to 31 bits in all.
    const std::uint64_t significand = (bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52);
    std::uint64_t mantissa = ((significand >> 21) + 1) >> 1;
    if (mantissa == std::uint64_t{1} << 31) {
        mantissa >>= 1;
        ++exponent;
    }
    return {static_cast<std::int32_t>(mantissa), exponent};
}

/// h^-v. Two C libraries may differ in its last bit: compute it once, for host and target alike, where bits matter.
[[nodiscard]] inline double step_factor(double order, double step_s) { return std::pow(step_s, -order); }

/// What brings a number of `output_exponent` integer bits, times the gain's mantissa, to 32 bits of `result_exponent`.
[[nodiscard]] constexpr int gain_shift(const Gain& gain, int output_exponent, int result_exponent) {
    // 2^(e-31) 2^(g-30) product = 2^(E-31) result
    const int shift = 30 - gain.exponent - output_exponent + result_exponent;
    // 62 bits: a shift by more leaves nothing, a shift up by more than 62 saturates whatever is not zero.
    return shift > 63 ? 63 : shift < -62 ? -62 : shift;
}

/// A kernel's output times the gain, as 32 bits with `result_exponent` integer bits, to nearest, halves up, saturated.
/// \param output_exponent  the kernel's `Scale::output_exponent`
[[nodiscard]] constexpr Rounded apply_gain(std::int32_t output, int output_exponent, const Gain& gain,
                                           int result_exponent) {
    const std::int64_t product = static_cast<std::int64_t>(output) * gain.mantissa;
    return round_shift(product, gain_shift(gain, output_exponent, result_exponent));
}

}  // namespace glsum
