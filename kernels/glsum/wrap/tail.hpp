// mirrorhold, mirrorlinear: a window of L taps, and in place of every sample that it dropped a guess from those that
// are kept. In k the record has begun k samples ago, so that k - L + 1 samples, x_(k-L) ... x_0, are guessed:
//
//   mirrorhold    each is x_(k-L+1), the oldest kept:           S_k = sum_{j<L} a_j x_(k-j) + T_k x_(k-L+1)
//   mirrorlinear  on the line from x_(k-L+1) to the first, x_0:  S_k = sum_{j<L} a_j x_(k-j) + H_k x_(k-L+1) + U_k x_0
//
//   T_k = sum_{j=L..k} a_j,   U_k = sum_{j=L..k} a_j (j-L+1)/n,   H_k = T_k - U_k,   n = k - L + 1
//
// Hold is exact for a step, the line for a step and a ramp. Where the weights behind L have one sign (L > v), H and U
// have it too: |H| + |U| = |T|, so whatever the signal, the line errs by no more than a guess within the range of the
// samples can. An extrapolation from the two oldest samples would have weights that grow with k.
//
// The weights are carried along, in the format's own precision, by two recurrences without a table or a power:
//
//   T_k = T_(k-1) - (A + T_(k-1)) v / k,       A = a_0 + ... + a_(L-1): the bracket is a_0 + ... + a_(k-1)
//
//   H_k = H_(k-1) + (T_(k-1) - H_(k-1)) / n,   the mean of all T before,
//
// each with a carry word (Carried), from T_(L-1) = H_L = 0 on. They do not add up rounding errors, as a_k = a_(k-1)
// (k-1-v)/k does: an error of T enters the next step times 1 - v/k. So, with u the roundoff of the format and to first
// order in it, T errs for v >= 0 by at most 11 u sum_{j=L..k} |a_j|, however long the record is; for v < 0, where T
// grows as k^-v, by 11 u |v| (1/L + ln(k/L)) (A + T). Of second order, k u^2 |T| at most. The bound
// (wrap/tail_bound.hpp) walks both recurrences and takes every rounding into account.
//
// k is counted to 2^32 - 1; then T, H and U stay as they are. Range and overflow: as the format's, floating point only.
// Order: as a window's. Named weights are refused: they do not say what lies behind them.
// Order of summation: the window as its technique sums it, then the oldest sample's term, then the first's.
#pragma once

#include <string_view>

#include "glsum/window/mirror.hpp"

namespace glsum {

/// A mirrored window, with a guess of what it dropped: its oldest sample, or the line from that to the first.
template <bool to_first_>
struct Guess {
    static constexpr bool to_first = to_first_;
    static constexpr std::string_view word = to_first ? "mirrorlinear" : "mirrorhold";
    static constexpr std::string_view text = "tail";
    using kept = Mirror;
    static constexpr Family family = Mirror::family;
    static constexpr Forgotten forgotten = to_first ? Forgotten::line : Forgotten::held;
    static constexpr bool contiguous = true;

    template <class State, class Says>
    static void constants(const Design&, const State& state, Says&& says) {
        says("in_window", state.in_window);
        says("minus_order", state.minus_order);
        says("line", to_first);
    }
};
using MirrorHold = Guess<false>;
using MirrorLinear = Guess<true>;

template <class History>
inline constexpr bool guesses_tail = false;
template <bool to_first>
inline constexpr bool guesses_tail<Guess<to_first>> = true;

/// A number and what its last addition lost, which waits for the next one [Knuth]: value + lost is exact but for the
/// rounding of step + lost.
template <class Number>
struct Carried {
    Number value;
    Number lost;

    void add(Number step) {
        // C99: carried
        const Number whole = step + lost;
        const Number after = value + whole;
        const Number part = after - value;
        lost = (value - (after - part)) + (whole - part);
        value = after;
        // C99 end
    }
};

}  // namespace glsum
