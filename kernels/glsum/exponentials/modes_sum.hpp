// Sum<Modes, Technique, Format>: near taps and decaying averages (exponentials/modes.hpp) in place of a window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "glsum/exponentials/modes.hpp"
#include "glsum/sum.hpp"
#include "glsum/window/compensated.hpp"
#include "glsum/window/plain.hpp"

namespace glsum {

template <class Technique, class Format>
struct Sum<Modes, Technique, Format> : SumOf<Modes, Technique, Format> {
    static_assert(std::is_same_v<Technique, Plain> || std::is_same_v<Technique, Compensated>);
    static constexpr bool compensated = std::is_same_v<Technique, Compensated>;
    static_assert(!(compensated && Format::fixed_point),
                  "in fixed point a state's step loses nothing that it could keep");

    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;

    struct State {
        const Coefficient* table;  // a_1 ... a_(K-1), then of each mode, the fastest first: d, g; q31: d, its shift, g
        Sample* past;              // x_(k-1) ... x_(k-K+1), then of each mode: s; compensated: s, what it lost
        std::uint32_t near_samples;  // K - 1
        std::uint32_t modes;         // M
        typename Format::Scale scale;
    };

    static constexpr std::size_t coefficients_of_mode = Format::fixed_point ? 3 : 2;
    static constexpr std::size_t words_of_mode = compensated ? 2 : 1;

    /// Coefficients, and samples of the past, that taps of which so many are modes need; and at most, whatever their
    /// number is.
    static constexpr std::size_t table_count(std::size_t taps, std::size_t modes) {
        return taps - 1 + modes * (coefficients_of_mode - 2);
    }
    static constexpr std::size_t past_count(std::size_t taps, std::size_t modes) {
        return taps - 1 - modes * (2 - words_of_mode);
    }
    static constexpr std::size_t table_count(std::size_t taps) { return table_count(taps, (taps - 1) / 2); }
    static constexpr std::size_t past_count(std::size_t taps) { return past_count(taps, 0); }

    /// Multiplications for one output.
    static constexpr std::size_t multiplications(std::size_t taps) { return taps - 1; }

    /// Makes the table for the design and clears the past. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past and the count of saturations: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);

private:
    struct Averaged {
        Sample average;
        Sample lost;
    };
    [[gnu::always_inline]] static inline Averaged move(const Coefficient* of_mode, const Sample* average,
                                                       Sample leaving);
    [[gnu::always_inline]] static inline void keep(Sample* average, const Averaged& moved);
};

}  // namespace glsum
