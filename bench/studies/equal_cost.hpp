// What a number of multiplications a sample buys: kernels that keep a window, guess its tail, keep blocks or modes, and
// Oustaloup's filter, all in double.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

struct EqualCost {
    std::vector<std::size_t> costs{16, 24, 32};  ///< multiplications a sample, 4 to 600; rising
    std::vector<double> orders{0.2, 0.5, 0.9, 1.5, -0.5};
    std::vector<std::string> signals;
    std::size_t samples = 5000;
    unsigned jobs = 1;
};

/// A kernel or a filter, and what tables and pictures call it.
struct EqualCostWay {
    std::string_view name;
    std::string_view label;
    bool is_filter = false;
};
[[nodiscard]] std::span<const EqualCostWay> equal_cost_ways();

/// Oustaloup's filter with one band and mapping, tuned to the sums of all signals together.
inline constexpr std::string_view oustaloup_of_sums = "oustaloup_f64";
/// With those of each signal alone, tuned to its exact derivative: what it can do at best.
inline constexpr std::string_view oustaloup_of_derivative = "oustaloupown_f64";

/// Of Oustaloup's filter with (cost - 1) / 2 poles, rows `filter/<way>/order:<v>/poles:<P>/accuracy/signal:<s>` with
/// `error_max` against the sum, `derivative_error_max` and `derivative_error_late_max` as a kernel's are, `mapping`,
/// `low_rad_s` and `high_rad_s`; tuned to one derivative, apart to its whole and to its second half (`late_mapping`
/// ...). None for whole orders and outside (-1, 2). Each row has its `cost` and its `way`.
[[nodiscard]] std::vector<Json> measure_filters(const EqualCost& wanted);

/// These, after rows of `measure_accuracy` for each kernel, order, signal and cost: of the longest design that costs no
/// more, with `cost` and `way`; that of the full memory is samples - 1, whatever is asked.
[[nodiscard]] std::vector<Json> measure_equal_cost(const EqualCost& wanted);

/// Tables for each order, of the errors against the exact sum and against the exact derivative: a line for each cost
/// and way, a column for each signal, and the worst of them.
[[nodiscard]] std::string to_table(const EqualCost& wanted, const std::vector<Json>& rows);

/// Writes `stem`.svg and `stem`.png: a panel for each order and signal. \throws as `base::draw`
void plot_equal_cost(const EqualCost& wanted, const std::vector<Json>& rows, const std::filesystem::path& stem);

}  // namespace bench
