// oldest, oldestfma: oldest first, one accumulator: x_k + (a_1 x_(k-1) + (a_2 x_(k-2) + ...)).
// The same loop backward. The small late terms are summed before the large first ones come: the term of a_j passes
// j + 1 additions, and it is the large ones that pass few.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct Oldest : WeightTable {
    static constexpr std::string_view word = "oldest";
    static constexpr std::string_view summary = "oldest first, one accumulator";

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        return oldest_first<Format, false>(table, window, newest, scale);
    }

    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t) {
        return j == 0 ? 1 : j + 2;
    }

protected:
    template <class Format, bool fused>
    [[gnu::always_inline]] static inline typename Format::Accumulator oldest_first(
        const typename Format::Coefficient* table, const Window<typename Format::Sample>& window,
        typename Format::Sample newest, const typename Format::Scale& scale) {
        using Accumulator = typename Format::Accumulator;
        // C99: oldest
        Accumulator sum = Format::zero();
        // C99: oldest older
        GLSUM_ROLLED
        for (std::size_t i = window.older_count; i > 0; --i) {
            sum = accumulate<Format, fused>(sum, table[window.newer_count + i - 1], window.older[i - 1]);
        }
        // C99: oldest newer
        GLSUM_ROLLED
        for (std::size_t i = window.newer_count; i > 0; --i) {
            sum = accumulate<Format, fused>(sum, table[i - 1], window.newer[i - 1]);
        }
        // C99: oldest closing
        sum = Format::start(newest, scale) + sum;
        // C99 end
        return sum;
    }
};

struct OldestFma : Fused<Oldest> {
    static constexpr std::string_view word = "oldestfma";

    template <class Format>
    GLSUM_FUSED_CLONES static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                                               const Window<typename Format::Sample>& window,
                                                               typename Format::Sample newest,
                                                               const typename Format::Scale& scale) {
        return oldest_first<Format, true>(table, window, newest, scale);
    }
};

}  // namespace glsum
