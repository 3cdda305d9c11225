// Sum<Block, Technique, Format>: a window summed for four coming outputs at once (lookahead/block.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "glsum/lookahead/block.hpp"
#include "glsum/sum.hpp"
#include "glsum/window/oldest.hpp"
#include "glsum/window/plain.hpp"

namespace glsum {

template <class Technique, class Format>
struct Sum<Block, Technique, Format> : SumOf<Block, Technique, Format> {
    static constexpr bool fused = Technique::fused;
    static_assert(std::is_same_v<Technique, OldestFma> || (std::is_same_v<Technique, Plain> && Format::fixed_point),
                  "what waits is oldest first; in fixed point no order shows");

    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;
    using Accumulator = typename Format::Accumulator;
    static constexpr std::size_t phases = Block::phases;

    struct State {
        const Coefficient* table;    // a_1 ... a_(L-1), and 0s up to 4 G + 3 of them
        Sample* past;                // groups of four samples as they came: a ring of G groups
        std::uint32_t past_samples;  // L - 1
        std::uint32_t groups;        // G
        std::uint32_t own;           // place of the group that x_k belongs to
        std::uint32_t phase;         // how many samples of it are there
        std::uint32_t left;          // groups that the coming outputs still lack
        Accumulator ready[phases];   // of the outputs of this group, all products with older groups
        Accumulator coming[phases];  // of the next group's, as far as they are
        typename Format::Scale scale;
    };

    /// Coefficients, and samples of the past, that a length of at most `taps` needs.
    static constexpr std::size_t table_count(std::size_t taps) {
        return taps == 1 ? 0 : phases * Block::groups(taps - 1) + phases - 1;
    }
    static constexpr std::size_t past_count(std::size_t taps) { return phases * Block::groups(taps - 1); }

    /// Multiplications for one output, in the mean of a group, rounded up.
    static constexpr std::size_t multiplications(std::size_t taps) {
        return taps == 1 ? 0 : phases * Block::groups(taps - 1) + 2;
    }

    /// Makes the table for the design and clears the past. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past and the count of saturations: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);
    /// The same in two halves, in this order, with the same sample: S_k as soon as x_k is there, and then what coming
    /// sums need. The first takes at most three products whatever the length.
    static Output answer(State& state, Sample newest);
    static void settle(State& state, Sample newest);

private:
    template <std::size_t outputs, std::size_t groups, std::size_t kept>
    [[gnu::always_inline]] static inline void add_groups(Accumulator (&s)[outputs],
                                                         Coefficient (&c)[phases * groups - 1 + outputs],
                                                         const Coefficient* a, const Sample* samples);
    template <std::size_t outputs>
    [[gnu::always_inline]] static inline void add_share(Accumulator* sums, const Coefficient* a, const Sample* samples,
                                                        std::size_t count);
    [[gnu::always_inline]] static inline Accumulator sum_of(const State& state, Sample newest);
    [[gnu::always_inline]] static inline void advance(State& state, Sample newest);
    static Accumulator sum_of_fused(const State& state, Sample newest);
    static void advance_fused(State& state, Sample newest);
    static Output step_fused(State& state, Sample newest);
};

}  // namespace glsum
