// simd, simdfma: the host's vector unit through xsimd, the instruction set chosen at run time (SSE2, AVX2, AVX-512;
// NEON on AArch64). Host only; needs a contiguous window. Every instruction set adds in the same order, that of four
// accumulators of 64 bytes: sample i goes to lane i mod (256 bytes / sample size), and the lanes are added pairwise at
// the end. So the bits do not depend on the machine, and an accuracy measured on one holds on all. simdfma rounds
// product and addition once, on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

/// sum of a[i] x[i] over blocks of 64 bytes, in the order above, on the best instruction set of this machine.
/// \param a  aligned to 64 bytes: SSE2's product then loads it itself
/// \tparam fused  each product and its addition rounded once
template <class T, bool fused>
[[nodiscard]] T simd_dot(const T* a, const T* x, std::size_t blocks);
/// The same, but that the first block of samples is taken from `recent`, into which `newest` moves afterwards. The
/// samples stored by the last calls could be loaded as a vector only once all of these stores are done; `recent` is
/// stored as it is loaded. Where vectors are short that costs more than it saves, and `recent` is left alone.
/// \param a  of more than `longest_unshifted` samples, and unless fused, with its shifted copies behind it (Simd::fill)
/// \param x  of `blocks` blocks, the newest among them \param recent  64 bytes, aligned to as many
template <class T, bool fused>
[[nodiscard]] T simd_slide(const T* a, const T* x, T* recent, std::size_t blocks, T newest);
/// The name of that instruction set, as xsimd has it: "avx512f", "avx2", "sse2", "arm64+neon".
[[nodiscard]] std::string_view simd_instruction_set();

/// Of more samples, copies of the table that fall out of a first cache of 32 KB cost less than vectors across its
/// lines.
inline constexpr std::size_t longest_unshifted = 1536;

struct Simd : WeightTable {
    static constexpr std::string_view word = "simd";
    static constexpr bool host_only = true;
    static constexpr bool contiguous_only = true;

    static constexpr std::size_t accumulators = 4;
    template <class Format>
    static constexpr std::size_t block = 64 / sizeof(typename Format::Sample);

    /// Whole blocks. With a window of `past` samples the last block would reach into the mirror's other copy, and be
    /// loaded only once the newest samples are stored there.
    template <class Format>
    static constexpr std::size_t held(std::size_t past) {
        return (past + block<Format> - 1) / block<Format> * block<Format>;
    }
    /// Of a long window the table has a copy for each place in 16 bytes at which the window may begin
    /// (simd_shifted.hpp).
    template <class Format>
    static constexpr std::size_t copies(std::size_t past) {
        return held<Format>(past) > longest_unshifted ? 16 / sizeof(typename Format::Sample) : 1;
    }
    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past == 0 ? 0 : copies<Format>(past) * held<Format>(past) + block<Format> - 1;
    }
    /// At the next multiple of 64 bytes: a vector across two of the processor's lines takes two loads.
    template <class T>
    static T* placed(T* memory) {
        constexpr std::size_t count = 64 / sizeof(T);
        return memory + (count - reinterpret_cast<std::uintptr_t>(memory) / sizeof(T) % count) % count;
    }
    /// A block, where it is placed.
    template <class Format>
    static constexpr std::size_t beside = 2 * block<Format> - 1;

    /// a_1 ... a_past, then zeros up to a whole block.
    template <class Format>
    static void fill_once(typename Format::Coefficient* table, std::size_t past, const Design& design,
                          const typename Format::Scale& scale) {
        WeightTable::fill<Format>(table, past, design, scale);
        for (std::size_t i = past; i < held<Format>(past); ++i) {
            table[i] = 0;
        }
    }
    /// The same, then as much of it behind one zero, behind two ...
    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        fill_once<Format>(table, past, design, scale);
        const std::size_t count = held<Format>(past);
        for (std::size_t shift = 1; shift < copies<Format>(past); ++shift) {
            for (std::size_t i = 0; i < count; ++i) {
                table[shift * count + i] = i < shift ? 0 : table[i - shift];
            }
        }
    }

    template <class Format>
    static typename Format::Accumulator sum_beside(const typename Format::Coefficient* table,
                                                   const Window<typename Format::Sample>& window,
                                                   typename Format::Sample newest, typename Format::Sample* beside) {
        return slid<Format, false>(table, window, newest, beside);
    }

    /// The product; the additions within a lane, of the accumulators, of the lanes, and of x_k.
    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        constexpr std::size_t lanes = accumulators * block<Format>;
        std::size_t tree = 0;
        for (std::size_t width = lanes; width > 1; width /= 2) {
            ++tree;
        }
        return j == 0 ? 1 : 1 + (taps - 1) / lanes + tree + 1;
    }

protected:
    // Where one block holds the window, samples that have left it would stay beside it: x = infinity for too long.
    template <class Format, bool fused>
    [[gnu::always_inline]] static inline typename Format::Accumulator slid(
        const typename Format::Coefficient* table, const Window<typename Format::Sample>& window,
        typename Format::Sample newest, typename Format::Sample* beside) {
        using Sample = typename Format::Sample;
        const std::size_t blocks = window.newer_count / block<Format>;
        if (blocks <= 1) {
            return newest + simd_dot<Sample, fused>(table, window.newer, blocks);
        }
        return newest + simd_slide<Sample, fused>(table, window.newer, placed(beside), blocks, newest);
    }
};

struct SimdFma : Fused<Simd> {
    static constexpr std::string_view word = "simdfma";

    /// No copies: SSE2, whose loop takes them, has no fused product.
    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past == 0 ? 0 : held<Format>(past) + block<Format> - 1;
    }
    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        fill_once<Format>(table, past, design, scale);
    }

    template <class Format>
    static typename Format::Accumulator sum_beside(const typename Format::Coefficient* table,
                                                   const Window<typename Format::Sample>& window,
                                                   typename Format::Sample newest, typename Format::Sample* beside) {
        return slid<Format, true>(table, window, newest, beside);
    }
};

}  // namespace glsum
