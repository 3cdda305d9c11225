// What rounding costs a kernel with blocks, against the exact sum of its taps and blocks. With u the roundoff and P the
// peak, a block of level l, of weights with the sum S and the sum of magnitudes A:
//   floating point   each sample passes l additions on its way into the block's sum, the sum its coefficient, the
//   product
//                    and the additions behind it, as a tap does. The mean is computed in double: 2^-52 A at most
//   q31              the mean of the samples errs by half a unit of 2^-31 a level, l 2^-32 in all; its coefficient, S,
//   by
//                    half a unit of the table
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "glsum/error_bound.hpp"
#include "glsum/logmemory/block_weights.hpp"
#include "glsum/logmemory/nested_sum.hpp"

namespace glsum {

template <class Technique, class Format>
struct ErrorBound<Sum<Nested, Technique, Format>> {
    using K = Sum<Nested, Technique, Format>;

    static double of(const Design& design, const typename K::State& state, double peak, std::size_t) {
        const std::size_t terms = design.taps;  // of the sum, x_k included
        const std::size_t near_taps = terms - design.blocks.count;
        Weights weights(design);
        BlockWeights blocks(design.blocks, weights);
        if constexpr (Format::fixed_point) {
            const double coefficient = std::ldexp(1.0, state.scale.table_exponent - Format::coefficient_bits - 1);
            double absolute = 1.0;
            double means = 0.0;
            for (std::size_t j = 1; j < near_taps; ++j) {
                weights.next();
                absolute += std::fabs(weights.weight());
            }
            for (std::size_t b = 0; b < design.blocks.count; ++b) {
                blocks.next();
                absolute += std::fabs(blocks.sum());
                means += (std::fabs(blocks.sum()) + coefficient) * static_cast<double>(blocks.level()) * 0x1p-32 +
                         0x1p-52 * blocks.absolute() * peak;
            }
            return peak * static_cast<double>(terms - 1) * coefficient + means +
                   std::ldexp(absolute, -Format::sample_bits - 1) + std::ldexp(1.0, state.scale.output_exponent - 32);
        } else {
            // Of term t, x_k being 0: input, its coefficient, the block's additions, product and the additions from its
            // own on.
            const auto growth = [&](std::size_t t, std::size_t level) {
                const double data = t == 0 ? 1.0 : 2.0;
                const auto sum = static_cast<double>(level + (t == 0 ? terms - 1 : terms - t + 1));
                return std::expm1(data * std::log1p(Format::data_roundoff) + sum * std::log1p(Format::sum_roundoff));
            };
            double bound = growth(0, 0);
            for (std::size_t j = 1; j < near_taps; ++j) {
                weights.next();
                bound += growth(j, 0) * std::fabs(weights.weight());
            }
            for (std::size_t b = 0; b < design.blocks.count; ++b) {
                blocks.next();
                // Of a sum smaller than its weights, each of these rounded where they were summed.
                bound +=
                    growth(near_taps + b, blocks.level()) * std::fabs(blocks.sum()) + 0x1.01p-52 * blocks.absolute();
            }
            // A product below the smallest normal number loses half of the smallest denormal one; so does a mean, times
            // the samples that it is the weight of.
            constexpr double denormal = std::numeric_limits<typename Format::Sample>::denorm_min();
            return peak * bound + static_cast<double>(terms) * denormal +
                   peak * denormal * static_cast<double>(reach_of(design));
        }
    }
};

}  // namespace glsum
