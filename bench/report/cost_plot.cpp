// The curves over their costs, by gnuplot.
#include <fmt/format.h>

#include <algorithm>

#include "base/gnuplot.hpp"
#include "bench/report/curves.hpp"
#include "bench/rows/key.hpp"

namespace bench::report {
namespace {

constexpr std::size_t most_orders = 24;

template <class Get>
std::vector<std::string> distinct(const std::vector<CurvePoint>& points, Get get) {
    std::vector<std::string> found;
    for (const CurvePoint& point : points) {
        const std::string name = get(point);
        if (point.entry->error_max && std::find(found.begin(), found.end(), name) == found.end()) {
            found.push_back(name);
        }
    }
    return found;
}

// Four of them stand side by side.
std::string in_two_lines(const std::string& title) {
    const std::string text = base::gnuplot_text(title);
    const std::size_t comma = text.find(", ");
    return comma == std::string::npos ? text : text.substr(0, comma + 1) + "\\n" + text.substr(comma + 2);
}

// One order over one cost: a point for each kernel and length, by format, and the front as steps with its names.
std::string panel(const std::vector<CurvePoint>& points, const std::vector<std::string>& formats,
                  const std::string& order, const Cost& cost, std::size_t c, bool key) {
    std::vector<std::string> data(formats.size());
    std::vector<std::pair<double, double>> front;
    std::vector<double> costs_shown;
    std::vector<double> errors_shown;
    for (const CurvePoint& point : points) {
        const Entry& entry = *point.entry;
        const auto x = cost.of(entry);
        if (point.group->order != order || !x || !entry.error_max || !entry.fault.empty() || *x <= 0.0 ||
            *entry.error_max <= 0.0) {
            continue;
        }
        const auto format = std::find(formats.begin(), formats.end(), number_format_of(entry.kernel)) - formats.begin();
        data[static_cast<std::size_t>(format)] += fmt::format("{:.6e} {:.6e}\n", *x, *entry.error_max);
        costs_shown.push_back(*x);
        errors_shown.push_back(*entry.error_max);
        if (point.front[c]) {
            front.emplace_back(*x, *entry.error_max);
        }
    }
    std::string blocks;
    std::vector<std::string> lines;
    for (std::size_t f = 0; f < formats.size(); ++f) {
        if (!data[f].empty()) {
            blocks += fmt::format("$d{} << EOD\n{}EOD\n", f, data[f]);
            lines.push_back(fmt::format("$d{} using 1:2 with points pt {} ps 0.5 lc rgb \"{}\" title \"{}\" noenhanced",
                                        f, 4 + f, base::palette[f % std::size(base::palette)],
                                        base::gnuplot_text(formats[f])));
        }
    }
    if (lines.empty()) {
        return "set multiplot next\n";
    }
    const auto range = [](const std::vector<double>& values) {
        const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
        return base::log_range(*smallest, *largest);
    };
    std::sort(front.begin(), front.end());
    blocks += "$front << EOD\n";
    for (const auto& [x, y] : front) {
        blocks += fmt::format("{:.6e} {:.6e}\n", x, y);
    }
    blocks += "EOD\n";
    lines.emplace_back("$front using 1:2 with steps lw 1.5 lc rgb \"black\" title \"Pareto front\"");
    lines.emplace_back("$front using 1:2 with points pt 6 ps 0.9 lc rgb \"black\" notitle");
    return blocks +
           fmt::format("set title \"order {}\"\nset xlabel \"{}\"\nset xrange {}\nset yrange {}\n{}\nplot {}\n",
                       base::gnuplot_text(order), in_two_lines(cost.title), range(costs_shown), range(errors_shown),
                       key ? "set key at screen 0.995, screen 0.93" : "unset key", fmt::join(lines, ", \\\n  "));
}

}  // namespace

void plot_costs(const std::filesystem::path& stem, const std::vector<CurvePoint>& points,
                const std::vector<Cost>& costs) {
    auto orders = distinct(points, [](const CurvePoint& point) { return point.group->order; });
    orders.resize(std::min(orders.size(), most_orders));
    const auto formats =
        distinct(points, [](const CurvePoint& point) { return number_format_of(point.entry->kernel); });
    const std::size_t height = 155 + 330 * orders.size();
    const auto share = [&](double pixels) { return pixels / static_cast<double>(height); };
    std::string text = fmt::format(
        "set multiplot layout {},{} margins 0.06,0.88,{:.3f},{:.3f} spacing 0.05,{:.3f} title \"Grünwald-Letnikov sum: "
        "error against cost, every length (worst over the signals, relative to the largest exact sum)\"\n"
        "set logscale xy\nset format xy \"10^{{%L}}\"\nset xtics nomirror\nset ytics nomirror\nset mytics 1\n"
        "set grid lc rgb \"#dddddd\"\n",
        orders.size(), costs.size(), share(75), 1.0 - share(65), share(110));
    bool key = true;
    for (const std::string& order : orders) {
        for (std::size_t c = 0; c < costs.size(); ++c) {
            text += panel(points, formats, order, costs[c], c, key);
            key = false;
        }
    }
    base::draw({text + "unset multiplot\n", 1200, height}, stem);
}

}  // namespace bench::report
