// The filter that a kernel really holds: its table read back, with what the format's rounding made of a design.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "glsum/design/filter.hpp"
#include "glsum/exponentials/integrator_sum.hpp"
#include "glsum/exponentials/modes_sum.hpp"

namespace glsum::design {

/// Of near taps and decaying averages: S_k, a_0 = 1, before w_0 h^-v. A fixed-point decay is its mantissa and shift.
template <class Technique, class Format>
[[nodiscard]] Filter held(const typename Sum<Modes, Technique, Format>::State& state) {
    using K = Sum<Modes, Technique, Format>;
    double unit = 1.0;
    if constexpr (Format::fixed_point) {
        unit = std::ldexp(1.0, state.scale.table_exponent - Format::coefficient_bits);
    }
    Filter filter{{1.0}, {}};
    const auto* at = state.table;
    for (std::size_t j = 0; j < state.near_samples; ++j) {
        filter.taps.push_back(static_cast<double>(*at++) * unit);
    }
    for (std::size_t m = 0; m < state.modes; ++m, at += K::coefficients_of_mode) {
        double decay = static_cast<double>(at[0]);
        if constexpr (Format::fixed_point) {
            decay = std::ldexp(decay, -static_cast<int>(at[1]));
        }
        const double gain = static_cast<double>(at[K::coefficients_of_mode - 1]) * unit;
        filter.modes.insert(filter.modes.begin(), Mode{decay, gain * decay});
    }
    return filter;
}

/// The same with an integrator as its slowest mode.
template <class Technique, class Format>
[[nodiscard]] Filter held_with_integrator(const typename Sum<Integrator, Technique, Format>::State& state) {
    Filter filter = held<Technique, Format>(state);
    if (state.weight != 0) {
        filter.modes.insert(filter.modes.begin(), Mode{0.0, static_cast<double>(state.weight)});
    }
    return filter;
}

}  // namespace glsum::design
