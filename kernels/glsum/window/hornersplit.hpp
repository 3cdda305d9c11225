// hornersplit, hornersplitfma: the Horner form in four independent chains, each of every fourth sample:
//   t_r = x_(k-r) + C_(r+4) (x_(k-r-4) + C_(r+8) (x_(k-r-8) + ...)),  C_j = c_j c_(j-1) c_(j-2) c_(j-3),  r = 1 ... 4
//   S_k = x_k + ((a_1 t_1 + a_2 t_2) + (a_3 t_3 + a_4 t_4))
// Oldest first like horner, but no step waits for the one before it: the answer to the latency of the Horner form.
// Floating point, contiguous windows. The term of a_j passes j / 4 steps. On a Cortex-M7 f32 takes the steps in the
// order of its issue slots, with the same bits (window/cortex-m/).
#pragma once

#include <cstddef>
#include <string_view>
#include <type_traits>

#include "glsum/window/dsp.hpp"
#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct HornerSplit : WeightTable {
    static constexpr std::string_view word = "hornersplit";
    static constexpr bool contiguous_only = true;
    static constexpr bool horner_form = true;

    /// a_1 ... a_4, then C_5, C_6, ... C_(past+4): behind the four first, the factor at i + 4 belongs to sample i.
    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past + chains;
    }

    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        Weights weights(design);
        double factors[chains] = {};  // the last four c_j
        for (std::size_t i = 0; i < past + chains; ++i) {
            weights.next();
            factors[i % chains] = weights.factor();
            // Products of four in double: within 4 units in its last place, far below an f32's.
            const double product = (factors[0] * factors[1]) * (factors[2] * factors[3]);
            table[i] = Format::coefficient(i < chains ? weights.weight() : product, scale);
        }
    }

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        return in_chains<Format, false>(table, window, newest, scale);
    }

    static constexpr std::size_t coefficient_roundings(std::size_t j) { return j == 0 ? 0 : (j + chains - 1) / chains; }
    /// Product and addition of each step, then a product and three additions.
    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t) {
        return 2 * (j / chains + 1) + 4;
    }

protected:
    static constexpr std::size_t chains = 4;

    template <class Format, bool fused>
    [[gnu::always_inline]] static inline typename Format::Accumulator in_chains(
        const typename Format::Coefficient* table, const Window<typename Format::Sample>& window,
        typename Format::Sample newest, const typename Format::Scale& scale) {
        static_assert(!Format::fixed_point);
        using Accumulator = typename Format::Accumulator;
        const auto* samples = window.newer;
        const std::size_t past = window.newer_count;
        // C99: hornersplit
        const std::size_t rest = past % chains;
        std::size_t i = past - rest;
        // The oldest samples, fewer than a group, open their chains.
        Accumulator t0 = rest > 0 ? Format::start(samples[i], scale) : Format::zero();
        Accumulator t1 = rest > 1 ? Format::start(samples[i + 1], scale) : Format::zero();
        Accumulator t2 = rest > 2 ? Format::start(samples[i + 2], scale) : Format::zero();
        Accumulator t3 = Format::zero();
        // C99 end
#if defined(GLSUM_M7_FLOATS)
        if constexpr (std::is_same_v<typename Format::Accumulator, float> && !fused) {
            constexpr std::size_t least = 64;  // to enter and leave the other loop takes 50 cycles
            if (past >= least) {
                // C99: hornersplit floats
                float t[chains] = {t0, t1, t2, t3};
                dsp::horner_floats(t, table, samples, i / chains);
                // C99 end
                return Format::start(newest, scale) +
                       ((table[0] * t[0] + table[1] * t[1]) + (table[2] * t[2] + table[3] * t[3]));
            }
        }
#endif
        // C99: hornersplit loop
        while (i > 0) {
            i -= chains;
            t0 = Format::template horner_step<fused>(samples[i], table[i + 4], t0, scale);
            t1 = Format::template horner_step<fused>(samples[i + 1], table[i + 5], t1, scale);
            t2 = Format::template horner_step<fused>(samples[i + 2], table[i + 6], t2, scale);
            t3 = Format::template horner_step<fused>(samples[i + 3], table[i + 7], t3, scale);
        }
        // C99: hornersplit closing
        Accumulator sum =
            Format::start(newest, scale) + ((table[0] * t0 + table[1] * t1) + (table[2] * t2 + table[3] * t3));
        // C99 end
        return sum;
    }
};

struct HornerSplitFma : Fused<HornerSplit> {
    static constexpr std::string_view word = "hornersplitfma";

    template <class Format>
    GLSUM_FUSED_CLONES static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                                               const Window<typename Format::Sample>& window,
                                                               typename Format::Sample newest,
                                                               const typename Format::Scale& scale) {
        return in_chains<Format, true>(table, window, newest, scale);
    }
};

}  // namespace glsum
