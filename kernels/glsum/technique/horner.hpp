// horner: the nested form, from the oldest sample to the newest, with the factors c_j = (j-1-v)/j in place of the
// weights:  S_k = x_k + c_1 (x_(k-1) + c_2 (x_(k-2) + ... + c_(L-1) x_(k-L+1) ... )).
// The same number as the sum in exact arithmetic. In floating point the term of a_j passes j additions and j
// products, so the old, small terms are summed before the large ones; each step waits for the one before it.
#pragma once

#include <cstddef>
#include <string_view>

#include "glsum/history/window.hpp"
#include "glsum/technique/technique.hpp"

namespace glsum {

struct Horner {
    static constexpr std::string_view word = "horner";
    static constexpr bool host_only = false;

    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past;
    }
    template <class Format>
    static constexpr std::size_t overread = 0;

    /// c_1 ... c_past
    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, double order,
                     const typename Format::Scale& scale) {
        Weights weights(order);
        for (std::size_t i = 0; i < past; ++i) {
            weights.next();
            table[i] = Format::coefficient(weights.factor(), scale);
        }
    }

    template <class Format>
    static typename Format::Accumulator sum(const typename Format::Coefficient* table,
                                            const Window<typename Format::Sample>& window,
                                            typename Format::Sample newest, const typename Format::Scale&) {
        static_assert(!Format::fixed_point, "the nested form rounds at each step: fixed point needs its own");
        auto sum = Format::zero();
        for (std::size_t i = window.older_count; i > 0; --i) {
            sum = table[window.newer_count + i - 1] * (window.older[i - 1] + sum);
        }
        for (std::size_t i = window.newer_count; i > 0; --i) {
            sum = table[i - 1] * (window.newer[i - 1] + sum);
        }
        return newest + sum;
    }

    /// j + 1 additions, j products and j factors, each rounded once.
    template <class Format>
    static constexpr std::size_t roundings(std::size_t j, std::size_t) {
        return 3 * j + 1;
    }
};

}  // namespace glsum
