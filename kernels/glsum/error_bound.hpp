// What a kernel's rounding costs at most: asked here, answered by each family in its `..._bound.hpp`.
#pragma once

#include <cstddef>

#include "glsum/kernel.hpp"

namespace glsum {

/// What `error_bound` is for unless it is told otherwise: the longest record, in samples.
inline constexpr std::size_t longest_record = 1'000'000;

/// A family's answer: static double of(design, state, peak, samples), which says what `error_bound` does.
template <class K>
struct ErrorBound;

/// Bound of |S - exact|, where exact is the sum of the same length with exact coefficients over the real-valued
/// input, |x| <= peak (in fixed point also peak < 1), so that the rounding of the input counts too.
/// With modes or blocks the exact sum is that of the design's own taps and exponentials or blocks; of increments, and
/// of a window with a guessed tail, it is the sum that their history states, with exact weights. Derivation:
/// in the family's own header, and in those of the technique (floating point) and of format/fixed.hpp. Absolute, before
/// h^-v. \param samples  of the record, for kernels whose weights are carried along it; others do not look at it
template <class K>
[[nodiscard]] double error_bound(const Design& design, const typename K::State& state, double peak,
                                 std::size_t samples = longest_record) {
    return ErrorBound<K>::of(design, state, peak, samples);
}

}  // namespace glsum
