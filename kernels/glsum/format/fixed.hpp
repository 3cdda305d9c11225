// The fixed-point formats q31 and q15.
//
// Sample: a fraction in [-1, 1) of 31 or 15 bits. Coefficient: a_j 2^-s, rounded to nearest, as a fraction of as
// many bits; a_0 = 1, which no fraction holds, is added apart and is exact.
// Sum: exact, in 64 bits; products are not shortened. s is the smallest scale at which neither a coefficient nor
// the sum can overflow, whatever the samples; that follows from sum |a_j|, not from the length: s = 0 for
// 0 < v <= 1, 1 for 1 < v <= 2, and growing with the length only for v < 0.
// Output: 32 bits with e integer bits, S_k = output 2^(e-31), rounded to nearest, halves up. e is the smallest
// number of integer bits that holds sum |a_j| (1 for 0 < v <= 1, 2 for 1 < v <= 2). q15 kernels give 32 bits too:
// the sum has them, and the factor h^-v, still to come, would magnify what 16 bits drop.
// Overflow: none in the sum; the output saturates, and counts it in `Scale::saturations`. With this e only
// a sum within half a unit of 2^e can reach it.
// Error: |S - exact| <= (L-1) 2^(s-n-1) peak + 2^-(n+1) sum|a_j| + 2^(e-32), n = 31 or 15: coefficients, input,
// output. No rounding depends on the order of summation, so every technique gives the same bits.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// 2^exponent, exactly, without the mathematical library; exponent in [-1022, 1023].
[[nodiscard]] constexpr double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

/// Rounds to nearest, halves away from zero, and saturates. NaN gives the most negative value.
template <class Integer>
[[nodiscard]] constexpr Integer round_to_integer(double real) {
    constexpr double lowest = std::numeric_limits<Integer>::min();
    constexpr double highest = std::numeric_limits<Integer>::max();
    const double rounded = real < 0.0 ? real - 0.5 : real + 0.5;
    if (!(rounded > lowest)) {
        return std::numeric_limits<Integer>::min();
    }
    return rounded >= highest ? std::numeric_limits<Integer>::max() : static_cast<Integer>(rounded);
}

/// sum 2^-shift to nearest, halves up, saturated to 32 bits; a negative shift multiplies.
/// \return the output, and whether it saturated.
struct Rounded {
    std::int32_t value;
    bool saturated;
};
[[nodiscard]] constexpr Rounded round_shift(std::int64_t sum, int shift) {
    constexpr std::int64_t lowest = std::numeric_limits<std::int32_t>::min();
    constexpr std::int64_t highest = std::numeric_limits<std::int32_t>::max();
    std::int64_t value = sum;
    if (shift > 0) {
        // Not (sum + half) >> shift: sum + half may leave the 64 bits.
        value = ((sum >> (shift - 1)) + 1) >> 1;
    } else if (shift < 0) {
        const std::int64_t limit = highest >> -shift;
        value = sum > limit ? highest + 1 : sum < -limit - 1 ? lowest - 1 : sum * (std::int64_t{1} << -shift);
    }
    if (value > highest) {
        return {static_cast<std::int32_t>(highest), true};
    }
    if (value < lowest) {
        return {static_cast<std::int32_t>(lowest), true};
    }
    return {static_cast<std::int32_t>(value), false};
}

template <class Integer>
struct Fixed {
    using Sample = Integer;
    using Coefficient = Integer;
    using Accumulator = std::int64_t;
    using Output = std::int32_t;

    static constexpr bool fixed_point = true;
    static constexpr int fraction_bits = std::numeric_limits<Integer>::digits;

    struct Scale {
        std::int8_t table_exponent = 0;   ///< s: the table holds a_j 2^-s
        std::int8_t output_exponent = 0;  ///< e: S_k = output 2^(e-31)
        std::uint32_t saturations = 0;    ///< outputs that saturated since `reset`
    };

