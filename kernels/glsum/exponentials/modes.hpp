// modes: the newest K - 1 past samples as they are, and of all older ones M decaying averages. Behind the first K taps
// the weights are a mixture of exponentials, and a few of them stand for it to any error and horizon (../../modes/
// designs them on the host): full memory at K + 2M multiplications, whatever the length of the record.
//
//   S_k = x_k + a_1 x_(k-1) + ... + a_(K-1) x_(k-K+1) + g_0 s_0 + ... + g_(M-1) s_(M-1),     g_m = w_m / d_m,
//   then, for the next sample,  s_m <- s_m + d_m (x_(k-K+1) - s_m).
//
// With d <= 1 s_m is an average: it never leaves the range of the samples. Beyond 1 it swings over each sample to the
// other side, and reaches d/(2-d) times their peak: what a derivative needs towards half the sample's rate, and what
// floating point alone has room for. d = 1 - r is stored: in r, single precision would lose a slow mode (d = 1e-5 at
// v = -0.5 over 5000 samples) to rounding.
//
//   plain        newest first, one accumulator: the taps from the newest sample on, then the modes, the fastest (the
//                design's last) first. A state stops changing where its step is below half a unit of its last place: at
//                worst its error grows to the unit's half divided by d.
//   compensated  the same sum, and each state carries what its last step lost into its next one, by the three
//                operations of [Dekker1971]: no stopping, and an error of some units, whatever d. Floating point only.
//
// Range, floating point: as the format's, d below 2. q31: d <= 1, |s_m| <= 1 as the samples; the scale follows from the
// sum of the magnitudes of all a_j and g_m, as for a window. d is a mantissa of 30 bits and a shift, rounded to
// nearest; a step d (x - s) is exact in 64 bits and rounded once, halves up: a state cannot pass the sample that it
// moves to. Error: glsum/exponentials/modes_bound.hpp, against the exact sum of the design's own taps and modes; how
// far those are from the weights of the order is the design's certificate.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "glsum/family.hpp"
#include "glsum/kernel.hpp"

namespace glsum {

inline constexpr Family exponentials_family{"exponentials",
                                            "full memory: a few samples, and decaying averages of all older ones"};

/// What an average forgets with each sample, 1 - |1 - d|: an error made at each step adds up to one over this at most.
[[nodiscard]] inline double forgets(double decay) { return 1.0 - std::fabs(1.0 - decay); }

struct Modes {
    static constexpr std::string_view word = "modes";
    static constexpr Family family = exponentials_family;
    static constexpr bool contiguous = true;

    template <class State, class Says>
    static void constants(const Design& design, const State&, Says&& says) {
        const std::size_t near_taps = design.taps - 2 * design.modes.size();
        says("past", near_taps - 1);
        says("near_taps", near_taps);
        says("modes", design.modes.size());
        says("decaying", std::count_if(design.modes.begin(), design.modes.end(),
                                       [](const Mode& mode) { return mode.decay != 0.0; }));
    }
};

}  // namespace glsum
