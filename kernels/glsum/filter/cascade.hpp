// cascade: near taps and modes as `modes` has them (exponentials/modes.hpp), the last near tap and the modes run as a
// cascade of second-order sections: what filter designers write down, and CMSIS-DSP's biquads compute.
//
//   S_k = x_k + a_1 x_(k-1) + ... + a_(K-1) c_k,     c = prod_i (1 + b1 q + b2 q^2)/(1 + a1 q + a2 q^2) x_(k-K+1),
//
// q = z^-1, M/2 sections and before them, of an odd M, one of a single pole. With K = 1, as Oustaloup's and Charef's
// filters have it, S = c. The same sum as that of `modes` for two multiplications a mode; filter/series.hpp finds the
// zeros, which are real for modes whose weights have one sign. Others are refused (`modes_out_of_range`), and so is a
// format whose rounding leaves a section without two real poles inside the circle (`format_too_narrow`). Without modes
// it ends where a window of L taps does.
//
//   df2t   floating point, transposed direct form II: y = x + s1, s1 <- (s2 + b1 x) - a1 y, s2 <- b2 x - a2 y.
//   df1    q31, direct form I: y = b0 x + b1 x' + b2 x'' - a1 y' - a2 y'' + r, exact in 64 bits; r is what the last
//          y dropped, below a unit of it, so that the dropping itself is high-passed and slow poles do not add it up.
//   Both: near taps newest first, one accumulator, then the cascade, the fastest and the slowest pole in the last
//   section.
//
// A coefficient errs by half a unit of its place whatever d is, and a pole moves by as much over its distance to its
// neighbour: for slow poles the leaky averages of `modes`, which store d itself, keep more. In floating point the
// rounding of each y, too, is added up for 1/d samples.
// Range, floating point: as the format's, d below 2. q31: d <= 1. b0 ... a2 are fractions of 29 bits below 4, the sum
// of whose magnitudes is below 8: no sum of products overflows. Scaling: section i works at 2^-s_i, s_i the least that
// is not below the one before and for which the l1 norm of the response up to there (the largest output for |x| <= 1),
// with what rounding may add, stays below 1. So no section overflows and none saturates. S_k = output 2^s: one bit for
// 0 < v < 1, more for integrals. Error: glsum/filter/cascade_bound.hpp.
#pragma once

#include <string_view>

#include "glsum/exponentials/modes.hpp"
#include "glsum/window/technique.hpp"

namespace glsum {

inline constexpr Family filter_family{"filter", "full memory: a few samples, and a cascade of second-order sections"};

struct DirectForm2Transposed : WeightTable {
    static constexpr std::string_view word = "df2t";
};
struct DirectForm1 : WeightTable {
    static constexpr std::string_view word = "df1";
};

struct Cascade {
    static constexpr std::string_view word = "cascade";
    static constexpr Family family = filter_family;
    static constexpr bool contiguous = true;

    template <class State, class Says>
    static void constants(const Design& design, const State& state, Says&& says) {
        Modes::constants(design, state, says);
        says("sections", (design.modes.size() + 1) / 2);
        says("pairs", design.modes.size() / 2);
        says("single", design.modes.size() % 2);
    }
};

}  // namespace glsum
