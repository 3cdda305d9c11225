// Sum<Cascade, Technique, Format>: near taps and a cascade of second-order sections (filter/cascade.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "glsum/filter/cascade.hpp"
#include "glsum/sum.hpp"
#include "glsum/wrap/delta.hpp"

namespace glsum {

template <class Technique, class Format>
struct Sum<Cascade, Technique, Format> : SumOf<Cascade, Technique, Format> {
    static constexpr bool fixed = Format::fixed_point;
    static_assert(std::is_same_v<Technique, std::conditional_t<fixed, DirectForm1, DirectForm2Transposed>>);

    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;

    struct State {
        // a_1 ... a_(K-1), then of each section b1, b2, -a1, -a2, of a single pole b1, -a1; q31: b0, b1, b2, -a1, -a2
        const Coefficient* table;
        // x_(k-1) ... x_(k-K+1), then of each section s1, s2, of a single pole s1; q31: its last two inputs and what it
        // dropped, and behind all the last two outputs
        Sample* past;
        std::uint32_t near_samples;  // K - 1
        std::uint32_t modes;         // M
        typename Format::Scale scale;
    };

    static constexpr std::size_t coefficients_of_section = fixed ? 5 : 4;
    static constexpr std::size_t words_of_section = fixed ? 3 : 2;

    /// Coefficients, and samples of the past, that taps of which so many are modes need; and at most, whatever their
    /// number is.
    static constexpr std::size_t table_count(std::size_t taps, std::size_t modes) {
        return taps - 1 - 2 * modes + (fixed ? coefficients_of_section * ((modes + 1) / 2) : 2 * modes);
    }
    static constexpr std::size_t past_count(std::size_t taps, std::size_t modes) {
        return taps - 1 - 2 * modes + (!fixed ? modes : modes == 0 ? 0 : words_of_section * ((modes + 1) / 2) + 2);
    }
    static constexpr std::size_t table_count(std::size_t taps) {
        const std::size_t most = (taps - 1) / 2;
        const std::size_t odd = most % 2 == 0 && most > 0 ? most - 1 : most;
        const std::size_t with_odd = table_count(taps, odd);
        return with_odd > table_count(taps, most) ? with_odd : table_count(taps, most);
    }
    static constexpr std::size_t past_count(std::size_t taps) {
        const std::size_t with_one = taps < 3 ? 0 : past_count(taps, 1);
        return with_one > taps - 1 ? with_one : taps - 1;
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
    // A section's output and its next state.
    struct Passed {
        Sample value;
        Sample first;
        Sample second;
    };
    [[gnu::always_inline]] static inline Passed pass(const Coefficient* of_section, const Sample* kept, Sample before);
    [[gnu::always_inline]] static inline void keep(Sample* kept, const Passed& passed);
    [[gnu::always_inline]] static inline Sample filtered(State& state, Sample entering);
};

}  // namespace glsum
