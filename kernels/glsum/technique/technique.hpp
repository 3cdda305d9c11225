// The contract of a technique: how the products a_j x_(k-j), j >= 1, are summed.
//
//   word                              its word in kernel names
//   host_only                         whether it needs the host's vector unit
//   table_count<Format>(past)         coefficients it keeps for `past` past samples
//   overread<Format>                  samples beyond the window that it may load (and multiply by zero)
//   fill<Format>(table, past, order, scale)
//   sum<Format>(table, window, x_k, scale)            -> the accumulator, or, where it also keeps the past,
//   sum_and_push<Format>(table, samples, past, x_k, scale)
//   roundings<Format>(j, taps)        in floating point: how many relative roundings reach the term of a_j, the
//                                     product's and the coefficient's included, the input's not
//
// The last gives the error bound of every floating-point kernel (`bound.hpp`):
//   |S - exact| <= peak sum_j ((1 + u)^(roundings(j) + 1) - 1) |a_j|.
#pragma once

#include <cstddef>

#include "glsum/weights.hpp"

namespace glsum {

/// The usual table: a_1 ... a_past, in this order.
struct WeightTable {
    template <class Format>
    static constexpr std::size_t table_count(std::size_t past) {
        return past;
    }
    template <class Format>
    static constexpr std::size_t overread = 0;

    template <class Format>
    static void fill(typename Format::Coefficient* table, std::size_t past, double order,
                     const typename Format::Scale& scale) {
        Weights weights(order);
        for (std::size_t i = 0; i < past; ++i) {
            weights.next();
            table[i] = Format::coefficient(weights.weight(), scale);
        }
    }
};

}  // namespace glsum
