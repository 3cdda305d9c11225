// The filter that a kernel really holds: its table read back, with what the format's rounding made of a design.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "glsum/design/filter.hpp"
#include "glsum/exponentials/integrator_sum.hpp"
#include "glsum/exponentials/modes_sum.hpp"
#include "glsum/filter/cascade_sum.hpp"
#include "glsum/filter/section_rounding.hpp"

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

/// Of a cascade in parallel form, by partial fractions: its poles are real, or `prepare` would have refused it.
template <class Technique, class Format>
[[nodiscard]] Filter held_in_parallel(const typename Sum<Cascade, Technique, Format>::State& state) {
    constexpr bool fixed = Format::fixed_point;
    const double coefficient_unit = fixed ? std::ldexp(1.0, -section_bits) : 1.0;
    double tap_unit = 1.0;
    if constexpr (fixed) {
        tap_unit = std::ldexp(1.0, state.scale.table_exponent - Format::coefficient_bits);
    }
    Filter filter{{1.0}, {}};
    const auto* at = state.table;
    for (std::size_t j = 0; j < state.near_samples; ++j) {
        filter.taps.push_back(static_cast<double>(*at++) * tap_unit);
    }
    // prod (e - d) over the zeros e of a section, and over its poles, as polynomials in d = 1 - z.
    struct Polynomials {
        HeldSection of;
        bool single;
        [[nodiscard]] double zeros(double d) const { return at(d, of.b1, of.b2); }
        [[nodiscard]] double poles(double d) const { return at(d, of.a1, of.a2); }
        [[nodiscard]] double at(double d, double first, double second) const {
            return single ? (1.0 + first) - d : (1.0 + first + second) - d * ((2.0 + first) - d);
        }
    };
    std::vector<Polynomials> sections;
    double whole_scale = 1.0;
    for (std::size_t left = state.modes; left > 0;) {
        const bool single = left % 2 != 0;
        const auto next = [&](bool there) { return there ? static_cast<double>(*at++) * coefficient_unit : 0.0; };
        HeldSection held{};
        held.b0 = fixed ? next(true) : 1.0;
        held.b1 = next(true) / held.b0;
        held.b2 = next(fixed || !single) / held.b0;
        held.a1 = -next(true);
        held.a2 = -next(fixed || !single);
        whole_scale *= held.b0;
        sections.push_back({held, single});
        left -= single ? 1 : 2;
    }
    if (state.near_samples != 0) {
        filter.taps.back() *= whole_scale;
    }
    for (std::size_t s = 0; s < sections.size(); ++s) {
        // Named, not bound: clang before 16 captures no structured binding.
        const HeldSection& of = sections[s].of;
        const bool single = sections[s].single;
        // d^2 - (2 + a1) d + (1 + a1 + a2) = 0, the larger root first: the smaller would lose its digits.
        const double sum = 2.0 + of.a1;
        const double product = 1.0 + of.a1 + of.a2;
        const double fast = single ? 1.0 + of.a1 : 0.5 * (sum + std::sqrt(sum * sum - 4.0 * product));
        const double slow = single ? fast : product / fast;
        const auto add = [&](double decay, double other) {
            double weight = filter.taps.back();
            for (std::size_t i = 0; i < sections.size(); ++i) {
                const double below = i != s ? sections[i].poles(decay) : single ? 1.0 : other - decay;
                weight *= sections[i].zeros(decay) / below;
            }
            filter.modes.push_back({decay, weight});
        };
        add(fast, slow);
        if (!single) {
            add(slow, fast);
        }
    }
    std::sort(filter.modes.begin(), filter.modes.end(), [](const Mode& a, const Mode& b) { return a.decay < b.decay; });
    return filter;
}

}  // namespace glsum::design
