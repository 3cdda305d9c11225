// A run as curves: what each kernel at each length costs, how wrong it is, and what is on a front.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/rows/groups.hpp"
#include "bench/sweep/truncation_bound.hpp"

namespace bench::report {

/// What an error is weighed against.
struct Cost {
    enum class Kind { host_time, instructions, model_cycles, bytes };
    Kind kind;
    std::string core;   ///< of modelled cycles
    std::string name;   ///< of a CSV column: host_ns, instructions, model_cycles:<core>, bytes
    std::string title;  ///< with its unit
    std::function<std::optional<double>(const Entry&)> of;
    const base::Machine* machine = &base::machines.front();  ///< of cycles and instructions
};

/// The costs that occur in a run.
[[nodiscard]] std::vector<Cost> costs_of(const std::vector<Group>& groups);

/// One kernel at one order and length.
struct CurvePoint {
    const Group* group;
    const Entry* entry;
    std::vector<bool> front;  ///< for each cost: nothing else of its order, at any length, is better (`on_front`)
};

/// What the point's entry costs; empty for one with a fault, without an error or without that cost: it is not ranked.
[[nodiscard]] std::optional<double> ranked_cost(const CurvePoint& point, const Cost& cost);

/// Sets each point's fronts anew: of `error_max`, the worst of the signals, among these points of its order. Those that
/// are not ranked are on none.
void set_fronts(std::vector<CurvePoint>& points, const std::vector<Cost>& costs);

/// Every entry of the groups, which must outlive the points, with its fronts (`set_fronts`).
[[nodiscard]] std::vector<CurvePoint> curve_points(const std::vector<Group>& groups, const std::vector<Cost>& costs);

/// One line a point: order, kernel, taps, errors, truncation bound, costs with the model's band, fronts, fault.
void write_curves(const std::filesystem::path& path, const std::vector<CurvePoint>& points,
                  const std::vector<Cost>& costs, const WorstBounds& bounds);

/// Writes `stem`.svg and `stem`.png: for each order the total error over each cost, the front drawn in. At most 24
/// orders.
void plot_costs(const std::filesystem::path& stem, const std::vector<CurvePoint>& points,
                const std::vector<Cost>& costs);

}  // namespace bench::report
