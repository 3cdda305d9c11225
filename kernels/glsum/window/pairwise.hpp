// pairwise: eight products as a tree of pairs, then eights in pairs, pairs of these and so on: each addition joins sums
// of as many products. What rounding costs grows with log2 L, where one accumulator's grows with L and four chains'
// with L / 4. Of 600 taps a Cortex-M7 takes 1.05 times the modelled cycles of plain, for compensated 3.6 times. What is
// left over of the eights is added up newest first, then the halves that no other half was there for, from the smallest
// to the largest. Floating point only: in fixed point no addition loses anything.
#pragma once

#include <bit>
#include <cstddef>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct Pairwise : WeightTable {
    static constexpr std::string_view word = "pairwise";
    static constexpr std::string_view summary = "eights of products in pairs, pairs of pairs and so on";
    static constexpr bool contiguous_only = true;

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        using Sample = typename Format::Sample;
        using Coefficient = typename Format::Coefficient;
        using Accumulator = typename Format::Accumulator;
        static_assert(!Format::fixed_point);
        // C99: pairwise
        Accumulator halves[32];  // sums of 8, 16, 32, ... products that wait for another as large, the smallest last
        std::size_t waiting = 0;
        std::size_t i = 0;
        // C99: pairwise newer
        for (; i + 8 <= window.newer_count; i += 8) {
            const Coefficient* const a = table + i;
            const Sample* const x = window.newer + i;
            const Accumulator p0 = Format::multiply(a[0], x[0]);
            const Accumulator p1 = Format::multiply(a[1], x[1]);
            const Accumulator p2 = Format::multiply(a[2], x[2]);
            const Accumulator p3 = Format::multiply(a[3], x[3]);
            const Accumulator p4 = Format::multiply(a[4], x[4]);
            const Accumulator p5 = Format::multiply(a[5], x[5]);
            const Accumulator p6 = Format::multiply(a[6], x[6]);
            const Accumulator p7 = Format::multiply(a[7], x[7]);
            Accumulator joined = ((p0 + p1) + (p2 + p3)) + ((p4 + p5) + (p6 + p7));
            // As many halves of its size wait as the number of eights before it ends in ones.
            for (std::size_t before = i / 8; before % 2 != 0; before /= 2) {
                joined = halves[--waiting] + joined;
            }
            halves[waiting++] = joined;
        }
        Accumulator sum = Format::zero();
        for (std::size_t left = window.newer_count % 8; left != 0; --left) {
            sum = Format::multiply_add(sum, table[i], window.newer[i]);
            ++i;
        }
        while (waiting != 0) {
            sum = halves[--waiting] + sum;
        }
        // C99: pairwise closing
        sum = Format::start(newest, scale) + sum;
        // C99 end
        return sum;
    }

    /// Of an eight the product, the tree's three additions and one for each doubling up to all of them: what waits at
    /// the end is joined as often as it was not joined before. Of what is left over, those in turn and one for each
    /// half that waits. Then x_k.
    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        const std::size_t eights = (taps - 1) / 8;
        const auto doublings = static_cast<std::size_t>(std::bit_width(eights));
        const auto waiting = static_cast<std::size_t>(std::popcount(eights));
        return j == 0 ? 1 : j <= 8 * eights ? 1 + 3 + doublings + 1 : 1 + (taps - 1) % 8 + waiting + 1;
    }
};

}  // namespace glsum
