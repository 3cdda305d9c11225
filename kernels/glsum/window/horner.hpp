// horner, hornerfma: the Horner form, from the oldest sample to the newest, with the factors c_j = (j-1-v)/j in place
// of the weights:  S_k = x_k + c_1 (x_(k-1) + c_2 (x_(k-2) + ... + c_(L-1) x_(k-L+1) ... )). The same number as the sum
// in exact arithmetic. In floating point the term of a_j passes j + 1 additions and j products, so the old, small terms
// are summed before the large ones; each step waits for the one before it. hornerfma rounds product and addition once.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/window/technique.hpp"
#include "glsum/window/window.hpp"

namespace glsum {

struct Horner : WeightTable {
    static constexpr std::string_view word = "horner";
    static constexpr bool horner_form = true;

    /// c_1 ... c_past and a zero, by which the oldest sample needs no step of its own.
    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past + 1;
    }

    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, const Design& design,
                     const typename Format::Scale& scale) {
        Weights weights(design);
        for (std::size_t i = 0; i < past; ++i) {
            weights.next();
            table[i] = Format::coefficient(weights.factor(), scale);
        }
        table[past] = 0;
    }

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale& scale) {
        return oldest_first<Format, false>(table, window, newest, scale);
    }

    template <class Format>
    static Status choose_scale(const Design& design, typename Format::Scale& scale) {
        return Format::choose_horner_scale(design, scale);
    }

    static constexpr std::size_t coefficient_roundings(std::size_t j) { return j; }

    /// Each factor errs by half a unit of the table, and the product of the first j of them stands for a_j; each step
    /// rounds by half a unit of 2^-31, and what it loses at j is multiplied by a_j on its way.
    template <class Format>
    static double fixed_error(const Design& design, const typename Format::Scale& scale, double peak) {
        const double unit = power_of_two(scale.table_exponent - Format::coefficient_bits - 1);
        double of_weights = 0.0;
        double of_weight = 0.0;  // error of the product that stands for a_j
        double before = 1.0;     // |a_(j-1)|
        double of_steps = 0.0;
        Weights weights(design);
        for (std::size_t j = 1; j < design.taps; ++j) {
            weights.next();
            const double factor = weights.factor() < 0.0 ? -weights.factor() : weights.factor();
            of_weight = factor * of_weight + unit * (before + of_weight);
            of_weights += of_weight;
            of_steps += before * power_of_two(-32);
            before = weights.weight() < 0.0 ? -weights.weight() : weights.weight();
        }
        return peak * of_weights + of_steps;
    }
    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t) {
        return 2 * j + 1;
    }

protected:
    template <class Format, bool fused>
    [[gnu::always_inline]] static inline typename Format::Accumulator oldest_first(
        const typename Format::Coefficient* table, const Window<typename Format::Sample>& window,
        typename Format::Sample newest, const typename Format::Scale& scale) {
        using Accumulator = typename Format::Accumulator;
        // C99: horner
        Accumulator sum = Format::zero();
        // C99: horner older
        GLSUM_ROLLED
        for (std::size_t i = window.older_count; i > 0; --i) {
            sum = Format::template horner_step<fused>(window.older[i - 1], table[window.newer_count + i], sum, scale);
        }
        // C99: horner newer
        GLSUM_ROLLED
        for (std::size_t i = window.newer_count; i > 0; --i) {
            sum = Format::template horner_step<fused>(window.newer[i - 1], table[i], sum, scale);
        }
        // C99: horner closing
        sum = Format::template horner_step<fused>(newest, table[0], sum, scale);
        // C99 end
        return sum;
    }
};

struct HornerFma : Fused<Horner> {
    static constexpr std::string_view word = "hornerfma";

    template <class Format>
    GLSUM_FUSED_CLONES static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                                               const Window<typename Format::Sample>& window,
                                                               typename Format::Sample newest,
                                                               const typename Format::Scale& scale) {
        return oldest_first<Format, true>(table, window, newest, scale);
    }

    template <class Format>
    static constexpr std::size_t sum_roundings(std::size_t j, std::size_t) {
        return j + 1;
    }
};

}  // namespace glsum
