// transposed: the transposed direct form of a window. In place of the L - 1 newest samples it keeps the L - 1 sums to
// come, and each sample, as it comes, is added to all of them. So S_k is one addition away when x_k comes,
//
//   S_k = x_k + s_1,     then     s_j <- s_(j+1) + a_j x_k   for j = 1 ... L-1,   s_L = 0,
//
// and what follows is for the sums to come: between sample and result lies a call of the same length whatever L is
// (`answer` and `settle`, glsum/kernel.hpp). No two of these products go into one sum, so that none waits for another.
//
//   S_k = x_k + ( ... (( 0 + a_(L-1) x_(k-L+1)) + a_(L-2) x_(k-L+2)) + ... + a_1 x_(k-1))
//
// Order of summation: oldest first, one accumulator: bit for bit that of `ring` with the same technique, and so its
// error bound (window/window_bound.hpp), which counts the additions of each term. What is not finite is forgotten with
// its last term, as in a window.
//
// Product and addition are rounded apart, which every core has: fused, `block` gives the same bits for fewer cycles.
//
// Upkeep: none beside the products; a sum is loaded and stored for each. The sums stay in place, as a ring's samples
// do. Memory: L - 1 sums, floating point only: in fixed point a sum takes four times the bytes of a Q15 sample.
// Range and overflow: as the format's; a sum that overflows is an infinity for its own output alone.
#pragma once

#include <string_view>

#include "glsum/family.hpp"

namespace glsum {

inline constexpr Family transposed_family{"transposed", "a window as the sums to come, each a single addition away"};

struct Transposed {
    static constexpr std::string_view word = "transposed";
    static constexpr Family family = transposed_family;
    static constexpr std::string_view summary =
        "none of samples: the sums to come are kept, and each sample is added to all";
    static constexpr std::string_view fields =
        "    uint32_t head; /* where the next output's sum lies; that of the output after it behind it */\n"
        "    @accumulator@ past[@NAME@_SAMPLES]; /* all products of these sums with samples that came */\n";
    static constexpr bool contiguous = false;
};

}  // namespace glsum
