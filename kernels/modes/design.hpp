// The Grünwald-Letnikov weights of one order: a few exact taps and a few decaying exponentials, for a given error.
#pragma once

#include <cstddef>
#include <optional>

#include "modes/mode.hpp"

namespace glsum::modes {

/// What is approximated, and how well.
struct Target {
    double order;         ///< v in (-1, 2), no integer
    std::size_t horizon;  ///< N >= 1: the last index j that counts
    double error;         ///< bound of sum_{j=K..N} |a_j - approximation|: of the output, for |x| <= 1, before h^-v
};

/// With these numbers of taps and modes; all weights have the sign of the tail. Fewer modes come back when the tail has
/// no more in it. \pre near_taps >= least_near_taps(target.order); target.error says how fine the trapezoid is.
[[nodiscard]] Approximation approximate(const Target& target, std::size_t near_taps, std::size_t modes);

/// The cheapest that meets the target, over K from the least up to 64 and M up to 40; empty if none does.
[[nodiscard]] std::optional<Approximation> design(const Target& target);

}  // namespace glsum::modes
