#include "bench/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "bench/files.hpp"
#include "qemu/failure.hpp"

namespace bench {
namespace {

// Okabe and Ito's palette, which colour-blind readers can tell apart; black is the truncation.
constexpr const char* palette[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#8C6D1F", "#666666"};

struct Series {
    std::optional<double> Entry::*value;
    std::string kernel;  // empty: any (the truncation is the same for all)
    std::string title;   // empty: not in the key
    std::string colour;
    std::size_t shape;  // of the points
};

// Up to eight kernels have a colour each; of more, those of one number format share theirs.
std::string label_of(const std::string& kernel, std::size_t kernels) {
    return kernels <= std::size(palette) ? kernel : kernel.substr(kernel.rfind('_') + 1);
}

std::vector<Series> series_of(const std::vector<std::string>& kernels, std::optional<double> Entry::*value) {
    std::vector<Series> series;
    std::vector<std::string> labels;
    for (const std::string& kernel : kernels) {
        const std::string label = label_of(kernel, kernels.size());
        const auto found = std::find(labels.begin(), labels.end(), label);
        const auto index = static_cast<std::size_t>(found - labels.begin());
        series.push_back(
            {value, kernel, found == labels.end() ? label : "", palette[index % std::size(palette)], 4 + index});
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

double taps_of(const Group& group, const std::vector<Group>& groups) {
    if (group.taps != "full") {
        return std::stod(group.taps);
    }
    double longest = 1.0;  // drawn behind the longest, under its name
    for (const Group& other : groups) {
        longest = other.taps == "full" ? longest : std::max(longest, std::stod(other.taps));
    }
    return longest * 1.7;
}

std::string data_block(const std::vector<Group>& groups, const std::string& order, const Series& series) {
    std::string block;
    for (const Group& group : groups) {
        for (const Entry& entry : group.entries) {
            if (group.order == order && (series.kernel.empty() || entry.kernel == series.kernel)) {
                if (const auto value = entry.*series.value; value && *value > 0.0) {
                    block += fmt::format("{} {:.6e}\n", taps_of(group, groups), *value);
                    if (series.kernel.empty()) {
                        break;
                    }
                }
            }
        }
    }
    return block;
}

std::string tics(const std::vector<Group>& groups) {
    std::vector<std::string> marks;
    std::vector<std::string> seen;
    for (const Group& group : groups) {
        if (std::find(seen.begin(), seen.end(), group.taps) == seen.end()) {
            seen.push_back(group.taps);
            marks.push_back(fmt::format("\"{}\" {}", group.taps, taps_of(group, groups)));
        }
    }
    return fmt::format("({})", fmt::join(marks, ", "));
}

std::string panel(const std::vector<Group>& groups, const std::string& order, const std::vector<Series>& series,
                  const std::string& title, bool key) {
    std::string blocks;
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < series.size(); ++i) {
        const std::string data = data_block(groups, order, series[i]);
        if (data.empty()) {
            continue;
        }
        const bool truncation = series[i].kernel.empty();
        const std::string key_entry =
            series[i].title.empty() ? "notitle" : fmt::format("title \"{}\" noenhanced", series[i].title);
        blocks += fmt::format("$d{} << EOD\n{}EOD\n", i, data);
        lines.push_back(fmt::format("$d{} using 1:2 with linespoints lw 1.5 dt {} pt {} ps 0.6 lc rgb \"{}\" {}", i,
                                    truncation ? 2 : 1, truncation ? -1 : static_cast<int>(series[i].shape),
                                    series[i].colour, key_entry));
    }
    if (lines.empty()) {
        return "set multiplot next\n";
    }
    return blocks + fmt::format("set title \"{}\"\n{}\nplot {}\n", title,
                                key ? "set key at screen 0.995, screen 0.93" : "unset key",
                                fmt::join(lines, ", \\\n  "));
}

std::string script(const std::vector<Group>& groups, const std::string& terminal, const std::string& output,
                   double height) {
    const auto orders = distinct(groups, false);
    const auto kernels = distinct(groups, true);
    double shortest = 1e9;
    double longest = 0.0;
    for (const Group& group : groups) {
        shortest = std::min(shortest, taps_of(group, groups));
        longest = std::max(longest, taps_of(group, groups));
    }
    std::string text = fmt::format(
        "set terminal {}\nset output \"{}\"\n"
        "set multiplot layout {},2 margins 0.06,0.82,{:.3f},{:.3f} spacing 0.06,{:.3f} title \"Grünwald-Letnikov sum: "
        "error against memory length (worst over the signals, relative to the largest exact sum)\"\n"
        "set logscale xy\nset format y \"10^{{%L}}\"\nset xrange [{}:{}]\nset xtics {} nomirror rotate by -45\n"
        "set ytics nomirror\nset mytics 1\nset grid lc rgb \"#dddddd\"\nset xlabel \"taps\"\n",
        terminal, output, orders.size(), 75.0 / height, 1.0 - 65.0 / height, 110.0 / height, shortest / 1.25,
        longest * 1.25, tics(groups));
    bool key = true;
    for (const std::string& order : orders) {
        for (const bool rounding : {false, true}) {
            auto series = series_of(kernels, rounding ? &Entry::rounding_error_max : &Entry::error_max);
            if (!rounding) {
                series.push_back({&Entry::truncation_error_max, "", "truncation alone", "#000000", 0});
            }
            text += panel(groups, order, series,
                          fmt::format("order {}: {}", order, rounding ? "rounding error" : "total error"),
                          !rounding && key);
            key = key && rounding;
        }
    }
    return text + "unset multiplot\nunset output\n";
}

void run_gnuplot(const std::string& text, const std::filesystem::path& path) {
    FILE* pipe = popen("gnuplot >/dev/null", "w");
    const bool written = pipe != nullptr && std::fwrite(text.data(), 1, text.size(), pipe) == text.size();
    const int status = pipe != nullptr ? pclose(pipe) : -1;
    if (!written || status != 0) {
        throw glsum::Failure(glsum::Exit::missing,
                             fmt::format("{}: gnuplot failed (Debian package gnuplot-nox)", path.string()));
    }
}

}  // namespace

void plot_error(const std::vector<Group>& groups, const std::filesystem::path& stem) {
    const std::size_t height = 140 + 330 * distinct(groups, false).size();
    for (const bool svg : {true, false}) {
        std::filesystem::path path = stem;
        path += svg ? ".svg" : ".png";
        const std::filesystem::path partial = partial_name(path);
        const std::string terminal =
            svg ? fmt::format("svg size 1200,{} font \"Helvetica,12\" background rgb \"white\"", height)
                : fmt::format("pngcairo size 1200,{} font \"Helvetica,10\" background rgb \"white\"", height);
        run_gnuplot(script(groups, terminal, partial.string(), static_cast<double>(height)), path);
        publish(partial, path);
    }
}

}  // namespace bench
