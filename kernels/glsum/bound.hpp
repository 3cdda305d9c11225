// The error bound that a kernel promises, from its parts: the number that its test enforces.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "glsum/exponentials/integral_bound.hpp"
#include "glsum/exponentials/modes_bound.hpp"
#include "glsum/kernel.hpp"
#include "glsum/logmemory/nested_bound.hpp"
#include "glsum/weights.hpp"
#include "glsum/wrap/delta_bound.hpp"
#include "glsum/wrap/tail_bound.hpp"

namespace glsum {

/// Roundings that the term of a_j passes: as the kernel says, else as its technique does.
template <class K>
[[nodiscard]] constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
    if constexpr (requires { K::sum_roundings(j, taps); }) {
        return K::sum_roundings(j, taps);
    } else {
        return K::TechniquePart::template sum_roundings<typename K::FormatPart>(j, taps);
    }
}

/// Floating point: of a window of the design's taps, each term of which passes so many further additions.
template <class K>
[[nodiscard]] double window_error_bound(const Design& design, double peak, std::size_t further = 0) {
    using Format = typename K::FormatPart;
    using Technique = typename K::TechniquePart;
    // (1 + data)^(coefficients + input) (1 + sum)^operations (1 + output) - 1
    const auto growth = [&](std::size_t j) {
        const auto data = static_cast<double>(Technique::coefficient_roundings(j) + 1);
        const auto sum = static_cast<double>(sum_roundings<K>(j, design.taps) + further);
        return std::expm1(data * std::log1p(Format::data_roundoff) + sum * std::log1p(Format::sum_roundoff) +
                          std::log1p(Format::output_roundoff));
    };
    double bound = growth(0);
    Weights weights(design);
    for (std::size_t j = 1; j < design.taps; ++j) {
        weights.next();
        bound += growth(j) * std::fabs(weights.weight());
    }
    // Products below the smallest normal number lose half of the smallest denormal one.
    constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
    return peak * bound + static_cast<double>(design.taps) * denormal;
}

/// What `error_bound` is for unless it is told otherwise: the longest record, in samples.
inline constexpr std::size_t longest_record = 1'000'000;

/// Bound of |S - exact|, where exact is the sum of the same length with exact coefficients over the real-valued
/// input, |x| <= peak (in fixed point also peak < 1), so that the rounding of the input counts too.
/// With modes or blocks the exact sum is that of the design's own taps and exponentials or blocks; of increments, and
/// of a window with a guessed tail, it is the sum that their history states, with exact weights. Derivation:
/// exponentials/modes_bound.hpp, logmemory/nested_bound.hpp, wrap/delta_bound.hpp, exponentials/integral_bound.hpp,
/// wrap/tail_bound.hpp, and the headers of the technique (floating point) and of format/fixed.hpp. Absolute, before
/// h^-v. \param samples  of the record, for kernels whose weights are carried along it; others do not look at it
template <class K>
[[nodiscard]] double error_bound(const Design& design, const typename K::State& state, double peak,
                                 std::size_t samples = longest_record) {
    using Format = typename K::FormatPart;
    using Technique = typename K::TechniquePart;
    if constexpr (keeps_increments<typename K::HistoryPart>) {
        return delta_error_bound<K>(design, peak, [&](const Design& inner, double largest) {
            return error_bound<typename K::Inner>(inner, state, largest);
        });
    } else if constexpr (keeps_running_sum<typename K::HistoryPart>) {
        return integral_error_bound<K>(design, peak, samples, [&](const Design& inner) {
            return error_bound<typename K::Inner>(inner, state, peak, samples);
        });
    } else if constexpr (guesses_tail<typename K::HistoryPart>) {
        constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
        return window_error_bound<K>(design, peak, K::HistoryPart::to_first ? 2 : 1) +
               peak * tail_error<K>(design, samples) + 8.0 * denormal;
    } else if constexpr (std::is_same_v<typename K::HistoryPart, Modes>) {
        return modes_error_bound<K>(design, state, peak);
    } else if constexpr (keeps_blocks<typename K::HistoryPart>) {
        return nested_error_bound<K>(design, state, peak);
    } else if constexpr (Format::fixed_point) {
        return Technique::template fixed_error<Format>(design, state.scale, peak) +
               std::ldexp(absolute_sum(design, design.taps), -Format::sample_bits - 1) +
               std::ldexp(1.0, state.scale.output_exponent - 32);
    } else {
        return window_error_bound<K>(design, peak);
    }
}

}  // namespace glsum
