// Sum<Nested, Plain, Format>: near taps and sums over growing blocks (logmemory/nested.hpp) in place of a window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "glsum/logmemory/nested.hpp"
#include "glsum/sum.hpp"
#include "glsum/window/plain.hpp"

namespace glsum {

template <class Technique, class Format>
struct Sum<Nested, Technique, Format> : SumOf<Nested, Technique, Format> {
    static_assert(std::is_same_v<Technique, Plain>, "a few dozen terms: their order makes no difference that shows");

    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;

    struct State {
        const Coefficient* table;    // a_1 ... a_(K-1), then each block's mean of a_j, newest first; q31: its sum
        Sample* past;                // the delay lines, behind one another in one ring
        std::uint32_t past_samples;  // R - 1, the ring's length
        std::uint32_t head;          // where x_(k-1) lies
        std::uint32_t near_samples;  // K - 1
        std::uint32_t blocks;        // M
        std::uint32_t per_level;     // B
        typename Format::Scale scale;
    };

    /// Coefficients, and samples of the past, that a design needs.
    static constexpr std::size_t table_count(const Design& design) { return design.taps - 1; }
    static constexpr std::size_t past_count(const Design& design) {
        const std::size_t reach = reach_of(design);
        return reach > most_reach && design.blocks.count > 0 ? 0 : reach - 1;  // refused
    }
    /// The same for whatever reaches at most so many lags.
    static constexpr std::size_t table_count(std::size_t reach) { return reach - 1; }
    static constexpr std::size_t past_count(std::size_t reach) { return reach - 1; }

    /// Multiplications for one output; an addition a level besides.
    static constexpr std::size_t multiplications(std::size_t taps) { return taps - 1; }

    /// Makes the table for the design and clears the past. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past and the count of saturations: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);
};

}  // namespace glsum
