// Sums of a window, eight at a time, on the host's vector unit. With the window's samples in a register each of them is
// multiplied for eight sums to come, so that a multiplication takes one load and not two; and a sample that was just
// stored is not read as part of a vector, which would wait for its store.
//
// Every eighth sample begins a block, k0 = k - k mod 8. Before it, for q = 0 ... 7, all that is known of the sum at k0
// + q:
//
//   P_q = sum_{i=0..L-2-q} a_(q+1+i) x_(k0-1-i)
//
// i going up in lane i mod (64 bytes / sample size), the lanes then added by halves. Then each sample of the block, as
// it comes, is added to the later ones:  S_(k0+q) = x_(k0+q) + ((P_q + a_q x_k0) + ... + a_1 x_(k0+q-1)). The order
// does not depend on the instruction set, so the bits do not depend on the machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace glsum {

inline constexpr std::size_t simd_block_samples = 8;

/// Where the parts of a kernel's two buffers lie.
template <class T>
struct SimdBlock {
    const T*
        entering;  ///< 8 zeros, then a_1 ... a_7: from index 7 - q on what x_(k0+q) is multiplied by for P_0, P_1, ...
    const T* window;  ///< a_1 ...: for P_q from index q lag on, zeros behind the window
    std::size_t lag;
    std::size_t vectors;  ///< of 64 bytes, for each P
    T* pending;           ///< P_0 ... P_7
    T* past;              ///< a ring kept twice, of a whole number of blocks
    std::uint32_t size;   ///< of that ring; 0 without a past
    std::uint32_t head;   ///< where x_(k-1) lies; newer ones lie lower
};

/// The sum for the next sample.
[[nodiscard]] float simd_block_step(SimdBlock<float>& block, float newest);
[[nodiscard]] double simd_block_step(SimdBlock<double>& block, double newest);
/// The same with each product and its addition rounded once.
[[nodiscard]] float simd_block_step_fused(SimdBlock<float>& block, float newest);
[[nodiscard]] double simd_block_step_fused(SimdBlock<double>& block, double newest);

}  // namespace glsum
