// The picture of the fronts: a panel for each order and band.
#include <fmt/format.h>

#include <algorithm>

#include "base/gnuplot.hpp"
#include "bench/studies/bands.hpp"

namespace bench {
namespace {

struct Series {
    const char* title;
    std::size_t colour;
    bool (*has)(const BandPoint&);
};

bool is_by(const BandPoint& point, glsum::design::RationalRule rule) {
    const Rival* const rival = rival_of(point.way);
    return rival != nullptr && rival->rule == rule;
}

constexpr Series all_series[] = {
    {"Oustaloup, tuned", 1, [](const BandPoint& p) { return is_by(p, glsum::design::RationalRule::oustaloup); }},
    {"Charef, tuned", 2, [](const BandPoint& p) { return is_by(p, glsum::design::RationalRule::charef); }},
    {"fitted, as the kernel holds it", 0, [](const BandPoint& p) { return rival_of(p.way) == nullptr; }},
};

// Those that no other of the series betters, by rising cycles.
std::vector<BandPoint> front_of(std::vector<BandPoint> points) {
    std::sort(points.begin(), points.end(), [](const BandPoint& a, const BandPoint& b) {
        return a.model_cycles != b.model_cycles ? a.model_cycles < b.model_cycles : a.error < b.error;
    });
    std::vector<BandPoint> front;
    for (const BandPoint& point : points) {
        if (front.empty() || point.error < front.back().error) {
            front.push_back(point);
        }
    }
    return front;
}

// What the picture shows, in a sentence.
std::string message(const std::vector<BandPoint>& points) {
    std::vector<double> ratios;
    for (const BandRival& one : compare_bands(points)) {
        ratios.push_back(one.ratio());
    }
    if (ratios.empty()) {
        return "";
    }
    std::ranges::sort(ratios);
    const auto behind = std::ranges::count_if(ratios, [](double ratio) { return ratio < 1.0; });
    return fmt::format(
        "Of {} comparisons at equal cycles the fitted filter errs more in {}; in the median the others err {:.3g} "
        "times as much\\n",
        ratios.size(), behind, ratios[ratios.size() / 2]);
}

}  // namespace

void plot_bands(const BandStudy& study, const std::vector<BandPoint>& points, const std::filesystem::path& stem) {
    const std::size_t width = 120 + 290 * study.bands.size();
    const std::size_t height = 150 + 220 * study.orders.size();
    const auto wide = static_cast<double>(width);
    const auto tall = static_cast<double>(height);
    double most = 0.0;
    for (const BandPoint& point : points) {
        most = std::max(most, point.model_cycles);
    }
    std::string script = fmt::format(
        "set multiplot layout {},{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing {:.4f},{:.4f} title \"{}Error over the "
        "band, over modelled Cortex-M7 cycles a sample: filters fitted to it, and those of others tuned to it\"\nset "
        "logscale y\nset "
        "format y \"%g %%\"\nset xrange [0:{:.0f}]\nset ytics nomirror\nset mytics 1\nset xtics nomirror\nset grid lc "
        "rgb \"#dddddd\"\n",
        study.orders.size(), study.bands.size(), 90.0 / wide, 1.0 - 20.0 / wide, 60.0 / tall, 1.0 - 110.0 / tall,
        75.0 / wide, 55.0 / tall, message(points), 1.05 * most);
    bool key = true;
    for (const double order : study.orders) {
        for (const auto& band : study.bands) {
            std::vector<std::string> lines;
            double smallest = 1e300;
            double largest = 0.0;
            std::size_t number = 0;
            for (const Series& series : all_series) {
                std::vector<BandPoint> of_series;
                std::copy_if(points.begin(), points.end(), std::back_inserter(of_series),
                             [&](const BandPoint& p) { return p.order == order && p.band == band && series.has(p); });
                std::string data;
                for (const BandPoint& point : front_of(of_series)) {
                    data += fmt::format("{} {:.6e}\n", point.model_cycles, 100.0 * point.error);
                    smallest = std::min(smallest, 100.0 * point.error);
                    largest = std::max(largest, 100.0 * point.error);
                }
                data += data.empty() ? "0 NaN\n" : "";
                script += fmt::format("$d{} << EOD\n{}EOD\n", number, data);
                lines.push_back(fmt::format("$d{} using 1:2 with linespoints lw 1.8 pt {} ps 0.7 lc rgb \"{}\" {}",
                                            number, 5 + 2 * number, base::palette[series.colour],
                                            key ? fmt::format("title \"{}\"", series.title) : "notitle"));
                ++number;
            }
            script += fmt::format(
                "set title \"order {}, {} to {} Hz\" offset 0,-0.6\nset yrange {}\nset xlabel \"{}\" offset "
                "0,0.4\n{}\nplot {}\n",
                order, band.low_hz, band.high_hz, largest > 0.0 ? base::log_range(smallest, largest) : "[1e-3:1]",
                order == study.orders.back() ? "modelled cycles a sample" : "",
                key ? fmt::format("set key horizontal at screen 0.5, screen {:.4f} center center", 1.0 - 62.0 / tall)
                    : "unset key",
                fmt::join(lines, ", \\\n  "));
            key = false;
        }
    }
    base::draw({script + "unset multiplot\n", width, height}, stem);
}

}  // namespace bench
