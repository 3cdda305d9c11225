// What rounding costs a kernel with modes, with u the roundoff of its data (2^-24 in f32) and P the peak of the input.
//
// An average s <- s + d (x - s) forgets: an error e made at each step adds up to e/f at most, f = 1 - |1 - d|. It
// reaches A P, A = d/f: 1 up to d = 1.
//   d        |d' - d| <= u d moves the exponential's weights d (1-d)^j by (A + A^2) u in all: 2u up to d = 1
//   step     x - s and the product: 2u of d (1+A) P at each step, 2 A (1+A) u P in all: 4u P
//   state    plain: u A P at each step, u A P/f in all. compensated: nothing of first order: what the addition lost
//            waits for the next step (rounding of that sum: 2u, of the loss itself: 4u, both of second order beyond),
//            is missing in the difference (u) and in the output (u); each of them at most A^2 times as much beyond d =
//            1
//   q31      d to 2^-30 of itself; the step exact, and half a unit, 2^-32, for the state: 2^-32/d in all
// A term of the sum then passes its coefficient, its product and the additions behind it, as with a window.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/error_bound.hpp"
#include "glsum/exponentials/modes_sum.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// A: what a mode's average reaches, relative to the peak. \param decay  d, and in floating point what it is rounded to
template <class K>
[[nodiscard]] double average_reach(double decay) {
    using Format = typename K::FormatPart;
    if (decay <= 1.0) {
        return 1.0;
    }
    const double rounded_up = decay * (1.0 + Format::data_roundoff);
    return rounded_up < 2.0 ? rounded_up / forgets(rounded_up) : std::numeric_limits<double>::infinity();
}

/// Bound of |average - exact average of the design's exponential|, relative to the peak.
template <class K>
[[nodiscard]] double average_error(double decay, double peak) {
    using Format = typename K::FormatPart;
    if constexpr (Format::fixed_point) {
        return 0x1p-29 + 0x1p-32 / decay / peak;
    } else {
        constexpr double u = Format::data_roundoff;
        constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
        const double reach = average_reach<K>(decay);
        const double left = decay <= 1.0 ? decay : decay / reach;  // f, of what d is rounded to
        const double once = (K::compensated ? (14.0 * u + 4.0 * u * u / left) * reach * reach
                                            : 3.0 * u * reach * (1.0 + reach) + u * reach / left) +
                            denormal / left / peak;
        return once < 1.0 ? once / (1.0 - once) : std::numeric_limits<double>::infinity();  // |average| <= P (A + it)
    }
}

template <class Technique, class Format>
struct ErrorBound<Sum<Modes, Technique, Format>> {
    using K = Sum<Modes, Technique, Format>;

    static double of(const Design& design, const typename K::State& state, double peak, std::size_t) {
        const std::size_t near_taps = design.taps - 2 * design.modes.size();
        const std::size_t terms = near_taps + design.modes.size();  // of the sum, x_k included
        Weights weights(design);
        if constexpr (Format::fixed_point) {
            const double coefficient = std::ldexp(1.0, state.scale.table_exponent - Format::coefficient_bits - 1);
            double absolute = 1.0;
            double averages = 0.0;
            for (std::size_t j = 1; j < near_taps; ++j) {
                weights.next();
                absolute += std::fabs(weights.weight());
            }
            for (const Mode& mode : design.modes) {
                const double gain = std::fabs(mode.weight / mode.decay);
                absolute += gain;
                averages += (gain + coefficient) * average_error<K>(mode.decay, peak);
            }
            return peak * (averages + static_cast<double>(terms - 1) * coefficient) +
                   std::ldexp(absolute, -Format::sample_bits - 1) + std::ldexp(1.0, state.scale.output_exponent - 32);
        } else {
            // Of term t, x_k being 0: input, its coefficient, product and the additions from its own on.
            const auto growth = [&](std::size_t t, double average) {
                const double data = t == 0 ? 1.0 : 2.0;
                const auto sum = static_cast<double>(t == 0 ? terms - 1 : terms - t + 1);
                return std::expm1(data * std::log1p(Format::data_roundoff) + sum * std::log1p(Format::sum_roundoff) +
                                  std::log1p(average));
            };
            double bound = growth(0, 0.0);
            for (std::size_t j = 1; j < near_taps; ++j) {
                weights.next();
                bound += growth(j, 0.0) * std::fabs(weights.weight());
            }
            for (std::size_t m = 0; m < design.modes.size(); ++m) {
                const Mode& mode = design.modes[m];  // the slowest is summed last
                const double reach = average_reach<K>(mode.decay);
                bound += growth(terms - 1 - m, average_error<K>(mode.decay, peak) / reach) * reach *
                         std::fabs(mode.weight / mode.decay);
            }
            constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
            return peak * bound + static_cast<double>(terms) * denormal;
        }
    }
};

}  // namespace glsum
