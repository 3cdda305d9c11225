// smlald: q15 only. Two products a time into a 64-bit sum (the SMLALD instruction), over words of two samples.
// The window moves by one sample a step, so every second window would begin in the middle of a word, and an unaligned
// load costs a Cortex-M7 3 to 4 cycles more [jnk0le]. Two tables therefore: one for a window that begins a word, one,
// with a zero before it, for a window that begins in the middle of one and is read from the word's beginning.
// Needs a contiguous window whose buffer begins at a multiple of four bytes (elsewhere right, but slower).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "glsum/dsp.hpp"
#include "glsum/history/window.hpp"
#include "glsum/technique/technique.hpp"

namespace glsum {

struct Smlald {
    static constexpr std::string_view word = "smlald";
    static constexpr bool host_only = false;

    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return 2 * (aligned_words(past) + shifted_words(past));
    }
    template <class Format>
    static constexpr std::size_t overread = 0;  // the last word ends inside the mirrored copy

    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, double order,
                     const typename Format::Scale& scale) {
        for (std::size_t i = 0; i < table_count<Format>(past); ++i) {
            table[i] = 0;
        }
        auto* shifted = table + 2 * aligned_words(past) + 1;
        Weights weights(order);
        for (std::size_t i = 0; i < past; ++i) {
            weights.next();
            table[i] = shifted[i] = Format::coefficient(weights.weight(), scale);
        }
    }

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        static_assert(sizeof(typename Format::Sample) == 2, "two samples a word");
        const std::size_t past = window.newer_count;
        const bool shifted = (window.first_index & 1U) != 0;
        const auto* coefficients = shifted ? table + 2 * aligned_words(past) : table;
        const auto* samples = shifted ? window.newer - 1 : window.newer;
        const std::size_t words = shifted ? shifted_words(past) : aligned_words(past);
        std::int64_t sum = Format::start(newest, scale);
        for (std::size_t i = 0; i < words; ++i) {
            sum = dsp::smlald(dsp::load_pair(coefficients + 2 * i), dsp::load_pair(samples + 2 * i), sum);
        }
        return sum;
    }

private:
    static constexpr std::size_t aligned_words(std::size_t past) { return (past + 1) / 2; }
    static constexpr std::size_t shifted_words(std::size_t past) { return past == 0 ? 0 : (past + 2) / 2; }
};

}  // namespace glsum
