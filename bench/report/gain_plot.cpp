// The front of the classic windows beside that of all kernels, by gnuplot.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/gnuplot.hpp"
#include "bench/report/best.hpp"
#include "bench/report/classic.hpp"
#include "bench/rows/median.hpp"

namespace bench::report {
namespace {

constexpr std::size_t most_orders = 24;
constexpr std::array<double, 3> marked_limits = {1e-2, 1e-4, 1e-6};
constexpr double least_error = 1e-9;  // below, both fronts are kernels in double, and the limits would lie too close
constexpr double above_all = 1e30;
constexpr double label_room = 2.0;  // a factor stands to the right of the costliest

using Line = std::vector<std::pair<double, double>>;  // cost and error, both above 0, the cheapest first

Line front_line(const std::vector<CurvePoint>& points, const std::string& order, const Cost& cost, std::size_t c) {
    Line line;
    for (const CurvePoint& point : points) {
        if (point.group->order == order && point.front[c]) {
            const double x = *ranked_cost(point, cost);
            const double y = *point.entry->error_max;
            if (x > 0.0 && y > 0.0) {
                line.emplace_back(x, y);
            }
        }
    }
    std::sort(line.begin(), line.end());
    line.erase(std::unique(line.begin(), line.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
               line.end());  // of one cost the smallest error
    return line;
}

struct Fronts {
    std::string order;
    Line before;
    Line after;
    std::vector<Gain> gains;
};

// Its first point stands on a line from above: nothing cheaper errs less than the axis shows.
std::string data_block(const char* name, const Line& line) {
    std::string text = fmt::format("${} << EOD\n{:.6e} {:.6e}\n", name, line.front().first, above_all);
    for (const auto& [x, y] : line) {
        text += fmt::format("{:.6e} {:.6e}\n", x, y);
    }
    return text + "EOD\n";
}

// At each marked error a line from one front to the other, and how often the one cost goes into the other.
std::string factors(const Fronts& fronts, const Cost& cost) {
    std::string text = "unset arrow\nunset label\n";
    for (const Gain& gain : fronts.gains) {
        const auto ratio = factor(gain, cost);
        const bool marked = std::find(marked_limits.begin(), marked_limits.end(), gain.limit) != marked_limits.end();
        if (!marked || !ratio) {
            continue;
        }
        const double from = *ranked_cost(*gain.before, cost);
        const double to = *ranked_cost(*gain.after, cost);
        text += fmt::format(
            "set arrow from {:.6e},{:.0e} to {:.6e},{:.0e} head filled size screen 0.006,20 lw 1 lc rgb "
            "\"#444444\" front\n",
            from, gain.limit, to, gain.limit);
        // Behind its tail and above it no front can run: from there on the one before errs less, and the other as well.
        text += fmt::format("set label \"{:.{}f}×\" at {:.6e},{:.0e} left offset 0.6,0.5 tc rgb \"#222222\" front\n",
                            *ratio, *ratio < 10.0 ? 1 : 0, from, gain.limit);
    }
    return text;
}

std::string panel(const Fronts& fronts, const Cost& cost, bool left, bool key) {
    std::string blocks;
    std::vector<std::string> plots;
    const auto add = [&](const char* name, const Line& line, int width, const char* colour, int shape,
                         const char* title) {
        if (!line.empty()) {
            blocks += data_block(name, line);
            plots.push_back(fmt::format("${} using 1:2 with steps lw {} lc rgb \"{}\" notitle", name, width, colour));
            plots.push_back(fmt::format("${} every ::1 using 1:2 with points pt {} ps 0.6 lc rgb \"{}\" notitle", name,
                                        shape, colour));
        }
        if (key) {
            plots.push_back(fmt::format("keyentry with linespoints lw {} pt {} ps 0.8 lc rgb \"{}\" title \"{}\"",
                                        width, shape, colour, title));
        }
    };
    if (fronts.before.empty() && fronts.after.empty()) {
        return "set multiplot next\n";
    }
    // The wider one shows from under the other where both are the same.
    add("before", fronts.before, 4, base::palette[4], 5, "before: shift, ring and mirror windows");
    add("after", fronts.after, 2, base::palette[0], 7, "after: all kernels");
    return blocks + factors(fronts, cost) +
           fmt::format("set label \"order {}\" at graph 0.97,0.91 right\nset xlabel \"{}\"\n{}\n{}\nplot {}\n",
                       base::gnuplot_text(fronts.order), base::gnuplot_text(cost.title),
                       left ? "set ylabel \"error / largest exact sum\"" : "unset ylabel",
                       key ? "set key at screen 0.5, screen key_at center" : "unset key", fmt::join(plots, ", \\\n  "));
}

// Both fronts of each order over one cost. At most `most_orders`.
std::vector<Fronts> fronts_over(const std::vector<CurvePoint>& classic, const std::vector<CurvePoint>& points,
                                const std::vector<Cost>& costs, std::size_t c) {
    std::vector<Fronts> all;
    for (const Gain& gain : gains(classic, points, costs, c)) {
        if (all.empty() || all.back().order != gain.order) {
            if (all.size() == most_orders) {
                break;
            }
            all.push_back({gain.order,
                           front_line(classic, gain.order, costs[c], c),
                           front_line(points, gain.order, costs[c], c),
                           {}});
        }
        all.back().gains.push_back(gain);
    }
    return all;
}

// One range for all panels of a cost, so that they can be held against each other.
std::string ranges(const std::vector<Fronts>& all) {
    Line every;
    for (const Fronts& fronts : all) {
        every.insert(every.end(), fronts.before.begin(), fronts.before.end());
        every.insert(every.end(), fronts.after.begin(), fronts.after.end());
    }
    if (every.empty()) {
        return "";
    }
    const auto by_error = [](const auto& one, const auto& other) { return one.second < other.second; };
    const auto [cheapest, costliest] = std::minmax_element(every.begin(), every.end());
    const auto [best, worst] = std::minmax_element(every.begin(), every.end(), by_error);
    return fmt::format("set xrange {}\nset yrange {}\n",
                       base::log_range(cheapest->first, label_room * costliest->first),
                       base::log_range(std::max(best->second, least_error), std::max(worst->second, least_error)));
}

// What the picture shows, in a sentence: of each cost how many times it is, in the median of the orders.
class Message {
public:
    void add(const std::vector<Fronts>& all, const Cost& cost) {
        std::vector<double> ratios;
        for (const Fronts& fronts : all) {
            for (const Gain& gain : fronts.gains) {
                const auto ratio = factor(gain, cost);
                if (gain.limit == told_limit && ratio) {
                    ratios.push_back(*ratio);
                }
            }
        }
        if (!ratios.empty()) {
            const double median = median_of(std::move(ratios));
            parts_.push_back(
                fmt::format("{}: {:.{}f} times", base::gnuplot_text(cost.title), median, median < 10.0 ? 1 : 0));
        }
    }
    [[nodiscard]] std::string text() const {
        return parts_.empty() ? ""
                              : fmt::format(
                                    "What the best window costs beside the best kernel at an error of 1e-4, "
                                    "median of the orders: {}\\n",
                                    fmt::join(parts_, "; "));
    }

private:
    static constexpr double told_limit = 1e-4;
    std::vector<std::string> parts_;
};

}  // namespace

void plot_gains(const std::filesystem::path& stem, const std::vector<CurvePoint>& points,
                const std::vector<Cost>& costs) {
    const std::vector<CurvePoint> classic = classic_points(points, costs);
    Message message;
    std::string panels;
    std::size_t drawn = 0;
    std::size_t columns = 1;
    bool key = true;
    for (const std::size_t c : gain_costs(points, costs)) {
        const std::vector<Fronts> all = fronts_over(classic, points, costs, c);
        columns = std::min<std::size_t>(3, all.size());
        panels += ranges(all);
        message.add(all, costs[c]);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::string text = panel(all[i], costs[c], i % columns == 0, key);
            key = key && text.find("keyentry") == std::string::npos;
            panels += text;
        }
        drawn += all.size();
        for (; drawn % columns != 0; ++drawn) {
            panels += "set multiplot next\n";
        }
    }
    const std::size_t rows = std::max<std::size_t>(1, drawn / columns);
    const std::size_t height = 122 + 265 * rows;
    const auto share = [&](double pixels) { return pixels / static_cast<double>(height); };
    const auto power = [](double limit) { return fmt::format("1e{:.0f}", std::log10(limit)); };
    std::vector<std::string> marks;
    std::transform(marked_limits.begin(), marked_limits.end(), std::back_inserter(marks), power);
    const std::string head = fmt::format(
        "key_at = {:.4f}\nset multiplot layout {},{} margins 0.06,0.985,{:.4f},{:.4f} spacing 0.05,{:.4f} "
        "title \"{}Grünwald-Letnikov sum: Pareto fronts of error and cost, before and after\\n"
        "Worst of the signals; errors below {} are not shown; arrows: how many times the cost, at errors of {}\"\n"
        "set logscale xy\nset format xy \"10^{{%L}}\"\nset xtics nomirror\nset ytics nomirror\nset mytics 1\n"
        "set grid lc rgb \"#dddddd\"\n",
        1.0 - share(66), rows, columns, share(50), 1.0 - share(96), share(60), message.text(), power(least_error),
        fmt::join(marks, ", "));
    base::draw({head + panels + "unset multiplot\n", 1200, height}, stem);
}

}  // namespace bench::report
