// fir, firfma: newest first, one accumulator, and each sample is stored one place on in the same pass; only with the
// history `shift`. The loop of FIR libraries that work sample by sample. firfma rounds product and addition once.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/window/technique.hpp"

namespace glsum {

struct Fir : WeightTable {
    static constexpr std::string_view word = "fir";

    template <class Format>
    static typename Format::Accumulator sum_and_push(const typename Format::Coefficient* table,
                                                     typename Format::Sample* samples, std::size_t past,
                                                     typename Format::Sample newest,
                                                     const typename Format::Scale& scale) {
        return one_pass<Format, false>(table, samples, past, newest, scale);
    }

    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        return j == 0 ? taps - 1 : taps - j + 1;
    }

protected:
    template <class Format, bool fused>
    [[gnu::always_inline]] static inline typename Format::Accumulator one_pass(
        const typename Format::Coefficient* table, typename Format::Sample* samples, std::size_t past,
        typename Format::Sample newest, const typename Format::Scale& scale) {
        using Sample = typename Format::Sample;
        using Accumulator = typename Format::Accumulator;
        // C99: fir
        Accumulator sum = Format::start(newest, scale);
        Sample moving = newest;
        for (std::size_t i = 0; i < past; ++i) {
            const Sample sample = samples[i];
            sum = accumulate<Format, fused>(sum, table[i], sample);
            samples[i] = moving;
            moving = sample;
        }
        // C99 end
        return sum;
    }
};

struct FirFma : Fused<Fir> {
    static constexpr std::string_view word = "firfma";

    template <class Format>
    GLSUM_FUSED_CLONES static typename Format::Accumulator sum_and_push(const typename Format::Coefficient* table,
                                                                        typename Format::Sample* samples,
                                                                        std::size_t past,
                                                                        typename Format::Sample newest,
                                                                        const typename Format::Scale& scale) {
        return one_pass<Format, true>(table, samples, past, newest, scale);
    }

    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        return j == 0 ? taps - 1 : taps - j;
    }
};

}  // namespace glsum
