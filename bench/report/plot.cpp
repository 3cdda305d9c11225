#include "bench/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/gnuplot.hpp"
#include "bench/report/plot_message.hpp"
#include "bench/rows/key.hpp"

namespace bench {
namespace {

using Value = std::function<std::optional<double>(const Group&, const Entry&)>;

// What is drawn of some entries: what each of them has, or at each length of a window the least.
enum class Drawn { lines, points, least };

struct Series {
    Value value;
    std::function<bool(const Entry&)> takes;
    std::string title;  // empty: not in the key
    std::string style;  // gnuplot's
    Drawn drawn = Drawn::lines;
};

Value value_of(std::optional<double> Entry::*member) {
    return [member](const Group&, const Entry& entry) { return entry.*member; };
}

std::string marked(std::size_t index, const char* faint = "") {
    const std::string colour = base::palette[index % std::size(base::palette)];
    return fmt::format("pt {} ps 0.6 lc rgb \"#{}{}\"", 4 + index, faint, colour.substr(1));
}

// Each kernel has its line.
std::vector<Series> series_of_kernels(const std::vector<std::string>& kernels, const Value& value) {
    std::vector<Series> series;
    for (const std::string& kernel : kernels) {
        series.push_back({value, [kernel](const Entry& entry) { return entry.kernel == kernel; }, kernel,
                          "with linespoints lw 1.5 dt 1 " + marked(series.size())});
    }
    return series;
}

// Of more kernels than there are colours nobody follows the lines: those of one number format are points, faint, and
// the best window among them is a line.
std::vector<Series> series_of_formats(const std::vector<std::string>& kernels, const Value& value) {
    std::vector<std::string> formats;
    for (const std::string& kernel : kernels) {
        if (std::find(formats.begin(), formats.end(), number_format_of(kernel)) == formats.end()) {
            formats.push_back(number_format_of(kernel));
        }
    }
    std::vector<Series> series;
    for (std::size_t i = 0; i < formats.size(); ++i) {
        const auto takes = [format = formats[i]](const Entry& entry) {
            return entry.error_max && number_format_of(entry.kernel) == format;
        };
        series.push_back({value, takes, "", "with points " + marked(i, "90"), Drawn::points});
        series.push_back({value, takes, formats[i], "with linespoints lw 1.5 dt 1 " + marked(i), Drawn::least});
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
    void add(double value) {
        smallest = std::min(smallest, value);
        largest = std::max(largest, value);
    }
};

std::string data_block(const std::vector<Group>& groups, const std::string& order, const Series& series, Range& range) {
    std::string block;
    for (const Group& group : groups) {
        const auto taps = taps_of(group, groups);
        // A design's modes have another truncation, and no line joins two designs.
        if (!taps || group.order != order || (series.drawn == Drawn::least && !is_window(group.taps))) {
            continue;
        }
        std::vector<double> values;
        for (const Entry& entry : group.entries) {
            if (const auto value = series.takes(entry) ? series.value(group, entry) : std::nullopt;
                value && *value > 0.0) {
                values.push_back(*value);
            }
        }
        if (series.drawn == Drawn::least && !values.empty()) {
            values = {*std::min_element(values.begin(), values.end())};
        }
        for (const double value : values) {
            block += fmt::format("{} {:.6e}\n", *taps, value);
            range.add(value);
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
        lines.push_back(fmt::format("$d{} using 1:2 {} {}", i, series[i].style, key_entry));
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
        "set multiplot layout {},2 margins 0.06,0.82,{:.3f},{:.3f} spacing 0.06,{:.3f} title \"{}Grünwald-Letnikov "
        "sum: "
        "error against memory length (worst over the signals, relative to the largest exact sum)\"\n"
        "set logscale xy\nset format y \"10^{{%L}}\"\nset xrange [{}:{}]\nset xtics {} nomirror rotate by -45\n"
        "set ytics nomirror\nset mytics 1\nset grid lc rgb \"#dddddd\"\nset xlabel \"terms of the sum: taps, or taps + "
        "modes\"\n",
        orders.size(), 75.0 / height, 1.0 - 85.0 / height, 110.0 / height, plot_message(groups), shortest / 1.25,
        longest * 1.25, tics(groups));
    bool key = true;
    for (const std::string& order : orders) {
        for (const bool rounding : {false, true}) {
            const Value value = value_of(rounding ? &Entry::rounding_error_max : &Entry::error_max);
            auto series = kernels.size() <= std::size(base::palette) ? series_of_kernels(kernels, value)
                                                                     : series_of_formats(kernels, value);
            if (!rounding) {
                const auto any = [](const Entry&) { return true; };
                series.push_back({value_of(&Entry::truncation_error_max), any, "truncation alone",
                                  "with lines lw 1.5 dt 2 lc rgb \"#000000\"", Drawn::least});
                series.push_back({[&bounds](const Group& group, const Entry&) { return bound_of(bounds, group); }, any,
                                  "truncation bound", "with lines lw 1.5 dt 4 lc rgb \"#000000\"", Drawn::least});
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
