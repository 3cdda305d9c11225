// Compiled once for each instruction set, with GLSUM_SIMD_ARCHITECTURE naming it.
#include "glsum/lookahead/simd_block_arch.hpp"

#include "glsum/window/simd_product.hpp"

namespace glsum {
namespace {

constexpr std::size_t sums = simd_block_samples;

// P_0 ... P_7 from the past as it is.
template <class T, bool fused, class Architecture>
void begin_block(SimdBlock<T>& block) {
    using Batch = xsimd::batch<T, Architecture>;
    constexpr std::size_t lanes = 64 / sizeof(T);
    const T* const past = block.past + block.head;
    alignas(64) T lane[sums][lanes];
    // A part of 64 bytes at a time: eight sums of one register each and a sample's fit the sixteen of every set.
    for (std::size_t part = 0; part < lanes; part += Batch::size) {
        Batch sum[sums];
        for (auto& one : sum) {
            one = Batch(T(0));
        }
        const T* weights = block.window + part;
        for (std::size_t i = part; i < block.vectors * lanes; i += lanes, weights += lanes) {
            const Batch x = Batch::load_unaligned(past + i);
#pragma GCC unroll 8
            for (std::size_t q = 0; q < sums; ++q) {
                sum[q] = add_product<fused>(sum[q], Batch::load_unaligned(weights + q * block.lag), x);
            }
        }
        for (std::size_t q = 0; q < sums; ++q) {
            sum[q].store_aligned(&lane[q][part]);
        }
    }
#pragma GCC unroll 4
    for (std::size_t half = lanes / 2; half > 2; half /= 2) {
        for (auto& one : lane) {
            for (std::size_t i = 0; i < half; ++i) {
                one[i] += one[i + half];
            }
        }
    }
    for (std::size_t q = 0; q < sums; ++q) {
        block.pending[q] = (lane[q][0] + lane[q][2]) + (lane[q][1] + lane[q][3]);
    }
}

}  // namespace

template <class T, bool fused, class Architecture>
T simd_block_on(SimdBlock<T>& block, T newest) {
    using Batch = xsimd::batch<T, Architecture>;
    if (block.size == 0) {
        return newest;
    }
    const std::size_t q = (block.size - block.head) % sums;
    if (q == 0) {
        begin_block<T, fused, Architecture>(block);
    }
    const T result = newest + block.pending[q];
    // Where a register holds more than eight, the lanes behind are of no sum.
    const Batch x(newest);
    for (std::size_t r = 0; r < sums; r += Batch::size) {
        const Batch weights = Batch::load_unaligned(block.entering + (sums - 1 - q) + r);
        add_product<fused>(Batch::load_unaligned(block.pending + r), weights, x).store_unaligned(block.pending + r);
    }
    block.head = (block.head == 0 ? block.size : block.head) - 1;
    block.past[block.head] = newest;
    block.past[block.head + block.size] = newest;
    return result;
}

using Here = GLSUM_SIMD_ARCHITECTURE;
template float simd_block_on<float, false, Here>(SimdBlock<float>&, float);
template float simd_block_on<float, true, Here>(SimdBlock<float>&, float);
template double simd_block_on<double, false, Here>(SimdBlock<double>&, double);
template double simd_block_on<double, true, Here>(SimdBlock<double>&, double);

}  // namespace glsum
