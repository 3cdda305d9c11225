// Blocks of samples that begin anywhere, put together from whole lines of the processor's cache; for the sources that
// are compiled once for each instruction set.
//
// A vector across two lines takes two loads. Where a vector is a line, as AVX-512's, 15 windows of 16 begin within one,
// and all their vectors lie across two. So each line is loaded once, and each block taken from two of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "glsum/window/simd_accumulator.hpp"

namespace glsum {
// Internal to each source: two sets must not share a body.
namespace {

/// Whether a vector is a line.
template <class T, class Architecture>
inline constexpr bool loads_lines = xsimd::batch<T, Architecture>::size * sizeof(T) == 64;

/// So many times four blocks make up for the jump to one of 16 loops, which is often guessed wrong: some 800 samples of
/// 4 bytes, where both ways took the same on an Epyc of 2022.
inline constexpr std::size_t worth_lines = 12;

// The lanes from `ahead` on, and behind them the first ones of `behind`. Of a shuffle GCC 12 makes an instruction that
// reads the order from a register, and takes as long as the load that it saves.
template <std::size_t ahead, class T, class Architecture>
[[gnu::always_inline]] inline xsimd::batch<T, Architecture> across(
    [[maybe_unused]] const xsimd::batch<T, Architecture>& values,
    [[maybe_unused]] const xsimd::batch<T, Architecture>& behind) {
#if defined(__AVX512F__)
    // With a mask of all lanes: of the form without one GCC 12 warns that it reads what was never set.
    if constexpr (std::is_same_v<T, float>) {
        return _mm512_castsi512_ps(
            _mm512_maskz_alignr_epi32(0xffff, _mm512_castps_si512(behind), _mm512_castps_si512(values), ahead));
    } else {
        return _mm512_castsi512_pd(
            _mm512_maskz_alignr_epi64(0xff, _mm512_castpd_si512(behind), _mm512_castpd_si512(values), ahead));
    }
#else
    static_assert(sizeof(T) == 0, "a vector is a line with AVX-512 alone");
#endif
}

template <bool fused, std::size_t ahead, class T, class Architecture>
[[gnu::always_inline]] inline void add_from(const T* a, const T* line, std::size_t fours,
                                            Accumulator<T, Architecture>& s0, Accumulator<T, Architecture>& s1,
                                            Accumulator<T, Architecture>& s2, Accumulator<T, Architecture>& s3) {
    using Batch = xsimd::batch<T, Architecture>;
    auto before = Batch::load_aligned(line);
    const auto next = [&](Accumulator<T, Architecture> & sum) __attribute__((always_inline)) {
        line += Batch::size;
        const auto values = in_register(Batch::load_aligned(line));
        sum.sums[0] = add_product<fused>(sum.sums[0], Batch::load_aligned(a), across<ahead>(before, values));
        a += Batch::size;
        before = values;
    };
    for (; fours > 0; --fours) {
        next(s0);
        next(s1);
        next(s2);
        next(s3);
    }
}

template <bool fused, class T, class Architecture, std::size_t... begins>
[[gnu::always_inline]] inline void add_from(std::size_t ahead, const T* a, const T* line, std::size_t fours,
                                            Accumulator<T, Architecture>& s0, Accumulator<T, Architecture>& s1,
                                            Accumulator<T, Architecture>& s2, Accumulator<T, Architecture>& s3,
                                            std::index_sequence<begins...>) {
    (void)((ahead == begins ? (add_from<fused, begins>(a, line, fours, s0, s1, s2, s3), true) : false) || ...);
}

// Adds `fours` times four blocks, and moves behind them. It loads the line in which the last one ends, and so up to a
// line behind it.
template <bool fused, class T, class Architecture>
[[gnu::always_inline]] inline void add_lines(const T*& a, const T*& x, std::size_t fours,
                                             Accumulator<T, Architecture>& s0, Accumulator<T, Architecture>& s1,
                                             Accumulator<T, Architecture>& s2, Accumulator<T, Architecture>& s3) {
    constexpr std::size_t block = 64 / sizeof(T);
    const std::size_t ahead = reinterpret_cast<std::uintptr_t>(x) / sizeof(T) % block;
    add_from<fused>(ahead, a, x - ahead, fours, s0, s1, s2, s3, std::make_index_sequence<block>{});
    a += fours * 4 * block;
    x += fours * 4 * block;
}

}  // namespace
}  // namespace glsum
