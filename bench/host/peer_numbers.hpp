// How real numbers stand in a peer's own, and how far its sum may be from the exact one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/host/peers/peer.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/format/floating.hpp"
#include "reference/real.hpp"

namespace bench {

/// A peer's coefficients, a_0 = 1 included.
struct PeerTable {
    std::vector<double> coefficients;
    double largest = 0.0;       ///< of their magnitudes
    double absolute_sum = 0.0;  ///< of all of them
    explicit PeerTable(const std::vector<reference::Real>& weights) {
        for (const reference::Real& weight : weights) {
            coefficients.push_back(static_cast<double>(weight));
            largest = std::max(largest, std::fabs(coefficients.back()));
            absolute_sum += std::fabs(coefficients.back());
        }
    }
};

/// Numbers of a peer in single precision.
template <class Dot>
struct PeerNumbers {
    explicit PeerNumbers(const PeerTable&) {}
    static float coefficient(double a) { return static_cast<float>(a); }
    static float sample(double x) { return static_cast<float>(x); }
    static double real(float sum) { return sum; }
    /// In any order of summation: every term may pass every addition, and is rounded three times before.
    static double bound(const PeerTable& table) {
        return 1.01 * static_cast<double>(table.coefficients.size() + 2) * glsum::F32::sum_roundoff * signal_peak *
               table.absolute_sum;
    }
};

/// Numbers of a peer in Q31.
template <>
struct PeerNumbers<Q31Dot> {
    int bits = q31_coefficient_bits;  ///< of fraction: fewer where a coefficient needs 33 bits, or a sum 65
    explicit PeerNumbers(const PeerTable& table) {
        while (table.largest >= std::ldexp(1.0, 31 - bits) || table.absolute_sum >= std::ldexp(1.0, 32 - bits)) {
            --bits;
        }
    }
    [[nodiscard]] std::int32_t coefficient(double a) const {
        return static_cast<std::int32_t>(std::lround(std::ldexp(a, bits)));
    }
    static std::int32_t sample(double x) { return static_cast<std::int32_t>(std::lround(std::ldexp(x, 31))); }
    [[nodiscard]] double real(std::int64_t sum) const { return std::ldexp(static_cast<double>(sum), -31 - bits); }
    /// Sums are exact; each coefficient and each sample is rounded once.
    [[nodiscard]] double bound(const PeerTable& table) const {
        return std::ldexp(static_cast<double>(table.coefficients.size()), -bits - 1) +
               std::ldexp(1.01 * table.absolute_sum, -32);
    }
};

}  // namespace bench