    static Status choose_scale(const Design& design, Scale& scale) {
        scale = {};
        // The estimate in reals may be one too small, by the rounding of the coefficients; never more.
        Weights weights(design.order);
        double largest = 0.0;
        double absolute = 1.0;
        for (std::size_t j = 1; j < design.taps; ++j) {
            weights.next();
            const double magnitude = weights.weight() < 0.0 ? -weights.weight() : weights.weight();
            largest = magnitude > largest ? magnitude : largest;
            absolute += magnitude;
        }
        int exponent = 0;
        while (exponent <= fraction_bits &&
               (largest > power_of_two(exponent) || absolute > power_of_two(exponent + guard_bits))) {
            ++exponent;
        }
        std::int64_t table_sum = 0;
        for (; exponent <= fraction_bits; ++exponent) {
            scale.table_exponent = static_cast<std::int8_t>(exponent);
            if (table_fits(design, scale, table_sum)) {
                break;
            }
        }
        if (exponent > fraction_bits) {
            return Status::format_too_narrow;
        }
        while ((std::int64_t{1} << (fraction_bits - exponent + scale.output_exponent)) < table_sum) {
            ++scale.output_exponent;
        }
        return Status::ok;
    }

    static Coefficient coefficient(double real, const Scale& scale) {
        return round_to_integer<Coefficient>(real * power_of_two(fraction_bits - scale.table_exponent));
    }

    static Accumulator start(Sample sample, const Scale& scale) {
        return static_cast<std::int64_t>(sample) * (std::int64_t{1} << (fraction_bits - scale.table_exponent));
    }
    static Accumulator zero() { return 0; }
    static Accumulator multiply_add(Accumulator sum, Coefficient a, Sample x) {
        return sum + static_cast<std::int64_t>(a) * x;
    }
    static Output finish(Accumulator sum, Scale& scale) {
        const Rounded rounded = round_shift(sum, 2 * fraction_bits - scale.table_exponent - 31 + scale.output_exponent);
        scale.saturations += rounded.saturated ? 1U : 0U;
        return rounded.value;
    }

    static Sample from_real(double real) { return round_to_integer<Sample>(real * power_of_two(fraction_bits)); }
    static double to_real(Output output, const Scale& scale) {
        return output * power_of_two(scale.output_exponent - 31);
    }

private:
    // The sum of products has 2 fraction_bits of fraction in 63 bits: it may reach 2^guard_bits.
    static constexpr int guard_bits = 63 - 2 * fraction_bits;

    // Whether the rounded table at this scale overflows neither a coefficient nor, for any samples, the sum.
    // table_sum: the sum of the magnitudes, a_0 included, in units of the table.
    static bool table_fits(const Design& design, const Scale& scale, std::int64_t& table_sum) {
        const double unit = power_of_two(fraction_bits - scale.table_exponent);
        table_sum = std::int64_t{1} << (fraction_bits - scale.table_exponent);
        Weights weights(design.order);
        for (std::size_t j = 1; j < design.taps; ++j) {
            weights.next();
            const double scaled = weights.weight() * unit;
            const Coefficient rounded = coefficient(weights.weight(), scale);
            const double excess = scaled - static_cast<double>(rounded);
            if (excess > 0.5 || excess < -0.5) {
                return false;  // it saturated: +1 does not fit, -1 does
            }
            table_sum += rounded < 0 ? -static_cast<std::int64_t>(rounded) : static_cast<std::int64_t>(rounded);
        }
        // <=: the sum reaches its bound only if every product is positive, and +1 is no sample, so x_k = 1 is not.
        return table_sum <= std::int64_t{1} << (63 - fraction_bits);
    }
};

struct Q31 : Fixed<std::int32_t> {
    static constexpr std::string_view word = "q31";
};
struct Q15 : Fixed<std::int16_t> {
    static constexpr std::string_view word = "q15";
};

}  // namespace glsum
