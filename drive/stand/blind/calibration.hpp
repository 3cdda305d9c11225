// How sure of itself somebody was, and how often rightly.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/gnuplot.hpp"

namespace stand::blind {

/// `hits` of `all`, with Wilson's 95 % interval.
struct Share {
    std::size_t hits = 0;
    std::size_t all = 0;
    void count(bool hit) {
        hits += hit ? 1 : 0;
        ++all;
    }
    [[nodiscard]] double value() const;
    [[nodiscard]] double low() const;
    [[nodiscard]] double high() const;
};

/// An answer that names causes.
struct Claim {
    double confidence;
    bool right;
};

/// Answers that were given with a confidence in [from, to).
struct Confidence {
    double from;
    double to;
    Share right;
    double claimed = 0.0;  ///< mean
};

/// Six bins from 0 to 1, 1 included.
[[nodiscard]] std::vector<Confidence> calibrate(std::span<const Claim> claims);

/// Mean square of the confidence less 1 where right, less 0 where not: 0 is best, 0.25 what 0.5 everywhere earns.
/// 0 without any.
[[nodiscard]] double brier_score(std::span<const Claim> claims);

/// From this confidence on an answer counts as sure.
inline constexpr double sure = 0.9;
/// Of the sure answers, the right ones.
[[nodiscard]] Share right_of_the_sure(std::span<const Claim> claims);
/// Of the right answers, the sure ones.
[[nodiscard]] Share sure_of_the_right(std::span<const Claim> claims);

/// Share that is right over confidence, with counts and Wilson's intervals; on the diagonal confidence is what it says.
[[nodiscard]] base::Picture picture_of_calibration(std::span<const Claim> claims);

}  // namespace stand::blind
