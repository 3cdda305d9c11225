// A kernel as the combination of its name's three words: how the past is kept, how it is summed, in which numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// "<history>_<technique>_<format>".
template <class History, class Technique, class Format>
inline constexpr auto kernel_name = [] {
    constexpr std::size_t size = History::word.size() + Technique::word.size() + Format::word.size() + 2;
    std::array<char, size> joined{};
    std::size_t at = 0;
    for (std::string_view word : {History::word, Technique::word, Format::word}) {
        if (at != 0) {
            joined[at++] = '_';
        }
        for (char letter : word) {
            joined[at++] = letter;
        }
    }
    return joined;
}();

/// What every Sum has alike: its words, its numbers, its name, and how reals become samples.
template <class History, class Technique, class Format>
struct SumOf {
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;
    using HistoryPart = History;
    using TechniquePart = Technique;
    using FormatPart = Format;

    static constexpr bool host_only = Technique::host_only;

    static constexpr std::string_view name() {
        return {kernel_name<History, Technique, Format>.data(), kernel_name<History, Technique, Format>.size()};
    }

    /// The orders that `prepare` takes.
    static constexpr bool order_in_range(double order) { return glsum::order_in_range(order); }

    static Sample from_real(double real) { return Format::from_real(real); }
    template <class State>
    static double to_real(const State& state, Output output) {
        return Format::to_real(output, state.scale);
    }
};

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
        return taps == 1 ? 0 : History::past_count(taps - 1) + Technique::template overread<Format>;
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

/// registry.hpp says which are.
template <class History, class Technique, class Format>
inline constexpr bool is_registered<Sum<History, Technique, Format>> = false;

}  // namespace glsum
