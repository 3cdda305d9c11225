// multi, multifma: newest first into four accumulators in turn, joined as (s_0 + s_1) + (s_2 + s_3), x_k last.
// Four independent chains: a Cortex-M7 needs three to start a multiply-accumulate each cycle [jnk0le], and a term
// passes a quarter of the additions. On a Cortex-M7 f32 and q31 take the taps in the order of its issue slots, with the
// same bits (window/cortex-m/).
#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>

#include "glsum/window/dsp.hpp"
#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct Multi : WeightTable {
    static constexpr std::string_view word = "multi";

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        return in_turn<Format, false>(table, window, newest, scale);
    }

    /// The product; the additions in one accumulator, where each piece of the window may begin a turn of its own;
    /// two to join and one for x_k.
    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t taps) {
        return j == 0 ? 1 : 1 + (taps - 1) / chains + 2 + 3;
    }

protected:
    static constexpr std::size_t chains = 4;

    template <class Format, bool fused>
    [[gnu::always_inline]] static inline typename Format::Accumulator in_turn(
        const typename Format::Coefficient* table, const Window<typename Format::Sample>& window,
        typename Format::Sample newest, const typename Format::Scale& scale) {
        using Sample = typename Format::Sample;
        using Accumulator = typename Format::Accumulator;
        // C99: multi
        Accumulator s0 = Format::zero();
        Accumulator s1 = Format::zero();
        Accumulator s2 = Format::zero();
        Accumulator s3 = Format::zero();
        // C99 end
#if defined(GLSUM_M7_FLOATS)
        if constexpr (std::is_same_v<Accumulator, float> && !fused) {
            // C99: multi floats newer
            float s[chains] = {0.0F, 0.0F, 0.0F, 0.0F};
            dsp::dot_floats(s, table, window.newer, window.newer_count);
            // C99: multi floats older
            if (window.older_count != 0) {
                dsp::dot_floats(s, table + window.newer_count, window.older, window.older_count);
            }
            // C99 end
            return Format::start(newest, scale) + ((s[0] + s[1]) + (s[2] + s[3]));
        }
#endif
#if defined(GLSUM_M7)
        if constexpr (Format::fixed_point && sizeof(Sample) == 4 && sizeof(typename Format::Coefficient) == 4) {
            auto sum = Format::start(newest, scale);
            // C99: multi words newer
            sum = dsp::dot_smlal_onto(sum, table, window.newer, window.newer_count);
            // C99: multi words older
            if (window.older_count != 0) {
                sum = dsp::dot_smlal_onto(sum, table + window.newer_count, window.older, window.older_count);
            }
            // C99 end
            return sum;
        }
#endif
        const auto add_piece = [&](const Sample* samples, std::size_t count) {
            // C99: multi piece
            std::size_t i = 0;
            // C99: multi groups
            for (; i + chains <= count; i += chains) {
                s0 = accumulate<Format, fused>(s0, table[i], samples[i]);
                s1 = accumulate<Format, fused>(s1, table[i + 1], samples[i + 1]);
                s2 = accumulate<Format, fused>(s2, table[i + 2], samples[i + 2]);
                s3 = accumulate<Format, fused>(s3, table[i + 3], samples[i + 3]);
            }
            // C99: multi rest
            if (i < count) {
                s0 = accumulate<Format, fused>(s0, table[i], samples[i]);
            }
            if (i + 1 < count) {
                s1 = accumulate<Format, fused>(s1, table[i + 1], samples[i + 1]);
            }
            if (i + 2 < count) {
                s2 = accumulate<Format, fused>(s2, table[i + 2], samples[i + 2]);
            }
            table += count;
            // C99 end
        };
        add_piece(window.newer, window.newer_count);
        add_piece(window.older, window.older_count);
        // C99: multi closing
        Accumulator sum = Format::start(newest, scale) + ((s0 + s1) + (s2 + s3));
        // C99 end
        return sum;
    }
};

struct MultiFma : Fused<Multi> {
    static constexpr std::string_view word = "multifma";

    template <class Format>
    GLSUM_FUSED_CLONES static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                                               const Window<typename Format::Sample>& window,
                                                               typename Format::Sample newest,
                                                               const typename Format::Scale& scale) {
        return in_turn<Format, true>(table, window, newest, scale);
    }
};

}  // namespace glsum
