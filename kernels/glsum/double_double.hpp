// Numbers as the sum of two doubles, some 106 bits: exact sums and products of two doubles.
// Plain double operations in a fixed order: the same bits on every machine with IEEE doubles, in software too.
#pragma once

namespace glsum {

/// high + low, |low| at most half a unit in the last place of high.
struct DoubleDouble {
    double high;
    double low;
};

/// [Knuth] Exact: high + low == a + b.
inline DoubleDouble two_sum(double a, double b) {
    const double high = a + b;
    const double b_part = high - a;
    return {high, (a - (high - b_part)) + (b - b_part)};
}

/// [Dekker1971] Exact: high + low == a b. By splitting, not by a fused multiply-add, which a core without a double
/// unit has only as a slow library call. \pre |a|, |b| below the overflow of the split (2^996)
inline DoubleDouble two_product(double a, double b) {
    constexpr double splitter = 134217729.0;  // 2^27 + 1
    const double a_scaled = splitter * a;
    const double a_high = a_scaled - (a_scaled - a);
    const double a_low = a - a_high;
    const double b_scaled = splitter * b;
    const double b_high = b_scaled - (b_scaled - b);
    const double b_low = b - b_high;
    const double high = a * b;
    return {high, ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

}  // namespace glsum
