#include "bench/report/classic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "bench/report/best.hpp"
#include "bench/rows/key.hpp"
#include "bench/rows/median.hpp"
#include "glsum/catalogue.hpp"

namespace bench::report {
namespace {

void end_line(std::string& text) {
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
}

// Smallest, median and largest over the orders, of one limit.
std::string spread(const std::vector<Gain>& gains, double limit, const Cost& cost) {
    std::vector<double> factors;
    for (const Gain& gain : gains) {
        if (const auto ratio = factor(gain, cost); ratio && gain.limit == limit) {
            factors.push_back(*ratio);
        }
    }
    if (factors.empty()) {
        return fmt::format("   {:>14} {:>14} {:>14}", "none", "none", "none");
    }
    const auto [smallest, largest] = std::ranges::minmax(factors);
    return fmt::format("   {:>14.1f} {:>14.1f} {:>14.1f}", smallest, median_of(factors), largest);
}

}  // namespace

bool is_classic(const CurvePoint& point) {
    const glsum::CatalogueEntry* const kernel = glsum::find_kernel(point.entry->kernel);
    return is_window(point.group->taps) && kernel != nullptr && kernel->family == glsum::window_family &&
           kernel->forgotten == glsum::Forgotten::zero;
}

std::vector<CurvePoint> classic_points(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs) {
    std::vector<CurvePoint> classic;
    std::copy_if(points.begin(), points.end(), std::back_inserter(classic), is_classic);
    set_fronts(classic, costs);
    return classic;
}

std::vector<Gain> gains(const std::vector<CurvePoint>& classic, const std::vector<CurvePoint>& all,
                        const std::vector<Cost>& costs, std::size_t cost) {
    const std::vector<Best> before = best_of(classic, costs, cost);
    std::vector<Gain> found;
    for (const Best& best : best_of(all, costs, cost)) {
        const auto same = std::find_if(before.begin(), before.end(), [&](const Best& other) {
            return other.order == best.order && other.limit == best.limit;
        });
        found.push_back({best.order, best.limit, same == before.end() ? nullptr : same->point, best.point});
    }
    return found;
}

std::optional<double> factor(const Gain& gain, const Cost& cost) {
    if (gain.before == nullptr || gain.after == nullptr) {
        return std::nullopt;
    }
    const double after = *ranked_cost(*gain.after, cost);
    return after > 0.0 ? std::optional(*ranked_cost(*gain.before, cost) / after) : std::nullopt;
}

std::vector<std::size_t> gain_costs(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs) {
    std::vector<std::size_t> wanted;
    const auto deciding = deciding_cost(costs);
    for (std::size_t c = 0; c < costs.size(); ++c) {
        if ((c == deciding || costs[c].kind == Cost::Kind::bytes) &&
            std::any_of(points.begin(), points.end(),
                        [&](const CurvePoint& point) { return ranked_cost(point, costs[c]).has_value(); })) {
            wanted.push_back(c);
        }
    }
    return wanted;
}

std::string gain_table(const std::vector<CurvePoint>& points, const std::vector<Cost>& costs) {
    const std::vector<std::size_t> wanted = gain_costs(points, costs);
    if (wanted.empty()) {
        return "";
    }
    const std::vector<CurvePoint> classic = classic_points(points, costs);
    std::string text =
        "least cost at an error, before (windows in shift, ring and mirror histories) and after (all kernels)\n\n";
    text += fmt::format("  {:>8} {:>6}", "", "");
    std::string head = fmt::format("  {:>8} {:>6}", "order", "error");
    std::vector<std::vector<Gain>> of_costs;
    for (const std::size_t cost : wanted) {
        text += fmt::format("   {:<44}", costs[cost].title);
        head += fmt::format("   {:>14} {:>14} {:>14}", "before", "after", "factor");
        of_costs.push_back(gains(classic, points, costs, cost));
    }
    end_line(text);
    text += head + '\n';
    for (std::size_t i = 0; i < of_costs[0].size(); ++i) {
        text += fmt::format("  {:>8} {:>6.0e}", of_costs[0][i].order, of_costs[0][i].limit);
        for (std::size_t w = 0; w < wanted.size(); ++w) {
            const Gain& gain = of_costs[w][i];
            const Cost& cost = costs[wanted[w]];
            const auto cell = [&](const CurvePoint* point) {
                return point == nullptr ? "none"
                                        : fmt::format("{:.{}f}", *ranked_cost(*point, cost),
                                                      cost.kind == Cost::Kind::host_time ? 1 : 0);
            };
            const auto ratio = factor(gain, cost);
            text += fmt::format("   {:>14} {:>14} {:>14}", cell(gain.before), cell(gain.after),
                                ratio ? fmt::format("{:.1f}", *ratio) : "");
        }
        end_line(text);
    }
    text += fmt::format("\n  {:>15}", "factors");
    for (std::size_t w = 0; w < wanted.size(); ++w) {
        text += fmt::format("   {:>14} {:>14} {:>14}", "smallest", "median", "largest");
    }
    text += '\n';
    for (const double limit : error_limits) {
        text += fmt::format("  {:>8} {:>6.0e}", "all", limit);
        for (std::size_t w = 0; w < wanted.size(); ++w) {
            text += spread(of_costs[w], limit, costs[wanted[w]]);
        }
        text += '\n';
    }
    return text;
}

}  // namespace bench::report
