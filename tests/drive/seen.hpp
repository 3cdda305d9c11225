// Bounds that are told by the extremes of many draws.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace test {

/// The least and the most of what was seen.
struct Seen {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    void operator()(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

/// Within the bounds but for the rounding to four digits, and up to them: within half a per cent of them or of what
/// lies between.
inline void expect_between(const Seen& seen, double low, double high, const char* what) {
    const double near_low = 4e-3 * std::max(std::fabs(low), high - low);
    const double near_high = 4e-3 * std::max(std::fabs(high), high - low);
    EXPECT_GE(seen.least, low - 1.1e-3 * std::fabs(low)) << what;
    EXPECT_LE(seen.least, low + near_low) << what;
    EXPECT_LE(seen.most, high + 1.1e-3 * std::fabs(high)) << what;
    EXPECT_GE(seen.most, high - near_high) << what;
}

}  // namespace test
