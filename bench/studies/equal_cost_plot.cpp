// The picture of what a number of multiplications buys: a panel for each order and signal.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "base/gnuplot.hpp"
#include "bench/studies/equal_cost.hpp"
#include "bench/studies/equal_cost_errors.hpp"

namespace bench {
namespace {

// What the picture shows: errors against the sum at the costs that were asked for. As many as there are colours.
std::vector<EqualCostWay> drawn_ways() {
    std::vector<EqualCostWay> drawn(equal_cost_ways().begin(), equal_cost_ways().end());
    std::erase_if(drawn, [](const EqualCostWay& way) {
        return way.name == oustaloup_of_derivative || way.label == "full memory";
    });
    return drawn;
}

// What the picture shows, in a sentence: which ways err least at the highest cost, in how many panels.
std::string message(const EqualCost& wanted, const EqualCostErrors& found, const std::vector<EqualCostWay>& ways) {
    std::map<std::string, std::size_t> least;
    std::size_t panels = 0;
    for (const double order : wanted.orders) {
        for (const std::string& signal : wanted.signals) {
            const EqualCostWay* best = nullptr;
            double smallest = 1e300;
            for (const EqualCostWay& way : ways) {
                const auto error = found.find(key_of(way.name, wanted.costs.back(), fmt::format("{}", order), signal));
                if (error != found.end() && error->second < smallest) {
                    smallest = error->second;
                    best = &way;
                }
            }
            if (best != nullptr) {
                ++panels;
                ++least[std::string(best->label)];
            }
        }
    }
    std::vector<std::pair<std::string, std::size_t>> ranked(least.begin(), least.end());
    std::ranges::stable_sort(ranked, std::greater(), &std::pair<std::string, std::size_t>::second);
    std::string text = fmt::format("Of {} panels, at {} multiplications a sample, the least error is that of", panels,
                                   wanted.costs.back());
    for (std::size_t i = 0; i < std::min<std::size_t>(3, ranked.size()); ++i) {
        text += fmt::format("{} {} in {}", i > 0 ? "," : "", ranked[i].first, ranked[i].second);
    }
    return text;
}

}  // namespace

void plot_equal_cost(const EqualCost& wanted, const std::vector<Json>& rows, const std::filesystem::path& stem) {
    const EqualCostErrors found = errors_by_key(rows, Counter::error_max);
    const std::vector<EqualCostWay> drawn_here = drawn_ways();
    constexpr double floor = 1e-10;  // exact ones would flatten all others
    const std::size_t height = 130 + 210 * wanted.orders.size();
    const std::size_t width = 280 + 230 * wanted.signals.size();
    const auto tall = static_cast<double>(height);
    const auto wide = static_cast<double>(width);
    std::string script = fmt::format(
        "set multiplot layout {},{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing {:.4f},{:.4f} title "
        "\"{}\\nError of the sum at equal cost, relative to the largest exact sum (below 10^{{-10}}: drawn "
        "there)\"\nset logscale y\nset "
        "format y \"10^{{%L}}\"\n"
        "set xrange [{}:{}]\nset ytics nomirror\nset mytics 1\nset grid lc rgb \"#dddddd\"\nset xtics nomirror ({})\n",
        wanted.orders.size(), wanted.signals.size(), 70.0 / wide, 1.0 - 220.0 / wide, 60.0 / tall, 1.0 - 75.0 / tall,
        50.0 / wide, 50.0 / tall, message(wanted, found, drawn_here), static_cast<double>(wanted.costs.front()) - 3.0,
        static_cast<double>(wanted.costs.back()) + 3.0, fmt::join(wanted.costs, ", "));
    bool key = true;
    for (std::size_t row = 0; row < wanted.orders.size(); ++row) {
        const std::string order = fmt::format("{}", wanted.orders[row]);
        for (const std::string& signal : wanted.signals) {
            std::vector<std::string> lines;
            double smallest = 1e300;
            double largest = 0.0;
            for (std::size_t i = 0; i < drawn_here.size(); ++i) {
                std::string data;
                for (const std::size_t cost : wanted.costs) {
                    const auto error = found.find(key_of(drawn_here[i].name, cost, order, signal));
                    if (error != found.end() && error->second > 0.0) {
                        const double drawn = std::max(floor, error->second);
                        data += fmt::format("{} {:.6e}\n", cost, drawn);
                        smallest = std::min(smallest, drawn);
                        largest = std::max(largest, drawn);
                    }
                }
                // Of all ways, or the key would lack those without a value in the first panel.
                data += data.empty() ? fmt::format("{} NaN\n", wanted.costs.front()) : "";
                script += fmt::format("$d{} << EOD\n{}EOD\n", i, data);
                lines.push_back(fmt::format(
                    "$d{} using 1:2 with linespoints lw 1.5 pt {} ps 0.7 lc rgb \"{}\" {}", i, 4 + i, base::palette[i],
                    key ? fmt::format("title \"{}\" noenhanced", drawn_here[i].label) : "notitle"));
            }
            const bool last = row + 1 == wanted.orders.size();
            script += fmt::format(
                "set title \"order {}: {}\" offset 0,-0.6\nset yrange {}\nset xlabel \"{}\" offset 0,0.4\n{}\nplot "
                "{}\n",
                base::gnuplot_text(order), base::gnuplot_text(signal),
                largest > 0.0 ? base::log_range(smallest, largest) : "[1e-3:1]", last ? "multiplications a sample" : "",
                // A key that is taller than its panel goes on in a second column, beyond the picture: a tight one, so
                // that all ways stand in one in large fonts, too.
                key ? fmt::format("set key at screen {:.4f}, screen {:.4f} left top Left reverse spacing 1",
                                  1.0 - 205.0 / wide, 1.0 - 75.0 / tall)
                    : "unset key",
                fmt::join(lines, ", \\\n  "));
            key = false;
        }
    }
    base::draw({script + "unset multiplot\n", width, height}, stem);
}

}  // namespace bench
