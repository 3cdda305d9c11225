// fir, firfma: newest first, one accumulator, and each sample is stored one place on in the same pass; only with the
// history `shift`. The loop of FIR libraries that work sample by sample.
// firfma rounds product and sum once, where fir rounds twice.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/technique/technique.hpp"

// On x86 the fused instruction is chosen at load time; without it the same bits come from the C library.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GLSUM_FUSED_CLONES [[gnu::target_clones("default", "fma")]]
#else
#define GLSUM_FUSED_CLONES
#endif

namespace glsum {

struct Fir : WeightTable {
    static constexpr std::string_view word = "fir";
    static constexpr bool host_only = false;

    template <class Format>
    static typename Format::Accumulator sum_and_push(const typename Format::Coefficient* table,
                                                     typename Format::Sample* samples, std::size_t past,
                                                     typename Format::Sample newest,
                                                     const typename Format::Scale& scale) {
        auto sum = Format::start(newest, scale);
        auto moving = newest;
        for (std::size_t i = 0; i < past; ++i) {
            const auto sample = samples[i];
            sum = Format::multiply_add(sum, table[i], sample);
            samples[i] = moving;
            moving = sample;
        }
        return sum;
    }

    template <class Format>
    static constexpr std::size_t roundings(std::size_t j, std::size_t taps) {
        return j == 0 ? taps - 1 : taps - j + 2;
    }
};

struct FirFma : WeightTable {
    static constexpr std::string_view word = "firfma";
    static constexpr bool host_only = false;

    template <class Format>
    GLSUM_FUSED_CLONES static typename Format::Accumulator sum_and_push(const typename Format::Coefficient* table,
                                                                        typename Format::Sample* samples,
                                                                        std::size_t past,
                                                                        typename Format::Sample newest,
                                                                        const typename Format::Scale& scale) {
        auto sum = Format::start(newest, scale);
        auto moving = newest;
        for (std::size_t i = 0; i < past; ++i) {
            const auto sample = samples[i];
            sum = Format::fused_multiply_add(sum, table[i], sample);
            samples[i] = moving;
            moving = sample;
        }
        return sum;
    }

    template <class Format>
    static constexpr std::size_t roundings(std::size_t j, std::size_t taps) {
        return j == 0 ? taps - 1 : taps - j + 1;
    }
};

}  // namespace glsum
