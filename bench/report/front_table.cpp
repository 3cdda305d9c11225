#include "bench/report/front_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "bench/report/best.hpp"

namespace bench::report {
namespace {

constexpr int last_decade = 7;

// How a cost is spoken of.
struct Words {
    std::string unit;
    std::string heading;
    int digits;  ///< behind the point
};

Words words_of(const Cost& cost) {
    switch (cost.kind) {
        case Cost::Kind::model_cycles:
            return {"cycles", fmt::format("cycles of a {}, modelled for {}", cost.machine->name, cost.core), 0};
        case Cost::Kind::instructions:
            return {"instructions",
                    fmt::format("instructions of the emulated {}, which are not cycles", cost.machine->name), 0};
        case Cost::Kind::host_time:
            return {"ns", "time on this machine", 1};
        case Cost::Kind::bytes:
            break;
    }
    return {"bytes", "bytes", 0};
}

// One order's part of the table.
class OfOrder {
public:
    OfOrder(const std::vector<CurvePoint>& points, const Cost& cost, std::string order)
        : points_(points), cost_(cost), words_(words_of(cost)), order_(std::move(order)) {}

    [[nodiscard]] std::string text() const {
        std::string text = fmt::format(
            "\norder {}: the cheapest within each decade of error, by {}\n  {:>9}   {:<28} {:<8} {:>12} {:>9}\n",
            order_, words_.heading, "error", "kernel", "taps", words_.unit, "bytes");
        const CurvePoint* before = nullptr;
        for (int decade = 1; decade <= last_decade; ++decade) {
            const CurvePoint* const point = within(decade, Memory::any);
            if (point != nullptr && point != before) {
                text += fmt::format("  {:>9.1e}   {:<28} {:<8} {:>12} {:>9}\n", *point->entry->error_max,
                                    point->entry->kernel, point->group->taps, cost_text(*point),
                                    point->entry->bytes ? fmt::format("{:.0f}", *point->entry->bytes) : "-");
                before = point;
            }
        }
        return text + saving(2) + saving(4);
    }

private:
    [[nodiscard]] const CurvePoint* within(int decade, Memory memory) const {
        return cheapest(points_, cost_, order_, std::pow(10.0, -decade), memory);
    }
    [[nodiscard]] double cost_at(const CurvePoint& point) const { return *ranked_cost(point, cost_); }
    [[nodiscard]] std::string cost_text(const CurvePoint& point) const {
        return fmt::format("{:.{}f}", cost_at(point), words_.digits);
    }
    [[nodiscard]] std::string saving(int decade) const {
        const CurvePoint* const best = within(decade, Memory::any);
        if (best == nullptr) {
            return fmt::format("  Within 1e-{}: no kernel of this run.\n", decade);
        }
        std::string beside = "no window of this run errs so little";
        if (const CurvePoint* const window = within(decade, Memory::window); window == best) {
            beside = "a window";
        } else if (window != nullptr) {
            beside = fmt::format("the cheapest window, {} {}: {:.1f} times as much", window->entry->kernel,
                                 window->group->taps, cost_at(*window) / cost_at(*best));
        }
        return fmt::format("  Within 1e-{}: {} {}, {} {}; {}.\n", decade, best->entry->kernel, best->group->taps,
                           cost_text(*best), words_.unit, beside);
    }

    const std::vector<CurvePoint>& points_;
    const Cost& cost_;
    Words words_;
    std::string order_;
};

}  // namespace

std::string front_table(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs) {
    const auto cost = deciding_cost(costs);
    if (!cost) {
        return "";
    }
    std::string text;
    for (const std::string& order : orders_of(points)) {
        if (cheapest(points, costs[*cost], order, std::numeric_limits<double>::infinity(), Memory::any) != nullptr) {
            text += OfOrder(points, costs[*cost], order).text();
        }
    }
    if (!text.empty()) {
        text +=
            "\n  error: worst of the signals, relative to the largest exact sum. Every kernel and length: --table "
            "all.\n";
    }
    return text;
}

}  // namespace bench::report
