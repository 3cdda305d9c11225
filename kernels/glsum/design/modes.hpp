// The Grünwald-Letnikov weights of one order: a few exact taps and a few decaying exponentials, for a given error.
#pragma once

#include <cstddef>
#include <optional>

#include "glsum/design/mode.hpp"

namespace glsum::design {

/// What is approximated.
struct Tail {
    double order;         ///< v in (-2, 2]
    std::size_t horizon;  ///< N >= 1: the last index j that counts
};

/// Whether the order has a tail that is a mixture of exponentials: v > -1 and no integer. The weights of integer orders
/// v >= 0 end, and those of v <= -1 do not fall.
[[nodiscard]] bool has_tail(double order);

/// M of a design of L = K + 2M coefficients: as many as leave the fewest taps that the integral needs, or one more. The
/// near taps are hardly worth more than that at any error; 0 where there is no tail, at most `most_modes`.
[[nodiscard]] std::size_t modes_within(double order, std::size_t taps);
inline constexpr std::size_t most_modes = 40;

/// The largest L that gains anything over L - 2: what lies beyond has no more modes.
[[nodiscard]] std::size_t most_taps(double order);

/// With these numbers of taps and modes; all weights have the sign of the tail. Fewer modes come back when the tail has
/// no more in it. The same arguments give the same table. \pre near_taps >= 1, and where there are modes, has_tail and
/// near_taps >= least_near_taps(tail.order).
[[nodiscard]] Approximation approximate(const Tail& tail, std::size_t near_taps, std::size_t modes);

/// The smallest L whose `modes_within` keep sum_{j=K..N} |a_j - approximation| (the error of the output, for |x| <= 1,
/// before h^-v) within `error`; empty if none does.
[[nodiscard]] std::optional<Approximation> design_modes(const Tail& tail, double error);

}  // namespace glsum::design
