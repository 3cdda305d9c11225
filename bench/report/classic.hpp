// What is gained over the classic window: its front, and that of all kernels, at the same errors.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/report/curves.hpp"

namespace bench::report {

/// A window (`is_window`) of samples as they came: all before it is truncated. Windows of increments, with a guessed
/// tail or summed in blocks are newer.
[[nodiscard]] bool is_classic(const CurvePoint& point);

/// The classic windows among the points, with their fronts among themselves.
[[nodiscard]] std::vector<CurvePoint> classic_points(const std::vector<CurvePoint>& points,
                                                     const std::vector<Cost>& costs);

/// The cheapest of each, of one cost, that errs no more than `limit`; null: none does.
struct Gain {
    std::string order;
    double limit;
    const CurvePoint* before = nullptr;  ///< of the classic windows
    const CurvePoint* after = nullptr;   ///< of all kernels
};

/// For each order of `all`, in the order of appearance, and each of `error_limits`. \param classic  `classic_points` of
/// `all` \param cost  index into `costs` \return looks into both, which must outlive it
[[nodiscard]] std::vector<Gain> gains(const std::vector<CurvePoint>& classic, const std::vector<CurvePoint>& all,
                                      const std::vector<Cost>& costs, std::size_t cost);

/// Cost before over cost after, 1 or more; empty where one of them is missing, or where what is cheapest is free.
[[nodiscard]] std::optional<double> factor(const Gain& gain, const Cost& cost);

/// The costs that both fronts are shown over, as indices: `deciding_cost` and bytes, those that points with an error
/// have.
[[nodiscard]] std::vector<std::size_t> gain_costs(const std::vector<CurvePoint>& points,
                                                  const std::vector<Cost>& costs);

/// As a person reads it: both costs and their factor for each order, limit and cost; then, for each limit, the
/// smallest, median and largest factor over the orders that have one. Empty for a run without errors or costs.
[[nodiscard]] std::string gain_table(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs);

/// Writes `stem`.svg and `stem`.png: for each of `gain_costs` a panel for each order with both fronts, and the factor
/// between them at errors of 1e-2, 1e-4 and 1e-6. Errors below 1e-9 are not shown. At most 24 orders, the first.
/// \throws as `base::draw`
void plot_gains(const std::filesystem::path& stem, const std::vector<CurvePoint>& points,
                const std::vector<Cost>& costs);

}  // namespace bench::report
