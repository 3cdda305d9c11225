// The vector loop behind `simd_dot`, once for each instruction set; simd_dot_arch.cpp is compiled for each of them.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "glsum/technique/simd.hpp"

namespace glsum {

#if defined(__x86_64__)
using SimdArchitectures = xsimd::arch_list<xsimd::avx512f, xsimd::fma3<xsimd::avx2>, xsimd::avx2, xsimd::sse2>;
#elif defined(__aarch64__)
using SimdArchitectures = xsimd::arch_list<xsimd::neon64>;
#else
#error "no xsimd instruction set is listed for this machine: configure with GLSUM_SIMD=OFF"
#endif

template <class T, bool fused, class Architecture>
T simd_dot_on(const T* a, const T* x, std::size_t blocks);

}  // namespace glsum
