// scaled: fixed point with short coefficients: the table in octaves, j in [2^b, 2^(b+1)), each scaled up by its own
// power of two, as far as its largest coefficient allows. Where q15 has no bits left for the far coefficients (beyond
// tap 34 at v = 0.98319 all are zero), each octave keeps 15. The sums of the octaves are joined by shifts, exactly.
// Needs a contiguous window.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct Scaled : WeightTable {
    static constexpr std::string_view word = "scaled";
    static constexpr bool contiguous_only = true;

    /// a_1 ... a_past, then the shift of each octave.
    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past + octaves(past);
    }

    template <class Format>
    static Status choose_scale(const Design& design, typename Format::Scale& scale) {
        const Status status = Format::template choose_scale<64>(design, scale);
        int shift = 0;
        for_each_octave<Format>(design.taps - 1, design, scale,
                                [&](std::size_t, std::size_t, std::size_t, int of_octave) { shift = of_octave; });
        scale.output_shift = static_cast<std::int8_t>(scale.output_shift + shift);
        return status;
    }

    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        using Coefficient = typename Format::Coefficient;
        Weights weights(design);
        for_each_octave<Format>(
            past, design, scale, [&](std::size_t octave, std::size_t from, std::size_t to, int shift) {
                table[past + octave] = static_cast<Coefficient>(shift);
                for (std::size_t j = from; j < to; ++j) {
                    weights.next();
                    table[j - 1] = Format::coefficient(weights.weight() * power_of_two(shift), scale);
                }
            });
    }

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        static_assert(Format::fixed_point);
        const std::size_t past = window.newer_count;
        auto sum = Format::start(newest, scale);
        std::size_t i = 0;
        int before = 0;
        for (std::size_t octave = 0; i < past; ++octave) {
            const int shift = table[past + octave];
            // C99: scaled up
            sum = sum * (static_cast<std::int64_t>(1) << (shift - before));
            // C99 end
            before = shift;
            const std::size_t end = end_of(octave, past) - 1;
            // C99: scaled octave
            for (; i < end; ++i) {
                sum = Format::multiply_add(sum, table[i], window.newer[i]);
            }
            // C99 end
        }
        return sum;
    }

    template <class Format>
    static double fixed_error(const Design& design, const typename Format::Scale& scale, double peak) {
        double units = 0.0;
        for_each_octave<Format>(design.taps - 1, design, scale,
                                [&](std::size_t, std::size_t from, std::size_t to, int shift) {
                                    units += static_cast<double>(to - from) * power_of_two(-shift);
                                });
        return units * peak * power_of_two(scale.table_exponent - Format::coefficient_bits - 1);
    }

    template <class Coefficient, class Says>
    static void constants(const Coefficient* table, std::size_t past, Says&& says) {
        int before = 0;
        for (std::size_t octave = 0; octave < octaves(past); ++octave) {
            const int shift = table[past + octave];
            says("octave", octave, "up", shift - before);
            says("octave", octave, "end", end_of(octave, past) - 1);
            before = shift;
        }
        says("coefficients", past);
    }

private:
    static constexpr std::size_t octaves(std::size_t past) { return static_cast<std::size_t>(std::bit_width(past)); }
    static constexpr std::size_t end_of(std::size_t octave, std::size_t past) {
        const std::size_t end = std::size_t{2} << octave;
        return end < past + 1 ? end : past + 1;
    }

    // Calls visit(octave, first j, j behind the last, shift). The shift leaves room for every later coefficient too, so
    // that shifts do not fall and the sum is only ever shifted up. At most 24, which with 30 bits of fraction and 9 of
    // sum stays within 63.
    template <class Format, class Visit>
    static void for_each_octave(std::size_t past, const Design& design, const typename Format::Scale& scale,
                                Visit visit) {
        double largest[octaves(std::numeric_limits<std::uint32_t>::max())] = {};  // from an octave on
        Weights weights(design);
        for (std::size_t octave = 0; octave < octaves(past); ++octave) {
            for (std::size_t j = weights.index() + 1; j < end_of(octave, past); ++j) {
                weights.next();
                const double magnitude = weights.weight() < 0.0 ? -weights.weight() : weights.weight();
                for (std::size_t before = 0; before <= octave; ++before) {
                    largest[before] = magnitude > largest[before] ? magnitude : largest[before];
                }
            }
        }
        // Just below 1, so that rounding cannot reach +1, which the format does not hold.
        const double limit = power_of_two(scale.table_exponent) * (1.0 - power_of_two(-Format::coefficient_bits));
        int shift = 0;
        for (std::size_t octave = 0; octave < octaves(past); ++octave) {
            while (shift < 24 && largest[octave] * power_of_two(shift + 1) < limit) {
                ++shift;
            }
            visit(octave, std::size_t{1} << octave, end_of(octave, past), shift);
        }
    }
};

}  // namespace glsum
