// Sum<Integrator, Technique, Format>: near taps and modes, and an integrator (exponentials/integrator.hpp).
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "glsum/exponentials/integrator.hpp"
#include "glsum/exponentials/modes_sum.hpp"
#include "glsum/sum.hpp"

namespace glsum {

template <class Technique, class Format>
struct Sum<Integrator, Technique, Format> : SumOf<Integrator, Technique, Format> {
    static_assert(!Format::fixed_point, "an integrator outgrows every scale");

    /// The near taps and the modes that decay.
    using Inner = Sum<Modes, Technique, Format>;
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;

    struct State : Inner::State {
        Coefficient weight;  // w_0; 0 without modes
        Sample total;        // r as far as one word holds it
        Sample lost;         // and the rest
    };

    static constexpr std::size_t table_count(std::size_t taps) { return Inner::table_count(taps); }
    static constexpr std::size_t past_count(std::size_t taps) { return Inner::past_count(taps); }
    /// \param modes  the integrator among them
    static constexpr std::size_t table_count(std::size_t taps, std::size_t modes) {
        return modes == 0 ? Inner::table_count(taps, 0) : Inner::table_count(taps - 2, modes - 1);
    }
    static constexpr std::size_t past_count(std::size_t taps, std::size_t modes) {
        return modes == 0 ? Inner::past_count(taps, 0) : Inner::past_count(taps - 2, modes - 1);
    }

    /// Multiplications for one output, with modes.
    static constexpr std::size_t multiplications(std::size_t taps) { return taps < 3 ? taps - 1 : taps - 2; }

    /// What the inner sum is prepared for.
    static constexpr Design inner_design(const Design& design) {
        return design.modes.empty()
                   ? design
                   : Design{design.order, design.taps - 2, design.modes.subspan(1), design.weights, design.blocks};
    }

    /// Makes the table for the design and clears the past. On failure the state is as it was. The first mode's decay
    /// must be 0, and no other's.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);
};

}  // namespace glsum
