// Compiled once for each instruction set, with GLSUM_SIMD_ARCHITECTURE naming it.
#include "glsum/window/simd_dot_arch.hpp"

#include "glsum/window/simd_product.hpp"

namespace glsum {

template <class T, bool fused, class Architecture>
T simd_dot_on(const T* a, const T* x, std::size_t blocks) {
    using Batch = xsimd::batch<T, Architecture>;
    constexpr std::size_t block = 64 / sizeof(T);
    constexpr std::size_t parts = block / Batch::size;
    constexpr std::size_t accumulators = Simd::accumulators;

    // Four of 64 bytes: with AVX-512 that is four chains of additions, which hides an addition's latency of up to
    // four cycles at one block a cycle, the most that two loads a cycle can feed.
    Batch sum[accumulators][parts];
    for (auto& accumulator : sum) {
        for (auto& part : accumulator) {
            part = Batch(T(0));
        }
    }
    const auto add_block = [&](Batch(&accumulator)[parts], std::size_t first) {
        for (std::size_t part = 0; part < parts; ++part) {
            const std::size_t i = first + part * Batch::size;
            accumulator[part] =
                add_product<fused>(accumulator[part], Batch::load_unaligned(a + i), Batch::load_unaligned(x + i));
        }
    };
    std::size_t done = 0;
    for (; done + accumulators <= blocks; done += accumulators) {
        for (std::size_t k = 0; k < accumulators; ++k) {
            add_block(sum[k], (done + k) * block);
        }
    }
    for (std::size_t k = 0; done < blocks; ++done, ++k) {
        add_block(sum[k], done * block);
    }
    alignas(64) T lanes[block];
    for (std::size_t part = 0; part < parts; ++part) {
        const Batch total = (sum[0][part] + sum[1][part]) + (sum[2][part] + sum[3][part]);
        total.store_aligned(lanes + part * Batch::size);
    }
    for (std::size_t half = block / 2; half > 0; half /= 2) {
        for (std::size_t i = 0; i < half; ++i) {
            lanes[i] += lanes[i + half];
        }
    }
    return lanes[0];
}

using Here = GLSUM_SIMD_ARCHITECTURE;
template float simd_dot_on<float, false, Here>(const float*, const float*, std::size_t);
template float simd_dot_on<float, true, Here>(const float*, const float*, std::size_t);
template double simd_dot_on<double, false, Here>(const double*, const double*, std::size_t);
template double simd_dot_on<double, true, Here>(const double*, const double*, std::size_t);

}  // namespace glsum
