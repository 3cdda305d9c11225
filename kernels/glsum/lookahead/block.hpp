// block: a window whose sums are formed for P = 4 coming outputs at once, so that each coefficient and each sample that
// is loaded serves four products ("block convolution in the time domain"). No latency, and the same sum as any
// window's.
//
// Samples come in groups of four. While group m comes in, the products of group m + 1 with all samples up to the newest
// of group m are made, four outputs side by side, and wait in four accumulators; when x_k comes, 0 to 3 products with
// the samples of its own group are all that its sum lacks. The work on what is to come goes on from the oldest group of
// samples to the newest and is dealt out: with G = ceil((L-1)/4) groups in the window, call p = k mod 4 takes (G + p) /
// 4 of them, rounded down, so the worst call is a few products above the mean.
//
//   S_k = x_k + ( ... (( 0 + a_(L-1) x_(k-L+1)) + a_(L-2) x_(k-L+2)) + ... + a_1 x_(k-1))
//
// Order of summation: oldest first, one accumulator for each output: bit for bit that of `ring` with the same
// technique. Up to six coefficients beyond the last are 0: they add nothing to finite samples, but an infinity or a NaN
// stays up to six samples longer in the sums than it must.
//
//   oldestfma   each product and its addition rounded once
//   plain       q31, where no order shows
//
// Upkeep: one store a sample, and a group's accumulators, loaded and stored at each call. Memory: 4 G samples, in the
// order in which they came, and eight accumulators in the state. Multiplications: 4 G + 1.5 in the mean of four calls.
// Range, error and overflow: as the format's and the technique's. `prepare` and `reset` begin a group.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/family.hpp"
#include "glsum/kernel.hpp"

namespace glsum {

inline constexpr Family lookahead_family{"lookahead", "a window, summed for several coming outputs at once"};

struct Block {
    static constexpr std::string_view word = "block";
    static constexpr Family family = lookahead_family;
    static constexpr bool contiguous = false;
    static constexpr std::size_t phases = 4;  ///< P: how many calls it takes until their costs come again

    /// G: groups of samples that a past of so many needs.
    static constexpr std::size_t groups(std::size_t past) { return (past + phases - 1) / phases; }

    template <class State, class Says>
    static void constants(const Design&, const State& state, Says&& says) {
        says("groups", state.groups);
    }
};

/// The same idea on the host's vector unit, eight outputs at a time: lookahead/simd_block.hpp.
struct HostBlock {
    static constexpr std::string_view word = "block";
    static constexpr Family family = lookahead_family;
    static constexpr bool contiguous = true;
};

}  // namespace glsum
