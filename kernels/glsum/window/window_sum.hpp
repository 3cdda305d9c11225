// Sum<History, Technique, Format>: over a window that the history keeps. Other families specialise it.
#pragma once

#include "glsum/sum.hpp"

namespace glsum {

template <class History, class Technique, class Format>
struct Sum : SumOf<History, Technique, Format> {
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;

    struct State {
        const Coefficient* table;
        Sample* past;
        std::uint32_t past_samples;  // taps - 1: the newest sample is never stored before its sum is done
        std::uint32_t head;          // where the newest past sample lies
        typename Format::Scale scale;
    };

    /// Coefficients, and samples of the past, that a length of at most `taps` needs.
    static constexpr std::size_t table_count(std::size_t taps) {
        return Technique::template table_count<Format>(taps - 1);
    }
    static constexpr std::size_t past_count(std::size_t taps) {
        return taps == 1 ? 0
                         : History::past_count(Technique::template held<Format>(taps - 1)) +
                               Technique::template beside<Format>;
    }

    /// Multiplications for one output.
    static constexpr std::size_t multiplications(std::size_t taps) { return taps - 1; }

    /// Makes the table for the design and clears the past. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past and the count of saturations: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);

private:
    static_assert(History::contiguous || !Technique::contiguous_only, "this technique needs one contiguous piece");
};

}  // namespace glsum
