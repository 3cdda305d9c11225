// What rounding costs a cascade: of its sections as filter/section_rounding.hpp derives it; then, where there are other
// near taps, as a window's term for each of these and for the cascade's output behind the last of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/error_bound.hpp"
#include "glsum/filter/cascade_sum.hpp"
#include "glsum/filter/section_rounding.hpp"
#include "glsum/weights.hpp"

namespace glsum {

template <class Technique, class Format>
struct ErrorBound<Sum<Cascade, Technique, Format>> {
    using K = Sum<Cascade, Technique, Format>;

    static double of(const Design& design, const typename K::State& state, double peak, std::size_t) {
        const std::size_t near_taps = design.taps - 2 * design.modes.size();
        CascadeError<Format> walked(peak, design.modes.empty() ? 1.0 : design.modes.back().decay);
        (void)for_each_section<Format>(design, [&](const HeldSection& held, const SectionPlace& place) {
            walked.pass(place.exact, held, place.down, place.scale_bits);
            return true;
        });
        if (near_taps == 1 && !design.modes.empty()) {
            return walked.error();
        }
        Weights weights(design);
        if constexpr (Format::fixed_point) {
            const double coefficient = std::ldexp(1.0, state.scale.table_exponent - Format::coefficient_bits - 1);
            double absolute = 1.0;
            double last = 1.0;
            for (std::size_t j = 1; j < near_taps; ++j) {
                weights.next();
                last = std::fabs(weights.weight());
                absolute += j + 1 < near_taps ? last : 0.0;
            }
            const double of_cascade = near_taps == 1 ? 0.0 : last * walked.error() + coefficient;
            const double of_others = near_taps < 3 ? 0.0 : peak * static_cast<double>(near_taps - 2) * coefficient;
            return of_others + of_cascade + std::ldexp(absolute, -Format::sample_bits - 1) +
                   std::ldexp(1.0, state.scale.output_exponent - 32);
        } else {
            constexpr double u = Format::data_roundoff;
            const auto growth = [&](std::size_t roundings) {
                return std::expm1(static_cast<double>(roundings) * std::log1p(u));
            };
            // x_0 is rounded once and passes every addition; the others their coefficient and product, too.
            double bound = peak * growth(near_taps);
            for (std::size_t j = 1; j < near_taps; ++j) {
                weights.next();
                const double weight = std::fabs(weights.weight());
                const std::size_t behind = near_taps - j;  // additions
                bound +=
                    j + 1 < near_taps
                        ? weight * peak * growth(behind + 3)
                        : weight * (walked.error() * (1.0 + growth(behind + 2)) + walked.reach() * growth(behind + 2));
            }
            constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
            return bound + static_cast<double>(near_taps) * denormal;
        }
    }
};

}  // namespace glsum
