// plain, plainfma: newest first, one accumulator: ((x_k + a_1 x_(k-1)) + a_2 x_(k-2)) + ...
// The textbook loop. In floating point the large first terms swallow the small late ones: the term of a_j passes
// taps - j additions. plainfma rounds product and addition once.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct Plain : WeightTable {
    static constexpr std::string_view word = "plain";
    static constexpr std::string_view summary = "newest first, one accumulator";

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        return newest_first<Format, false>(table, window, newest, scale);
    }

    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        return j == 0 ? taps - 1 : taps - j + 1;
    }

protected:
    template <class Format, bool fused>
    [[gnu::always_inline]] static inline typename Format::Accumulator newest_first(
        const typename Format::Coefficient* table, const Window<typename Format::Sample>& window,
        typename Format::Sample newest, const typename Format::Scale& scale) {
        using Accumulator = typename Format::Accumulator;
        // C99: plain
        Accumulator sum = Format::start(newest, scale);
        // C99: plain newer
        GLSUM_ROLLED
        for (std::size_t i = 0; i < window.newer_count; ++i) {
            sum = accumulate<Format, fused>(sum, table[i], window.newer[i]);
        }
        // C99: plain older
        table += window.newer_count;
        GLSUM_ROLLED
        for (std::size_t i = 0; i < window.older_count; ++i) {
            sum = accumulate<Format, fused>(sum, table[i], window.older[i]);
        }
        // C99 end
        return sum;
    }
};

struct PlainFma : Fused<Plain> {
    static constexpr std::string_view word = "plainfma";

    template <class Format>
    GLSUM_FUSED_CLONES static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                                               const Window<typename Format::Sample>& window,
                                                               typename Format::Sample newest,
                                                               const typename Format::Scale& scale) {
        return newest_first<Format, true>(table, window, newest, scale);
    }

    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        return j == 0 ? taps - 1 : taps - j;
    }
};

}  // namespace glsum
