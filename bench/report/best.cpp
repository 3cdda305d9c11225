#include "bench/report/best.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/rows/key.hpp"

namespace bench::report {

std::vector<std::string> orders_of(const std::vector<CurvePoint>& points) {
    std::vector<std::string> orders;
    for (const CurvePoint& point : points) {
        if (std::find(orders.begin(), orders.end(), point.group->order) == orders.end()) {
            orders.push_back(point.group->order);
        }
    }
    return orders;
}

const CurvePoint* cheapest(const std::vector<CurvePoint>& points, const Cost& cost, const std::string& order,
                           double limit, Memory memory) {
    const CurvePoint* held = nullptr;
    for (const CurvePoint& point : points) {
        const auto now = ranked_cost(point, cost);
        if (point.group->order != order || !now || *point.entry->error_max > limit ||
            (memory == Memory::window && !is_window(point.group->taps))) {
            continue;
        }
        const auto before = held == nullptr ? std::nullopt : ranked_cost(*held, cost);
        if (!before || *now < *before || (*now == *before && *point.entry->error_max < *held->entry->error_max)) {
            held = &point;
        }
    }
    return held;
}

std::vector<Best> best_of(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs, std::size_t cost) {
    std::vector<Best> all;
    for (const std::string& order : orders_of(points)) {
        for (const double limit : error_limits) {
            all.push_back({order, limit, cheapest(points, costs[cost], order, limit, Memory::any),
                           cheapest(points, costs[cost], order, limit, Memory::window)});
        }
    }
    return all;
}

std::vector<std::string> never_on_front(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs,
                                        std::size_t cost) {
    std::vector<std::string> kernels;
    for (const CurvePoint& point : points) {
        if (ranked_cost(point, costs[cost]) &&
            std::find(kernels.begin(), kernels.end(), point.entry->kernel) == kernels.end()) {
            kernels.push_back(point.entry->kernel);
        }
    }
    std::erase_if(kernels, [&](const std::string& kernel) {
        return std::any_of(points.begin(), points.end(),
                           [&](const CurvePoint& point) { return point.entry->kernel == kernel && point.front[cost]; });
    });
    return kernels;
}

std::optional<std::size_t> deciding_cost(const std::vector<Cost>& costs) {
    for (const Cost::Kind kind : {Cost::Kind::model_cycles, Cost::Kind::instructions, Cost::Kind::host_time}) {
        const auto found =
            std::find_if(costs.begin(), costs.end(), [&](const Cost& cost) { return cost.kind == kind; });
        if (found != costs.end()) {
            return static_cast<std::size_t>(found - costs.begin());
        }
    }
    return std::nullopt;
}

std::string best_table(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs) {
    const auto cost = deciding_cost(costs);
    if (!cost || std::none_of(points.begin(), points.end(),
                              [&](const CurvePoint& point) { return ranked_cost(point, costs[*cost]).has_value(); })) {
        return "";
    }
    const auto cells = [&](const CurvePoint* point) {
        return point == nullptr ? fmt::format("{:<28} {:>8} {:>10}", "none", "", "")
                                : fmt::format("{:<28} {:>8} {:>10.{}f}", point->entry->kernel, point->group->taps,
                                              *ranked_cost(*point, costs[*cost]),
                                              costs[*cost].kind == Cost::Kind::host_time ? 1 : 0);
    };
    std::string text = fmt::format(
        "cheapest kernel that errs no more, by {}\n\n  {:>8} {:>6}   {:<28} {:>8} {:>10}   {:<28} {:>8} {:>10}\n",
        costs[*cost].title, "order", "error", "of all", "taps", "cost", "of windows", "taps", "cost");
    for (const Best& best : best_of(points, costs, *cost)) {
        text +=
            fmt::format("  {:>8} {:>6.0e}   {}   {}\n", best.order, best.limit, cells(best.point), cells(best.window));
    }
    const auto never = never_on_front(points, costs, *cost);
    return text + fmt::format("\ndominated at every order and length: {}\n",
                              never.empty() ? "none" : fmt::format("{}", fmt::join(never, ", ")));
}

}  // namespace bench::report
