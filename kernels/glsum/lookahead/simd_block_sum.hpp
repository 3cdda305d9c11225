// Sum<HostBlock, Simd, Format>: a window's sums on the host's vector unit, eight at a time (lookahead/simd_block.hpp).
//
// Order, range, overflow: as a window's. A sample that is no number is in every sum until the block ends in which it
// leaves the window, as it meets the zeros behind the last weight.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "glsum/lookahead/block.hpp"
#include "glsum/lookahead/simd_block.hpp"
#include "glsum/sum.hpp"
#include "glsum/window/simd.hpp"

namespace glsum {

template <class Technique, class Format>
struct Sum<HostBlock, Technique, Format> : SumOf<HostBlock, Technique, Format> {
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;
    static_assert(std::is_same_v<Sample, Coefficient>);

    struct State : SimdBlock<Sample> {
        [[no_unique_address]] typename Format::Scale scale;
    };

    static constexpr bool fused = Technique::fused;

    static constexpr std::size_t table_count(std::size_t taps) {
        return entering_count +
               (has_tables(taps) ? simd_block_samples * padded(taps) : padded(taps) + simd_block_samples);
    }
    static constexpr std::size_t past_count(std::size_t taps) {
        return taps == 1 ? 0 : lanes + 2 * ring_size(taps) + lanes;
    }

    /// Multiplications for one output; those with a zero, which fill vectors, besides.
    static constexpr std::size_t multiplications(std::size_t taps) { return taps - 1; }

    /// The product; the additions in a lane, of the lanes, in the block, and of x_k.
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        std::size_t tree = 0;
        for (std::size_t width = lanes; width > 1; width /= 2) {
            ++tree;
        }
        return j == 0 ? 1 : 1 + padded(taps) / lanes + tree + simd_block_samples - 1 + 1;
    }

    /// Makes the tables for the design and clears the past. On failure the state is as it was.
    static Status prepare(State& state, const Design& design, std::span<Coefficient> table, std::span<Sample> past);
    /// Forgets the past: x = 0 before the next sample.
    static void reset(State& state);
    /// The sum S_k for the next sample x_k.
    static Output step(State& state, Sample newest);

private:
    static constexpr std::size_t lanes = 64 / sizeof(Sample);
    /// Up to whole vectors, so that the tables behind begin with one.
    static constexpr std::size_t entering_count = (simd_block_samples - 1 + lanes + lanes - 1) / lanes * lanes;

    static constexpr std::size_t up_to(std::size_t count, std::size_t unit) { return (count + unit - 1) / unit * unit; }
    static constexpr std::size_t padded(std::size_t taps) { return up_to(taps - 1, lanes); }
    static constexpr std::size_t ring_size(std::size_t taps) { return up_to(taps - 1, simd_block_samples); }
    /// A table for each of the eight sums, so that no load straddles two cache lines, while they fit a first cache of
    /// 32 KB; else one table for all, read at eight places.
    static constexpr bool has_tables(std::size_t taps) {
        return simd_block_samples * padded(taps) * sizeof(Coefficient) <= 32768;
    }
};

}  // namespace glsum
