// Sum<Delta<Kept>, Technique, Format>: of increments (wrap/delta.hpp): the sum of one order less, over what it
// keeps.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "glsum/exponentials/modes_sum.hpp"
#include "glsum/filter/cascade_sum.hpp"
#include "glsum/window/window_sum.hpp"
#include "glsum/wrap/delta.hpp"

namespace glsum {

template <class Kept, class Technique, class Format>
struct Sum<Delta<Kept>, Technique, Format> : SumOf<Delta<Kept>, Technique, Format> {
    /// The sum of order v - 1.
    using Inner = Sum<Kept, Technique, Format>;
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;

    struct State : Inner::State {
        Sample before;  // x_(k-1)
    };

    static constexpr std::size_t table_count(std::size_t taps) { return Inner::table_count(taps); }
    static constexpr std::size_t past_count(std::size_t taps) { return Inner::past_count(taps); }
    // Templates: a compiler may instantiate with the class what is none, whatever it requires.
    template <class Kind = Inner>
    requires keeps_modes<Kept>
    static constexpr std::size_t table_count(std::size_t taps, std::size_t modes) {
        return Kind::table_count(taps, modes);
    }
    template <class Kind = Inner>
    requires keeps_modes<Kept>
    static constexpr std::size_t past_count(std::size_t taps, std::size_t modes) {
        return Kind::past_count(taps, modes);
    }

    /// Multiplications for one output; a subtraction besides.
    static constexpr std::size_t multiplications(std::size_t taps) { return taps - 1; }

    static constexpr bool order_in_range(double order) { return order > -1.0 && order <= 2.0; }
    /// What the inner sum is prepared for. v - 1 is exact for v >= 0.5.
    static constexpr Design inner_design(const Design& design) {
        return {design.order - 1.0, design.taps, design.modes, design.weights};
    }

    /// Makes the table for the design and clears the past. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past and the count of saturations: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);

    /// In fixed point samples have half of their scale, and outputs twice it.
    static Sample from_real(double real) { return Format::from_real(real / scale_); }
    static double to_real(const State& state, Output output) { return scale_ * Format::to_real(output, state.scale); }

private:
    static constexpr double scale_ = Format::fixed_point ? 2.0 : 1.0;
};

}  // namespace glsum
