// The fixed-point formats q31, q15 and q15c31 (q15 samples, coefficients of 31 bits).
//
// Sample: a fraction in [-1, 1) of n = 31 or 15 bits. Coefficient: a_j 2^-s, rounded to nearest, as a fraction of m
// bits; a_0 = 1, which no fraction holds, is added apart and is exact. Sum: exact, in 64 bits (32 for smlad); products
// are not shortened. s is the smallest scale at which neither a coefficient nor the sum can overflow, whatever the
// samples; that follows from sum |a_j|, not from the length: in 64 bits s = 0 for 0 < v <= 1, 1 for 1 < v <= 2, and
// growing with the length only for v < 0. The Horner form rounds at each step. Output: 32 bits with e integer bits, S_k
// = output 2^(e-31), rounded to nearest, halves up. e is the smallest number of integer bits that holds sum |a_j| (1
// for 0 < v <= 1, 2 for 1 < v <= 2). q15 kernels give 32 bits too: the sum has them, and the factor h^-v, still to
// come, would magnify what 16 bits drop. Overflow: none in the sum; the output saturates, and counts it in
// `Scale::saturations`. With this e only a sum within half a unit of 2^e can reach it. Error: |S - exact| <= what the
// technique's coefficients and steps lose (its `fixed_error`; (L-1) 2^(s-m-1) peak for a table that is rounded to
// nearest) + 2^-(n+1) sum|a_j| (input) + 2^(e-32) (output). No rounding depends on the order of summation, so every
// technique but the Horner form gives the same bits from the same table.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "glsum/kernel.hpp"
#include "glsum/power_of_two.hpp"
#include "glsum/weights.hpp"

namespace glsum {

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

/// A number of 32 bits, and whether it stands for one that these cannot hold.
struct Rounded {
    std::int32_t value;
    bool saturated;
};
[[nodiscard]] constexpr Rounded saturate(std::int64_t value) {
    // C99: saturate
    const std::int32_t narrow = static_cast<std::int32_t>(value);
    if (narrow != value) {
        const Rounded limit = {value < 0 ? INT32_MIN : INT32_MAX, true};
        return limit;
    }
    const Rounded held = {narrow, false};
    return held;
    // C99 end
}

/// sum 2^-shift to nearest, halves up, saturated to 32 bits; a negative shift multiplies.
[[nodiscard]] constexpr Rounded round_shift(std::int64_t sum, int shift) {
    // C99: round shift
    std::int64_t value = sum;
    if (shift == 32) {
        // The common case of q31: the upper word and the bit below it.
        value = static_cast<std::int32_t>(sum >> 32) + static_cast<std::int64_t>(static_cast<std::uint32_t>(sum) >> 31);
    } else if (shift > 0) {
        // Not (sum + half) >> shift: sum + half may leave the 64 bits.
        value = ((sum >> (shift - 1)) + 1) >> 1;
    } else if (shift < 0) {
        const std::int64_t limit = static_cast<std::int64_t>(INT32_MAX) >> -shift;
        value = sum > limit        ? static_cast<std::int64_t>(INT32_MAX) + 1
                : sum < -limit - 1 ? static_cast<std::int64_t>(INT32_MIN) - 1
                                   : sum * (static_cast<std::int64_t>(1) << -shift);
    }
    // C99 end
    return saturate(value);
}

template <class SampleInteger, class CoefficientInteger = SampleInteger>
struct Fixed {
    using Sample = SampleInteger;
    using Coefficient = CoefficientInteger;
    using Accumulator = std::int64_t;
    using Output = std::int32_t;

    static constexpr bool fixed_point = true;
    static constexpr int sample_bits = std::numeric_limits<Sample>::digits;
    static constexpr int coefficient_bits = std::numeric_limits<Coefficient>::digits;

    struct Scale {
        std::int8_t table_exponent = 0;   ///< s: the table holds a_j 2^-s
        std::int8_t output_exponent = 0;  ///< e: S_k = output 2^(e-31)
        std::int8_t output_shift = 0;     ///< output = sum 2^-output_shift
        std::uint32_t saturations = 0;    ///< outputs that saturated since `reset`
    };

    /// The scale for a table of weights and sums of `accumulator_bits`.
    template <int accumulator_bits>
    static Status choose_scale(const Design& design, Scale& scale) {
        const auto for_each_weight = [&](auto visit) {
            Weights weights(design);
            for (std::size_t j = 1; j < design.taps; ++j) {
                weights.next();
                visit(weights.weight());
            }
        };
        return choose_scale_of<accumulator_bits>(for_each_weight, scale);
    }

    /// The same for any table: `for_each(visit)` calls visit(real) for each coefficient beside a_0.
    template <int accumulator_bits, class ForEach>
    static Status choose_scale_of(const ForEach& for_each, Scale& scale) {
        scale = {};
        // The sum of products has sample_bits + coefficient_bits of fraction: it may reach 2^(s + guard_bits).
        constexpr int guard_bits = accumulator_bits - 1 - sample_bits - coefficient_bits;
        double largest = 0.0;
        double absolute = 1.0;
        for_each([&](double real) {
            largest = std::max(largest, magnitude(real));
            absolute += magnitude(real);
        });
        // In reals first, which may be one too small by the rounding of the coefficients; then exactly.
        int exponent = 0;
        while (exponent <= coefficient_bits &&
               (largest > power_of_two(exponent) || absolute > power_of_two(exponent + guard_bits))) {
            ++exponent;
        }
        std::int64_t table_sum = 0;
        for (; exponent <= coefficient_bits; ++exponent) {
            scale.table_exponent = static_cast<std::int8_t>(exponent);
            if (table_fits(for_each, scale, coefficient_bits + guard_bits, table_sum)) {
                break;
            }
        }
        if (exponent > coefficient_bits) {
            return Status::format_too_narrow;
        }
        while ((std::int64_t{1} << (coefficient_bits - exponent + scale.output_exponent)) < table_sum) {
            ++scale.output_exponent;
        }
        scale.output_shift =
            static_cast<std::int8_t>(sample_bits + coefficient_bits - exponent - 31 + scale.output_exponent);
        return Status::ok;
    }

