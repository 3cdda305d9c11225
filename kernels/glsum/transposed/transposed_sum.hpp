// Sum<Transposed, Technique, Format>: a window as the sums to come (transposed/transposed.hpp).
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "glsum/transposed/transposed.hpp"
#include "glsum/window/oldest.hpp"
#include "glsum/window/ring.hpp"
#include "glsum/window/window_sum.hpp"

namespace glsum {

template <class Technique, class Format>
struct Sum<Transposed, Technique, Format> : SumOf<Transposed, Technique, Format> {
    static_assert(std::is_same_v<Technique, Oldest>, "a sum to come takes its oldest term first");

    /// The ring of as many numbers, with the same table: samples there, sums here.
    using Inner = Sum<Ring, Technique, Format>;
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;
    using State = typename Inner::State;
    static_assert(std::is_same_v<Sample, typename Format::Accumulator>, "sums lie where a window's samples do");

    static constexpr std::size_t table_count(std::size_t taps) { return Inner::table_count(taps); }
    static constexpr std::size_t past_count(std::size_t taps) { return Inner::past_count(taps); }

    /// Multiplications for one output.
    static constexpr std::size_t multiplications(std::size_t taps) { return Inner::multiplications(taps); }

    /// Makes the table for the design and clears the sums. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);
    /// The same in two halves, in this order, with the same sample: S_k by one addition, and then what coming sums
    /// need.
    static Output answer(State& state, Sample newest);
    static void settle(State& state, Sample newest);
};

}  // namespace glsum
