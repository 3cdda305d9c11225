// The instruction sets that the vector loops are compiled for, the best first; CMakeLists.txt has the flags of each.
#pragma once

#include <xsimd/xsimd.hpp>

namespace glsum {

#if defined(GLSUM_SIMD_UP_TO_SSE2)
using SimdArchitectures = xsimd::arch_list<xsimd::sse2>;
#elif defined(GLSUM_SIMD_UP_TO_AVX2)
using SimdArchitectures = xsimd::arch_list<xsimd::fma3<xsimd::avx2>, xsimd::avx2, xsimd::sse2>;
#elif defined(__x86_64__)
using SimdArchitectures = xsimd::arch_list<xsimd::avx512f, xsimd::fma3<xsimd::avx2>, xsimd::avx2, xsimd::sse2>;
#elif defined(__aarch64__)
using SimdArchitectures = xsimd::arch_list<xsimd::neon64>;
#else
#error "no xsimd instruction set is listed for this machine: configure with GLSUM_SIMD=OFF"
#endif

}  // namespace glsum
