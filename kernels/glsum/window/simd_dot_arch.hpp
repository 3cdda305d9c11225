// The vector loops behind `simd_dot` and `simd_slide`, once for each instruction set; simd_dot_arch.cpp is compiled for
// each of them.
#pragma once

#include <type_traits>

#include "glsum/window/simd.hpp"
#include "glsum/window/simd_architectures.hpp"

namespace glsum {

/// Whether `simd_slide` takes the first block from `recent`. Of SSE2's vectors few stores are waited for: less than it
/// takes to move four of them on.
template <class Architecture>
inline constexpr bool keeps_recent = !std::is_same_v<Architecture, xsimd::sse2>;

template <class T, bool fused, class Architecture>
T simd_dot_on(const T* a, const T* x, std::size_t blocks);
template <class T, bool fused, class Architecture>
T simd_slide_on(const T* a, const T* x, T* recent, std::size_t blocks, T newest);

}  // namespace glsum
