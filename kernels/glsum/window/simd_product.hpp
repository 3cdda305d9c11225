// sum + a x over a vector, rounded twice or once; for the sources that are compiled once for each instruction set.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <xsimd/xsimd.hpp>

namespace glsum {
// Internal to each source: two sets must not share a body.
namespace {

// a x + sum with one rounding. xsimd's fma is a product and an addition where it knows no instruction (xsimd 8.1, for
// AVX-512 too), so each set has its own; where there is none, the scalar one gives the same bits, slowly.
template <class T, class Architecture>
xsimd::batch<T, Architecture> fused_product(const xsimd::batch<T, Architecture>& sum,
                                            const xsimd::batch<T, Architecture>& a,
                                            const xsimd::batch<T, Architecture>& x) {
    using Batch = xsimd::batch<T, Architecture>;
#if defined(__AVX512F__)
    if constexpr (std::is_same_v<Batch, xsimd::batch<float, xsimd::avx512f>>) {
        return _mm512_fmadd_ps(a, x, sum);
    } else if constexpr (std::is_same_v<Batch, xsimd::batch<double, xsimd::avx512f>>) {
        return _mm512_fmadd_pd(a, x, sum);
    } else
#elif defined(__FMA__) || defined(__aarch64__)
    if constexpr (std::is_same_v<Architecture, GLSUM_SIMD_ARCHITECTURE>) {
        return xsimd::fma(a, x, sum);
    } else
#endif
    {
        alignas(64) T sums[Batch::size];
        alignas(64) T as[Batch::size];
        alignas(64) T xs[Batch::size];
        sum.store_aligned(sums);
        a.store_aligned(as);
        x.store_aligned(xs);
        for (std::size_t i = 0; i < Batch::size; ++i) {
            sums[i] = std::fma(as[i], xs[i], sums[i]);
        }
        return Batch::load_aligned(sums);
    }
}

template <bool fused, class T, class Architecture>
xsimd::batch<T, Architecture> add_product(const xsimd::batch<T, Architecture>& sum,
                                          const xsimd::batch<T, Architecture>& a,
                                          const xsimd::batch<T, Architecture>& x) {
    if constexpr (fused) {
        return fused_product(sum, a, x);
    } else {
        return sum + a * x;
    }
}

}  // namespace
}  // namespace glsum
