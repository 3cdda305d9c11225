// Sum<Guess<to_first>, Technique, Format>: of a window and a guess of what it dropped (wrap/tail.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "glsum/window/window_sum.hpp"
#include "glsum/wrap/tail.hpp"

namespace glsum {

template <bool to_first, class Technique, class Format>
struct Sum<Guess<to_first>, Technique, Format> : SumOf<Guess<to_first>, Technique, Format> {
    /// The window alone.
    using Inner = Sum<Mirror, Technique, Format>;
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;
    static_assert(std::is_floating_point_v<Coefficient> && std::is_same_v<typename Format::Accumulator, Coefficient>,
                  "the recurrences are in the format's own precision");

    /// H_k, and the sample at the other end of the line.
    struct ToFirst {
        Carried<Coefficient> mean;
        Sample first;
    };
    struct Alone {};

    struct State : Inner::State {
        Coefficient minus_order;    // -v
        Coefficient in_window;      // A = a_0 + ... + a_(L-1)
        std::uint32_t count;        // k: samples so far
        Carried<Coefficient> tail;  // T_k
        [[no_unique_address]] std::conditional_t<to_first, ToFirst, Alone> line;
    };

    static constexpr std::uint32_t last_count = std::numeric_limits<std::uint32_t>::max();

    static constexpr std::size_t table_count(std::size_t taps) { return Inner::table_count(taps); }
    static constexpr std::size_t past_count(std::size_t taps) { return Inner::past_count(taps); }

    /// Multiplications for one output, those of the recurrence among them; a division (two with a line) besides.
    static constexpr std::size_t multiplications(std::size_t taps) { return taps + (to_first ? 2 : 1); }

    /// Makes the table for the design and clears the past. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past: x = 0 before the next sample, with which the record begins.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);
};

}  // namespace glsum
