// simd, simdfma: the host's vector unit through xsimd, the instruction set chosen at run time (SSE2, AVX2, AVX-512;
// NEON on AArch64). Host only; needs a contiguous window. Every instruction set adds in the same order, that of four
// accumulators of 64 bytes: sample i goes to lane i mod (256 bytes / sample size), and the lanes are added pairwise at
// the end. So the bits do not depend on the machine, and an accuracy measured on one holds on all. simdfma rounds
// product and addition once, on every machine.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

/// sum of a[i] x[i] over blocks of 64 bytes, in the order above, on the best instruction set of this machine.
[[nodiscard]] float simd_dot(const float* a, const float* x, std::size_t blocks);
[[nodiscard]] double simd_dot(const double* a, const double* x, std::size_t blocks);
/// The same with each product and its addition rounded once.
[[nodiscard]] float simd_dot_fused(const float* a, const float* x, std::size_t blocks);
[[nodiscard]] double simd_dot_fused(const double* a, const double* x, std::size_t blocks);
/// The name of that instruction set, as xsimd has it: "avx512f", "avx2", "sse2", "arm64+neon".
[[nodiscard]] std::string_view simd_instruction_set();

struct Simd : WeightTable {
    static constexpr std::string_view word = "simd";
    static constexpr bool host_only = true;
    static constexpr bool contiguous_only = true;

    static constexpr std::size_t accumulators = 4;
    template <class Format>
    static constexpr std::size_t block = 64 / sizeof(typename Format::Sample);

    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return (past + block<Format> - 1) / block<Format> * block<Format>;
    }
    template <class Format>
    static constexpr std::size_t overread = block<Format> - 1;

    /// a_1 ... a_past, then zeros up to a whole block.
    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        WeightTable::fill<Format>(table, past, design, scale);
        for (std::size_t i = past; i < table_count<Format>(past); ++i) {
            table[i] = 0;
        }
    }

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale&) {
        return newest + simd_dot(table, window.newer, table_count<Format>(window.newer_count) / block<Format>);
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
};

struct SimdFma : Simd {
    static constexpr std::string_view word = "simdfma";

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale&) {
        return newest + simd_dot_fused(table, window.newer, table_count<Format>(window.newer_count) / block<Format>);
    }
};

}  // namespace glsum
