// nested: the newest K - 1 past samples as they are, and of those behind them sums over blocks that grow with their
// age: B blocks of 2 samples, B of 4, B of 8, ... ("logarithmic memory"). The blocks slide: at every sample each covers
// the lags that it is named by, and its weight is the mean of a_j over these. M blocks cost M multiplications and reach
// back over some B 2^(M/B + 1) samples. Any order, also those whose weights no mixture of exponentials is.
//
//   S_k = x_k + a_1 x_(k-1) + ... + a_(K-1) x_(k-K+1) + w_0 s_0 + ... + w_(M-1) s_(M-1)
//
//   s_b = the sum of x_(k-j), w_b = the mean of a_j, over j = D_b ... D_b + W_b - 1;   D_0 = K, D_(b+1) = D_b + W_b
//   W_b = 2^l for the B blocks of level l = 1, 2, ...; the last level has as many as are left of M
//
// What a block forgets is how the weights vary over it: exact for a constant, and right in the mean for whatever is
// slow against the block; a sine whose period is the block's width is lost. The error for |x| <= 1 is sum |a_j - w_j|
// (modes/blocks.hpp finds the K, M and B for which it is the least).
//
// No sum is carried from sample to sample, so nothing drifts and what was read once is forgotten whole: with D_l where
// level l begins and u_l(k) the sum over the lags D_l ... D_l + 2^l - 1,
//
//   u_1(k) = x_(k-K) + x_(k-K-1),    u_(l+1)(k) = u_l(k - B 2^l) + u_l(k - (B+1) 2^l),    blocks: u_l(k - i 2^l), i < B
//
// one addition and one store a level. What a level must still be asked for is as long as the lags that it stands for:
// the delay lines lie behind one another in one ring of R - 1 words, R = K + W_0 + ... + W_(M-1) the lags that are
// reached, with one head for all. The word that a level drops is the place of the next level's newest. That is a
// window's memory.
//
//   plain   newest first, one accumulator: the taps, then the blocks.
//
// Memory: R - 1 samples, whatever K, M and B are. A capacity is one of lags, R: `Line<K, 8194>` serves K = 4, M = 12,
// B = 1. R is at most 2^28.
// Range, floating point: the sum of 2^l samples must not overflow, so |x| stays below 2^-l of the format's range. q31:
// a block is kept as its mean, (u + u') / 2 rounded to nearest, halves up, at each level, and its coefficient is the
// sum of its weights: nothing overflows, and a mean of 2^l samples errs by l 2^-32 at most. The scale follows from the
// sum of the magnitudes of all coefficients, as for a window. Error: glsum/logmemory/nested_bound.hpp, against the
// exact sum of the design's own taps and blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "glsum/family.hpp"
#include "glsum/kernel.hpp"

namespace glsum {

inline constexpr Family logmemory_family{
    "logmemory", "logarithmic memory: a few samples, and sums over blocks that grow with their age"};

struct Nested {
    static constexpr std::string_view word = "nested";
    static constexpr Family family = logmemory_family;
    static constexpr bool contiguous = false;

    template <class State, class Says>
    static void constants(const Design& design, const State& state, Says&& says) {
        says("past", state.near_samples);
        says("near_taps", state.near_samples + 1);
        says("held", state.past_samples);
        says("blocks", design.blocks.count);
        says("per_level", design.blocks.per_level);
    }
};

/// Whether a history takes block sums in place of a long window.
template <class History>
inline constexpr bool keeps_blocks = std::is_same_v<History, Nested>;

/// The most lags that blocks may reach.
inline constexpr std::size_t most_reach = std::size_t{1} << 28;

/// R: the lags that near taps and blocks behind them stand for; `most_reach + 1` if that is more, or no design.
[[nodiscard]] constexpr std::size_t reach_of(std::size_t near_taps, const Blocks& blocks) {
    std::uint64_t reach = near_taps;
    std::uint64_t width = 2;
    for (std::size_t left = blocks.count; left > 0 && reach <= most_reach; width *= 2) {
        const std::size_t many = left < blocks.per_level ? left : blocks.per_level;
        reach += many == 0 ? most_reach : width * many;
        left -= many;
    }
    return reach <= most_reach ? static_cast<std::size_t>(reach) : most_reach + 1;
}
/// The same of a design, where a block counts as one tap.
[[nodiscard]] constexpr std::size_t reach_of(const Design& design) {
    const std::size_t blocks = design.blocks.count;
    return blocks == 0            ? design.taps
           : blocks < design.taps ? reach_of(design.taps - blocks, design.blocks)
                                  : most_reach + 1;
}

}  // namespace glsum
