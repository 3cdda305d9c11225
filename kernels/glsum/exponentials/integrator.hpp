// modessum: near taps, decaying averages and one integrator, a running sum that never decays, for integrals, -1 <= v <
// 0:
//
//   S_k = [modes: x_k + a_1 x_(k-1) + ... + g_1 s_1 + ... + g_(M-1) s_(M-1)] + w_0 r,     r = x_(k-K) + ... + x_0.
//
// The weights a_j of an integral fall as j^-(1+v), slower than their own sum converges: whatever decays forgets a level
// in the end, and a controller that integrates with it is left with an offset. With the pole at 1 a level is added up
// for ever, and the slowest of the modes is saved: K + 2M - 1 multiplications. At v = -1, where a_j = 1, one tap and
// the running sum alone are exact. The design's first mode (the slowest) has a decay of 0 and is the running sum; the
// others are as with `modes`. Without any modes it ends where a window of L taps does.
//
// No drift: r is kept in two words, a sum and what its additions lost [Neumaier1974], by the six operations of two_sum
// and one more addition. Only what the loss itself loses stays behind, u^2 of the sum of all |r| of the record.
// Range, floating point only: r grows without limit, up to the record's length times the peak, and no scale of a fixed
// format holds what an integral comes to.
// Error: glsum/exponentials/integrator_bound.hpp, against the exact sum of the design's own taps, exponentials and
// running sum.
#pragma once

#include <string_view>

#include "glsum/wrap/delta.hpp"

namespace glsum {

struct Integrator {
    static constexpr std::string_view word = "modessum";
    static constexpr std::string_view text = "integrator";
    using kept = Modes;
    static constexpr Family family = exponentials_family;
    static constexpr bool contiguous = true;

    template <class State, class Says>
    static void constants(const Design&, const State& state, Says&& says) {
        says("weight", state.weight);
    }
};

template <>
inline constexpr bool keeps_modes<Integrator> = true;

/// Whether the slowest mode of a history does not decay.
template <class History>
inline constexpr bool has_integrator = false;
template <>
inline constexpr bool has_integrator<Integrator> = true;

}  // namespace glsum