    /// The scale for a table of the factors c_j. The Horner forms have 31 bits of fraction in 64: they stay below
    /// taps^2 for every order, so that lengths to 40 000 cannot overflow.
    static Status choose_horner_scale(const Design& design, Scale& scale) {
        static_assert(sample_bits == 31 && coefficient_bits == 31);
        scale = {};
        if (design.taps > 40000) {
            return Status::format_too_narrow;
        }
        Weights weights(design);
        for (std::size_t j = 1; j < design.taps; ++j) {
            weights.next();
            // -1 fits, +1 does not.
            const bool fits = weights.factor() >= -1.0 && weights.factor() < 1.0 - power_of_two(-32);
            scale.table_exponent = fits ? scale.table_exponent : std::int8_t{1};
        }
        const double absolute = absolute_sum(design, design.taps);
        while (power_of_two(scale.output_exponent) * (1.0 + 1e-12) < absolute) {
            ++scale.output_exponent;
        }
        scale.output_shift = scale.output_exponent;
        return Status::ok;
    }

    static Coefficient coefficient(double real, const Scale& scale) {
        return round_to_integer<Coefficient>(real * power_of_two(coefficient_bits - scale.table_exponent));
    }

    static Accumulator start(Sample sample, const Scale& scale) {
        if constexpr (sample_bits + coefficient_bits < 31) {  // 32 bits hold it
            return static_cast<std::int32_t>(sample) * (std::int32_t{1} << (coefficient_bits - scale.table_exponent));
        }
        const int shift = coefficient_bits - scale.table_exponent;
        // C99: start fixed
        // By a product of 32 bits, which -2^31 fits and 2^31 does not: a shift of 64 bits takes ten instructions.
        const std::int32_t minus_one = static_cast<std::int32_t>(0U - (static_cast<std::uint32_t>(1) << shift));
        return -(static_cast<std::int64_t>(sample) * minus_one);
        // C99 end
    }
    static Accumulator zero() { return 0; }
    static Accumulator multiply_add(Accumulator sum, Coefficient a, Sample x) {
        // C99: multiply_add fixed
        return sum + static_cast<std::int64_t>(a) * x;
        // C99 end
    }
    /// x + c inner, rounded to nearest, halves up; inner has 31 bits of fraction.
    template <bool fuse>
    static Accumulator horner_step(Sample x, Coefficient c, Accumulator inner, const Scale& scale) {
        static_assert(!fuse, "fixed point has no fused form");
        const int shift = coefficient_bits - scale.table_exponent;
        // C99: horner step fixed
        // 64 by 32 bits in two products; the upper one is a whole number of units and needs no rounding.
        const std::int64_t upper = static_cast<std::int64_t>(static_cast<std::int32_t>(inner >> 32)) * c;
        const std::int64_t lower = static_cast<std::int64_t>(static_cast<std::uint32_t>(inner)) * c;
        const std::int64_t half = static_cast<std::int64_t>(1) << (shift - 1);
        return x + upper * (static_cast<std::int64_t>(1) << (32 - shift)) + ((lower + half) >> shift);
        // C99 end
    }
    static Output finish(Accumulator sum, Scale& scale) {
        // The shift of orders in (0, 2], one comparison away.
        constexpr int usual = sample_bits + coefficient_bits - 30;
        const Rounded rounded =
            scale.output_shift == usual ? round_shift(sum, usual) : round_shift(sum, scale.output_shift);
        // C99: finish fixed
        if (rounded.saturated) [[unlikely]] {  // else the count would be loaded and stored at each step
            ++scale.saturations;
        }
        return rounded.value;
        // C99 end
    }

    static Sample from_real(double real) { return round_to_integer<Sample>(real * power_of_two(sample_bits)); }
    static double to_real(Output output, const Scale& scale) {
        return output * power_of_two(scale.output_exponent - 31);
    }

private:
    static constexpr double magnitude(double real) { return real < 0.0 ? -real : real; }

    // Whether the rounded table at this scale overflows neither a coefficient nor, for any samples, the sum.
    // table_sum: the sum of the magnitudes, a_0 included, in units of the table; it may reach 2^limit_bits.
    template <class ForEach>
    static bool table_fits(const ForEach& for_each, const Scale& scale, int limit_bits, std::int64_t& table_sum) {
        const double unit = power_of_two(coefficient_bits - scale.table_exponent);
        table_sum = std::int64_t{1} << (coefficient_bits - scale.table_exponent);
        bool saturated = false;  // +1 does not fit, -1 does
        for_each([&](double real) {
            const Coefficient rounded = coefficient(real, scale);
            saturated = saturated || magnitude(real * unit - static_cast<double>(rounded)) > 0.5;
            table_sum += rounded < 0 ? -static_cast<std::int64_t>(rounded) : static_cast<std::int64_t>(rounded);
        });
        // <=: the sum reaches its bound only if every product is positive, and +1 is no sample, so x_k = 1 is not.
        return !saturated && table_sum <= std::int64_t{1} << limit_bits;
    }
};

struct Q31 : Fixed<std::int32_t> {
    static constexpr std::string_view word = "q31";
};
struct Q15 : Fixed<std::int16_t> {
    static constexpr std::string_view word = "q15";
};
struct Q15C31 : Fixed<std::int16_t, std::int32_t> {
    static constexpr std::string_view word = "q15c31";
};

}  // namespace glsum
