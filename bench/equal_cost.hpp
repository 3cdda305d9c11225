// What a number of multiplications a sample buys: kernels that keep a window, guess its tail, keep blocks or modes, and
// Oustaloup's filter, all in double.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/row.hpp"

namespace bench {

struct EqualCost {
    std::vector<std::size_t> costs{16, 24, 32};  ///< multiplications a sample, 4 to 600; rising
    std::vector<double> orders{0.2, 0.5, 0.9, 1.5, -0.5};
    std::vector<std::string> signals;
    std::size_t samples = 5000;
    unsigned jobs = 1;
};

/// A kernel, or `oustaloup_f64`, as tables and pictures call it.
struct EqualCostWay {
    std::string_view kernel;
    std::string_view label;
};
[[nodiscard]] std::span<const EqualCostWay> equal_cost_ways();

/// Rows of `measure_accuracy` for each kernel, order, signal and cost, and of Oustaloup's filter with (cost - 1) / 2
/// poles rows `filter/oustaloup_f64/order:<v>/poles:<P>/accuracy/signal:<s>` with `error_max`, `error_late_max` (of the
/// record's second half), both against the sum as a kernel's are, `mapping`, `low_rad_s` and `high_rad_s`: of the bands
/// and mappings that are tried, those with the smallest error of the row, which favours it. No filter for whole orders
/// and outside (-1, 2). Each row has its `cost` and its `way`.
[[nodiscard]] std::vector<Json> measure_equal_cost(const EqualCost& wanted);

/// A table for each order: a line for each cost and way, a column for each signal, and the worst of them.
[[nodiscard]] std::string to_table(const EqualCost& wanted, const std::vector<Json>& rows);

/// Writes `stem`.svg and `stem`.png: a panel for each order and signal. \throws as `draw`
void plot_equal_cost(const EqualCost& wanted, const std::vector<Json>& rows, const std::filesystem::path& stem);

}  // namespace bench
