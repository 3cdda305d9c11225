// smlald, smlad and smlaldshaped: q15 only. Two products an instruction over words of two samples.
//   smlald        into 64 bits
//   smlad         into 32 bits: the table is scaled so that no sum can overflow them, which costs bits where sum |a_j|
//   > 2 smlaldshaped  as smlald, with a table whose rounding is shaped: each coefficient takes over what the ones
//   before it
//                 lost, so that every partial sum of the table is right to half a unit, and with it the gain for
//                 constant inputs at every length. A single coefficient may err by a whole unit.
// The window moves by one sample a step, so every second window would begin in the middle of a word, and an unaligned
// load costs a Cortex-M7 3 to 4 cycles more [jnk0le]. Two tables therefore: one for a window that begins a word, one,
// with a zero before it, for a window that begins in the middle of one and is read from the word's beginning.
// Needs a contiguous window whose buffer begins at a multiple of four bytes (elsewhere right, but slower).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "glsum/window/dsp.hpp"
#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

/// \tparam Sum     of the accumulator
/// \tparam shaped  whether the rounding of the table is
template <class Sum, bool shaped>
struct Paired : WeightTable {
    static constexpr std::string_view text = "paired";
    static constexpr bool contiguous_only = true;

    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return 2 * (aligned_words(past) + shifted_words(past));
    }

    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        for (std::size_t i = 0; i < table_count<Format>(past); ++i) {
            table[i] = 0;
        }
        auto* second = table + 2 * aligned_words(past) + 1;
        const double unit = power_of_two(scale.table_exponent - Format::coefficient_bits);
        double lost = 0.0;
        Weights weights(design);
        for (std::size_t i = 0; i < past; ++i) {
            weights.next();
            const double wanted = weights.weight() + lost;
            table[i] = second[i] = Format::coefficient(wanted, scale);
            lost = shaped ? wanted - unit * static_cast<double>(table[i]) : 0.0;
        }
    }

    template <class Format>
    static Status choose_scale(const Design& design, typename Format::Scale& scale) {
        return Format::template choose_scale<8 * sizeof(Sum)>(design, scale);
    }

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        static_assert(sizeof(typename Format::Sample) == 2 && sizeof(typename Format::Coefficient) == 2);
        using Sample = typename Format::Sample;
        using Coefficient = typename Format::Coefficient;
        const std::size_t past = window.newer_count;
        // C99: paired
        // Whether the window begins in the middle of a word: at every other step, so no branch.
        const std::size_t middle = window.first_index & 1U;
        const Coefficient* coefficients = table + middle * 2 * aligned_words(past);
        const Sample* samples = window.newer - middle;
        const std::size_t words = (past + 1 + middle) / 2;
        Sum sum = static_cast<Sum>(Format::start(newest, scale));
        // C99 end
#if defined(GLSUM_M7)
        if constexpr (sizeof(Sum) == 8) {
            // C99: paired on a Cortex-M7
            sum = dsp::dot_smlald_onto(sum, coefficients, samples, words);
            // C99 end
            return sum;
        }
#endif
        const auto multiply_add = [](std::int32_t a, std::int32_t x, Sum before) {
            if constexpr (sizeof(Sum) == 8) {
                return dsp::smlald(a, x, before);
            } else {
                return dsp::smlad(a, x, before);
            }
        };
        // C99: paired words
        for (std::size_t i = 0; i < words; ++i) {
            sum = multiply_add(dsp::load_pair(coefficients + 2 * i), dsp::load_pair(samples + 2 * i), sum);
        }
        // C99 end
        return sum;
    }

    template <class Format>
    static double fixed_error(const Design& design, const typename Format::Scale& scale, double peak) {
        return (shaped ? 2.0 : 1.0) * WeightTable::fixed_error<Format>(design, scale, peak);
    }

    template <class Coefficient, class Says>
    static void constants(const Coefficient*, std::size_t past, Says&& says) {
        says("aligned", aligned_words(past));
        says("shifted", shifted_words(past));
        says("bits", 8 * sizeof(Sum));
    }

private:
    static constexpr std::size_t aligned_words(std::size_t past) { return (past + 1) / 2; }
    static constexpr std::size_t shifted_words(std::size_t past) { return past == 0 ? 0 : (past + 2) / 2; }
};

struct Smlald : Paired<std::int64_t, false> {
    static constexpr std::string_view word = "smlald";
};
struct Smlad : Paired<std::int32_t, false> {
    static constexpr std::string_view word = "smlad";
};
struct SmlaldShaped : Paired<std::int64_t, true> {
    static constexpr std::string_view word = "smlaldshaped";
};

}  // namespace glsum
