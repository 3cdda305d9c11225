// The contract of a technique: how the products a_j x_(k-j), j >= 1, are summed.
//
//   word                              its word in kernel names
//   summary                           how it sums, in the words of a generated header's comment; with it a header holds
//                                     its texts "// C99: WORD", "WORD newer", "WORD older" and "WORD closing" as they
//                                     stand there, and bench/generate need not know it
//   text                              the name of its text for generated headers (NAME.h.in), where it is not its word
//   constants(table, past, says)      what a generated header knows of its table: says(name, number), and of the items
//   of
//                                     a list says(list, index, name, number)
//   fused                             whether product and addition are rounded once
//   unfused_word                      of such a one (Fused): the word of the same order with both rounded
//   host_only                         whether it needs the host's vector unit
//   contiguous_only                   whether it needs a history that gives one contiguous piece
//   horner_form                       whether its coefficients are factors, each of all that is older
//   table_count<Format>(past)         coefficients it keeps for `past` past samples
//   held<Format>(past)                samples that the history holds for it; those beyond `past` meet zeros
//   beside<Format>                    samples that it keeps beside the window
//   placed(memory)                    where its table begins in the memory that it is given
//   fill<Format>(table, past, design, scale)
//   choose_scale<Format>(design, scale)
//   sum<Format>(table, window, x_k, scale)            -> the accumulator, or, where it also keeps the past,
//   sum_and_push<Format>(table, samples, past, x_k, scale)
//   sum_beside<Format>(table, window, x_k, samples)      and where it keeps some beside the window
//   coefficient_roundings(j)          how many rounded coefficients are factors of the term of a_j
//   sum_roundings<Format>(j, taps)    in floating point: how many rounded operations that term passes
//
//   fixed_error<Format>(design, scale, peak)          in fixed point: what coefficients and steps lose
//
// The last three give the error bound of every kernel (bound.hpp).
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/c99.hpp"
#include "glsum/kernel.hpp"
#include "glsum/power_of_two.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// What most techniques share: the table a_1 ... a_past, in this order, and 64-bit sums in fixed point.
struct WeightTable {
    static constexpr bool fused = false;
    static constexpr bool host_only = false;
    static constexpr bool contiguous_only = false;
    static constexpr bool horner_form = false;

    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past;
    }
    template <class Format>
    static constexpr std::size_t held(std::size_t past) {
        return past;
    }
    template <class Format>
    static constexpr std::size_t beside = 0;
    template <class T>
    static T* placed(T* memory) {
        return memory;
    }

    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        Weights weights(design);
        for (std::size_t i = 0; i < past; ++i) {
            weights.next();
            table[i] = Format::coefficient(weights.weight(), scale);
        }
    }

    template <class Format>
    static Status choose_scale(const Design& design, typename Format::Scale& scale) {
        return Format::template choose_scale<64>(design, scale);
    }

    static constexpr std::size_t coefficient_roundings(std::size_t j) { return j == 0 ? 0 : 1; }

    /// Half a unit of the table for each coefficient; the sum is exact.
    template <class Format>
    static double fixed_error(const Design& design, const typename Format::Scale& scale, double peak) {
        return static_cast<double>(design.taps - 1) * peak *
               power_of_two(scale.table_exponent - Format::coefficient_bits - 1);
    }
};

/// `Unfused` with product and addition rounded once: its order of summation, and so its text.
template <class Unfused>
struct Fused : Unfused {
    static constexpr bool fused = true;
    static constexpr std::string_view unfused_word = Unfused::word;
};

/// The word under which a technique's texts stand.
template <class Technique>
[[nodiscard]] constexpr std::string_view unfused_word_of() {
    if constexpr (Technique::fused) {
        return Technique::unfused_word;
    } else {
        return Technique::word;
    }
}

/// The step sum + a x of a technique, by product and addition or fused.
template <class Format, bool fused>
inline typename Format::Accumulator accumulate(typename Format::Accumulator sum, typename Format::Coefficient a,
                                               typename Format::Sample x) {
    if constexpr (fused) {
        return Format::fused_multiply_add(sum, a, x);
    } else {
        return Format::multiply_add(sum, a, x);
    }
}

}  // namespace glsum

// On x86 the fused instruction is chosen when the program is loaded; without it the same bits come from the C library.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GLSUM_FUSED_CLONES [[gnu::target_clones("default", "fma")]]
#else
#define GLSUM_FUSED_CLONES
#endif
