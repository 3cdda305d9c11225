// What a short memory can cost at most, before anything is measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

/// sum_{j=taps..samples-1} |a_j|: the absolute sum of the coefficients that a memory of `taps` drops from a record of
/// `samples`. 0 where nothing is dropped, and for whole orders v >= 0 behind tap v.
/// |sum of `taps` taps - full-memory sum| <= this times max |x|, at every k of the record and for every record; for
/// 0 < v < 1 and 1 < v < 2 the dropped coefficients have one sign, and a step reaches it.
[[nodiscard]] double dropped_sum(double order, std::size_t taps, std::size_t samples);

/// max_k |E_k| of a record's full-memory sums, in double (relative error below 1e-9; takes samples^2 steps).
[[nodiscard]] double largest_sum(double order, std::span<const double> record);

/// For each length the bound of `truncation_error_max`, which is relative to max_k |E_k|:
/// dropped_sum max_k |x_k| / max_k |E_k|, times 1 + 1e-9 for the rounding of this arithmetic.
[[nodiscard]] std::vector<double> truncation_bounds(double order, std::string_view signal,
                                                    std::span<const std::size_t> lengths, std::size_t samples,
                                                    std::uint64_t seed);

/// The bounds of the accuracy rows of a file: of[order][signal][taps]. `missing` says why there are none: they are of
/// Grünwald-Letnikov's weights (context `weights` absent, gl or shifted), and need the
/// records made again, so `n_samples` and `seed` in the context, and samples^2 steps for each order and signal (at most
/// 20 000 samples, 1000 pairs of order and signal).
struct TruncationBounds {
    std::map<std::string, std::map<std::string, std::map<std::string, double>>> of;
    std::string missing;
};
[[nodiscard]] TruncationBounds truncation_bounds(const Json& context, const std::vector<Json>& rows, unsigned jobs);

/// Of each order and length the largest bound of the signals: that of the worst error.
using WorstBounds = std::map<std::string, std::map<std::string, double>>;
[[nodiscard]] WorstBounds worst_of_signals(const TruncationBounds& bounds);

}  // namespace bench
