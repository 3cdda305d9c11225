// mirrordelta, modesdelta, cascadedelta: in place of the samples their increments d_k = x_k - x_(k-1), with x = 0
// before k = 0. Since (1-z)^v = (1-z)^(v-1) (1-z), the sum of order v is that of order v - 1 over the increments,
//
//   S_k = d_k + b_1 d_(k-1) + ... + b_(L-1) d_(k-L+1),     b_j the weights of order v - 1,
//
// and what is forgotten is how far the signal moved, not where it is: for v > 0 the samples behind the L-th act as if
// all, for ever before, had been x_(k-L). A level that lasts has a sum of 0, as it must in the end; what the sum misses
// of a step is a_0 + ... + a_k, which fades as k^-v, where a window's error grows to a_0 + ... + a_(L-1) and stays.
// For v <= 0 that is no memory of the signal: the level that a long integral adds up is lost with the increments, and
// only full length serves.
//
// Order: v in (-1, 2], so that v - 1 is one of a kernel. `Design::weights`, where named, and `Design::modes` are those
// of the increments; with modes, v in (0, 2] without the whole numbers has a tail.
// Range, floating point: as the format's; the increment is one rounded subtraction. Fixed point: samples are held at
// half of their scale (x / 2 as a fraction, the output twice the sum), so that the increment of |x| <= 1 - 2^-n, n the
// bits of a sample, always fits; from_real saturates beyond |x| = 2, an increment beyond 2 saturates and is counted.
// Error: wrap/delta_bound.hpp.
#pragma once

#include <string_view>
#include <type_traits>

#include "glsum/exponentials/modes.hpp"
#include "glsum/filter/cascade.hpp"
#include "glsum/window/mirror.hpp"

namespace glsum {

/// Increments, kept as `Kept` keeps samples.
template <class Kept>
struct Delta {
    static_assert(std::is_same_v<Kept, Mirror> || std::is_same_v<Kept, Modes> || std::is_same_v<Kept, Cascade>);
    static constexpr std::string_view word = std::is_same_v<Kept, Mirror>  ? "mirrordelta"
                                             : std::is_same_v<Kept, Modes> ? "modesdelta"
                                                                           : "cascadedelta";
    static constexpr std::string_view text = "delta";
    using kept = Kept;
    static constexpr Family family = Kept::family;
    static constexpr Forgotten forgotten = Forgotten::increments;
    static constexpr bool contiguous = Kept::contiguous;

    template <class State, class Says>
    static void constants(const Design&, const State&, Says&& says) {
        says("increments", true);
    }
};
using MirrorDelta = Delta<Mirror>;
using ModesDelta = Delta<Modes>;
using CascadeDelta = Delta<Cascade>;

template <class History>
inline constexpr bool keeps_increments = false;
template <class Kept>
inline constexpr bool keeps_increments<Delta<Kept>> = true;

/// Whether a history takes modes in place of a long window.
template <class History>
inline constexpr bool keeps_modes = false;
template <>
inline constexpr bool keeps_modes<Modes> = true;
template <>
inline constexpr bool keeps_modes<Cascade> = true;
template <class Kept>
inline constexpr bool keeps_modes<Delta<Kept>> = keeps_modes<Kept>;

}  // namespace glsum
