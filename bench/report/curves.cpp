#include "bench/report/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/files.hpp"
#include "bench/rows/csv.hpp"
#include "bench/rows/front.hpp"

namespace bench::report {
namespace {

// Null where they were not modelled.
const ModelCycles* cycles_on(const std::string& core, const Entry& entry) {
    const auto found = entry.model_cycles.find(core);
    return found == entry.model_cycles.end() ? nullptr : &found->second;
}

}  // namespace

std::vector<Cost> costs_of(const std::vector<Group>& groups) {
    bool host = false;
    bool target = false;
    for (const Group& group : groups) {
        for (const Entry& entry : group.entries) {
            host = host || entry.host_ns;
            target = target || entry.target_instructions;
        }
    }
    std::vector<Cost> costs;
    if (host) {
        costs.push_back({Cost::Kind::host_time, "", "host_ns", "host, ns per sample",
                         [](const Entry& entry) { return entry.host_ns; }});
    }
    const base::Machine* const known = counted_on(groups);
    const base::Machine* const counted = known != nullptr ? known : base::machines.data();
    if (target) {
        costs.push_back({Cost::Kind::instructions, "", "instructions",
                         fmt::format("emulated {}, instructions per sample (not cycles)", counted->name),
                         [](const Entry& entry) { return entry.target_instructions; }, counted});
    }
    for (const auto& [machine, core] : modelled_cores(groups)) {
        costs.push_back({Cost::Kind::model_cycles, core, "model_cycles:" + core, core + ", modelled cycles per sample",
                         [core = core](const Entry& entry) {
                             const ModelCycles* const cycles = cycles_on(core, entry);
                             return cycles == nullptr ? std::nullopt : std::optional(cycles->median);
                         },
                         machine});
    }
    costs.push_back({Cost::Kind::bytes, "", "bytes", "bytes of state and coefficients",
                     [](const Entry& entry) { return entry.bytes; }});
    return costs;
}

std::optional<double> ranked_cost(const CurvePoint& point, const Cost& cost) {
    const Entry& entry = *point.entry;
    return entry.error_max && entry.fault.empty() ? cost.of(entry) : std::nullopt;
}

void set_fronts(std::vector<CurvePoint>& points, const std::vector<Cost>& costs) {
    std::map<std::string, std::vector<std::size_t>> by_order;
    for (std::size_t i = 0; i < points.size(); ++i) {
        by_order[points[i].group->order].push_back(i);
    }
    for (const auto& [order, members] : by_order) {
        for (std::size_t c = 0; c < costs.size(); ++c) {
            std::vector<Point> ranked;
            std::vector<std::size_t> at;
            for (const std::size_t i : members) {
                points[i].front[c] = false;
                if (const auto cost = ranked_cost(points[i], costs[c])) {
                    ranked.push_back({*cost, *points[i].entry->error_max});
                    at.push_back(i);
                }
            }
            const std::vector<bool> front = on_front(ranked);
            for (std::size_t i = 0; i < at.size(); ++i) {
                points[at[i]].front[c] = front[i];
            }
        }
    }
}

std::vector<CurvePoint> curve_points(const std::vector<Group>& groups, const std::vector<Cost>& costs) {
    std::vector<CurvePoint> points;
    for (const Group& group : groups) {
        for (const Entry& entry : group.entries) {
            points.push_back({&group, &entry, std::vector<bool>(costs.size())});
        }
    }
    set_fronts(points, costs);
    return points;
}

void write_curves(const std::filesystem::path& path, const std::vector<CurvePoint>& points,
                  const std::vector<Cost>& costs, const WorstBounds& bounds) {
    std::string text =
        "order,kernel,taps,error_max,rounding_error_max,truncation_error_max,truncation_bound,effective_taps";
    for (const Cost& cost : costs) {
        text += ',' + csv_field(cost.name);
        if (cost.kind == Cost::Kind::model_cycles) {
            for (const Counter end : {Counter::model_cycles_low, Counter::model_cycles_high}) {
                text += ',' + csv_field(fmt::format("{}:{}", name_of(end), cost.core));
            }
        }
    }
    for (const Cost& cost : costs) {
        text += ',' + csv_field("front:" + cost.name);
    }
    text += ",fault\n";
    const auto add = [&](std::optional<double> value) { text += value ? fmt::format(",{}", *value) : ","; };
    for (const CurvePoint& point : points) {
        const Entry& entry = *point.entry;
        text += fmt::format("{},{},{}", csv_field(point.group->order), csv_field(entry.kernel),
                            csv_field(point.group->taps));
        const auto of_order = bounds.find(point.group->order);
        const auto bound = of_order == bounds.end() ? std::nullopt : [&]() -> std::optional<double> {
            const auto found = of_order->second.find(point.group->taps);
            return found == of_order->second.end() ? std::nullopt : std::optional(found->second);
        }();
        for (const auto& value :
             {entry.error_max, entry.rounding_error_max, entry.truncation_error_max, bound, entry.effective_taps}) {
            add(value);
        }
        for (const Cost& cost : costs) {
            add(cost.of(entry));
            if (cost.kind == Cost::Kind::model_cycles) {
                const ModelCycles* const cycles = cycles_on(cost.core, entry);
                add(cycles == nullptr ? std::nullopt : cycles->low);
                add(cycles == nullptr ? std::nullopt : cycles->high);
            }
        }
        for (std::size_t c = 0; c < costs.size(); ++c) {
            text += point.front[c] ? ",1" : ",0";
        }
        text += ',' + csv_field(entry.fault) + '\n';
    }
    base::write_file(path, text);
}

}  // namespace bench::report
