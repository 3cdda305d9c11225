#include "bench/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/gnuplot.hpp"
#include "bench/rows/key.hpp"

namespace bench {
namespace {

using Value = std::function<std::optional<double>(const Group&, const Entry&)>;

struct Series {
    Value value;
    std::string kernel;  // empty: any (the truncation is the same for all)
    std::string title;   // empty: not in the key
    std::string colour;
    int shape;     // of the points; none: -1
    int dash = 1;  // gnuplot's dash types; 1 is a whole line
};

// Up to eight kernels have a colour each; of more, those of one number format share theirs.
std::string label_of(const std::string& kernel, std::size_t kernels) {
    return kernels <= std::size(base::palette) ? kernel : number_format_of(kernel);
}

std::vector<Series> series_of(const std::vector<std::string>& kernels, std::optional<double> Entry::*member) {
    const auto value = [member](const Group&, const Entry& entry) { return entry.*member; };
    std::vector<Series> series;
    std::vector<std::string> labels;
    for (const std::string& kernel : kernels) {
        const std::string label = label_of(kernel, kernels.size());
        const auto found = std::find(labels.begin(), labels.end(), label);
        const auto index = static_cast<std::size_t>(found - labels.begin());
        series.push_back({value, kernel, found == labels.end() ? label : "",
                          base::palette[index % std::size(base::palette)], 4 + static_cast<int>(index)});
        if (found == labels.end()) {
            labels.push_back(label);
        }
    }
    return series;
}

std::vector<std::string> distinct(const std::vector<Group>& groups, bool kernels) {
    std::vector<std::string> found;
    const auto add = [&](const std::string& name) {
        if (std::find(found.begin(), found.end(), name) == found.end()) {
            found.push_back(name);
        }
    };
    for (const Group& group : groups) {
        if (!kernels) {
            add(group.order);
            continue;
        }
        for (const Entry& entry : group.entries) {
            if (entry.error_max) {
                add(entry.kernel);
            }
        }
    }
    return found;
}

// Where a length is drawn; nothing for one that is no length.
std::optional<double> taps_of(const Group& group, const std::vector<Group>& groups) {
    if (group.taps != "full") {
        return taps_number(group.taps);
    }
    double longest = 1.0;  // drawn behind the longest, under its name
    for (const Group& other : groups) {
        longest = std::max(longest, taps_number(other.taps).value_or(1.0));
    }
    return longest * 1.7;
}

std::optional<double> bound_of(const WorstBounds& bounds, const Group& group) {
    const auto of_order = bounds.find(group.order);
    if (of_order == bounds.end()) {
        return std::nullopt;
    }
    const auto found = of_order->second.find(group.taps);
    return found == of_order->second.end() ? std::nullopt : std::optional(found->second);
}

// Smallest and largest of what a panel shows.
struct Range {
    double smallest = 1e300;
    double largest = 0.0;
};

std::string data_block(const std::vector<Group>& groups, const std::string& order, const Series& series, Range& range) {
    std::string block;
    for (const Group& group : groups) {
        // A line of windows alone: a design's modes have another truncation.
        const bool is_of_line = !series.kernel.empty() || is_window(group.taps);
        const auto taps = is_of_line ? taps_of(group, groups) : std::nullopt;
        for (const Entry& entry : group.entries) {
            if (taps && group.order == order && (series.kernel.empty() || entry.kernel == series.kernel)) {
                if (const auto value = series.value(group, entry); value && *value > 0.0) {
                    block += fmt::format("{} {:.6e}\n", *taps, *value);
                    range.smallest = std::min(range.smallest, *value);
                    range.largest = std::max(range.largest, *value);
                    if (series.kernel.empty()) {
                        break;
                    }
                }
            }
        }
    }
    return block;
}

// Marks of the lengths: first those of windows and `full`, then, as far as there is room, those of taps and modes.
std::string tics(const std::vector<Group>& groups) {
    constexpr double room = 1.45;  // between two marks, as a factor
    std::vector<std::string> marks;
    std::vector<double> marked;
    for (const bool windows : {true, false}) {
        for (const Group& group : groups) {
            const auto taps = taps_of(group, groups);
            const bool has_room = taps && std::none_of(marked.begin(), marked.end(), [&](double other) {
                                      return windows ? other == *taps : other < *taps * room && *taps < other * room;
                                  });
            if (has_room && is_window(group.taps) == windows) {
                marked.push_back(*taps);
                marks.push_back(fmt::format("\"{}\" {}", base::gnuplot_text(group.taps), *taps));
            }
        }
    }
    return fmt::format("({})", fmt::join(marks, ", "));
}

std::string panel(const std::vector<Group>& groups, const std::string& order, const std::vector<Series>& series,
                  const std::string& title, bool key) {
    std::string blocks;
    std::vector<std::string> lines;
    Range range;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const std::string data = data_block(groups, order, series[i], range);
        if (data.empty()) {
            continue;
        }
        const std::string key_entry = series[i].title.empty()
                                          ? "notitle"
                                          : fmt::format("title \"{}\" noenhanced", base::gnuplot_text(series[i].title));
        blocks += fmt::format("$d{} << EOD\n{}EOD\n", i, data);
        lines.push_back(fmt::format("$d{} using 1:2 with linespoints lw 1.5 dt {} pt {} ps 0.6 lc rgb \"{}\" {}", i,
                                    series[i].dash, series[i].shape, series[i].colour, key_entry));
    }
    if (lines.empty()) {
        return "set multiplot next\n";
    }
    return blocks + fmt::format("set title \"{}\"\nset yrange {}\n{}\nplot {}\n", title,
                                base::log_range(range.smallest, range.largest),
                                key ? "set key at screen 0.995, screen 0.93" : "unset key",
                                fmt::join(lines, ", \\\n  "));
}

std::string script(const std::vector<Group>& groups, const std::vector<std::string>& orders,
                   const std::vector<std::string>& kernels, const WorstBounds& bounds, double height) {
    double shortest = 1e9;
    double longest = 0.0;
    for (const Group& group : groups) {
        if (const auto taps = taps_of(group, groups)) {
            shortest = std::min(shortest, *taps);
            longest = std::max(longest, *taps);
        }
    }
    std::string text = fmt::format(
        "set multiplot layout {},2 margins 0.06,0.82,{:.3f},{:.3f} spacing 0.06,{:.3f} title \"Grünwald-Letnikov sum: "
        "error against memory length (worst over the signals, relative to the largest exact sum)\"\n"
        "set logscale xy\nset format y \"10^{{%L}}\"\nset xrange [{}:{}]\nset xtics {} nomirror rotate by -45\n"
        "set ytics nomirror\nset mytics 1\nset grid lc rgb \"#dddddd\"\nset xlabel \"terms of the sum: taps, or taps + "
        "modes\"\n",
        orders.size(), 75.0 / height, 1.0 - 65.0 / height, 110.0 / height, shortest / 1.25, longest * 1.25,
        tics(groups));
    bool key = true;
    for (const std::string& order : orders) {
        for (const bool rounding : {false, true}) {
            auto series = series_of(kernels, rounding ? &Entry::rounding_error_max : &Entry::error_max);
            if (!rounding) {
                series.push_back({[](const Group&, const Entry& entry) { return entry.truncation_error_max; }, "",
                                  "truncation alone", "#000000", -1, 2});
                series.push_back({[&bounds](const Group& group, const Entry&) { return bound_of(bounds, group); }, "",
                                  bounds.empty() ? "" : "truncation bound", "#000000", -1, 4});
            }
            text += panel(
                groups, order, series,
                fmt::format("order {}: {}", base::gnuplot_text(order), rounding ? "rounding error" : "total error"),
                !rounding && key);
            key = key && rounding;
        }
    }
    return text + "unset multiplot\n";
}

}  // namespace

void plot_error(const std::vector<Group>& groups, const WorstBounds& bounds, const std::filesystem::path& stem) {
    constexpr std::size_t most_orders = 24;  // beyond that nobody reads it, and gnuplot refuses the size
    constexpr std::size_t most_kernels = 200;
    auto orders = distinct(groups, false);
    auto kernels = distinct(groups, true);
    orders.resize(std::min(orders.size(), most_orders));
    kernels.resize(std::min(kernels.size(), most_kernels));
    const std::size_t height = 140 + 330 * orders.size();
    base::draw({script(groups, orders, kernels, bounds, static_cast<double>(height)), 1200, height}, stem);
}

}  // namespace bench
