// compensated: newest first, one accumulator and the sum of what its additions lost [Neumaier1974]. The loss is taken
// by the six operations of two_sum instead of Neumaier's comparison: the same bits, and no branch on the data. Floating
// point only: in fixed point no addition loses anything.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct Compensated : WeightTable {
    static constexpr std::string_view word = "compensated";
    static constexpr std::string_view summary = "newest first, with the sum of what the additions lost";

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        using Accumulator = typename Format::Accumulator;
        static_assert(!Format::fixed_point);
        // C99: compensated
        Accumulator sum = Format::start(newest, scale);
        Accumulator lost = Format::zero();
        // C99 end
        const auto add = [&](Accumulator term) {
            // C99: compensated term
            const Accumulator next = sum + term;
            const Accumulator term_part = next - sum;
            lost += (sum - (next - term_part)) + (term - term_part);
            sum = next;
            // C99 end
        };
        // C99: compensated newer
        GLSUM_ROLLED
        for (std::size_t i = 0; i < window.newer_count; ++i) {
            add(Format::multiply(table[i], window.newer[i]));
        }
        // C99: compensated older
        table += window.newer_count;
        GLSUM_ROLLED
        for (std::size_t i = 0; i < window.older_count; ++i) {
            add(Format::multiply(table[i], window.older[i]));
        }
        // C99: compensated closing
        sum = sum + lost;
        // C99 end
        return sum;
    }

    /// The product and the last addition; what the sum of the losses loses is of second order, (taps u)^2, which is
    /// taps^2 2^-24 roundings in f32 and far less in f64.
    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t, std::size_t taps) {
        return 3 + ((taps * taps) >> 23);
    }
};

}  // namespace glsum
