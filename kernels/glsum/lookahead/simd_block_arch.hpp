// The vector loop behind `simd_block_step`, once for each instruction set; simd_block_arch.cpp is compiled for each.
#pragma once

#include "glsum/lookahead/simd_block.hpp"

namespace glsum {

template <class T, bool fused, class Architecture>
T simd_block_on(SimdBlock<T>& block, T newest);

}  // namespace glsum
