#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bench/studies/horizon_case.hpp"

namespace bench {
namespace {

// What the picture shows, in a sentence.
std::string message(const std::vector<HorizonCase>& cases) {
    std::size_t window = 0;
    std::size_t modes = 0;
    for (const HorizonCase& one : cases) {
        if (one.samples == cases.back().samples) {
            window = std::max(window, one.window_macs());
            modes = std::max(modes, one.modes ? one.modes->multiplications() : 0);
        }
    }
    return fmt::format(
        "Over {} samples a window takes up to {} multiplications a sample, near taps and modes at most {}",
        cases.back().samples, window, modes);
}

}  // namespace

base::Picture picture_of(const std::vector<double>& orders, const std::vector<HorizonCase>& cases) {
    const std::size_t width = 280 + 260 * orders.size();
    const std::size_t height = 110 + 230 * horizon_errors.size();
    const auto wide = static_cast<double>(width);
    const auto tall = static_cast<double>(height);
    const auto shortest = static_cast<double>(cases.front().samples);
    const auto longest = static_cast<double>(cases.back().samples);
    std::string script = fmt::format(
        "set multiplot layout {},{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing {:.4f},{:.4f} title "
        "\"{}\\nMultiplications a sample for an error of the sum, over the samples that the past may hold\"\n"
        "set logscale xy\nset format \"10^{{%L}}\"\nset xtics nomirror\nset ytics nomirror\nset mxtics 1\nset mytics "
        "1\n"
        "set grid lc rgb \"#dddddd\"\nset xrange [{}:{}]\nset yrange [3:{}]\n",
        horizon_errors.size(), orders.size(), 65.0 / wide, 1.0 - 235.0 / wide, 60.0 / tall, 1.0 - 70.0 / tall,
        50.0 / wide, 60.0 / tall, message(cases), shortest / 2.0, longest * 2.0, longest * 2.0);
    const auto data_of = [&](std::size_t way, double order, double error) {
        std::string data;
        for (const HorizonCase& one : cases) {
            if (one.order != order || one.error != error) {
                continue;
            }
            std::optional<std::size_t> macs = one.window_macs();
            if (way == 1) {
                macs = one.blocks;
            } else if (way == 2) {
                macs = one.modes ? std::optional(one.modes->multiplications()) : std::nullopt;
            }
            data += macs ? fmt::format("{} {}\n", one.samples, *macs) : "";
        }
        return data.empty() ? std::string("1000 NaN\n") : data;
    };
    constexpr std::string_view titles[] = {"window", "near taps and blocks", "near taps and modes"};
    std::string key = fmt::format("set key at screen {:.4f}, screen {:.4f} left top Left reverse spacing 1.4",
                                  1.0 - 222.0 / wide, 1.0 - 70.0 / tall);
    for (const double error : horizon_errors) {
        for (const double order : orders) {
            std::vector<std::string> lines;
            for (std::size_t way = 0; way < std::size(titles); ++way) {
                script += fmt::format("$d{} << EOD\n{}EOD\n", way, data_of(way, order, error));
                lines.push_back(
                    fmt::format("$d{} using 1:2 with linespoints lw 1.8 pt {} ps 0.8 lc rgb \"{}\" title \"{}\"", way,
                                5 + 2 * way, base::palette[way], titles[way]));
            }
            script += fmt::format(
                "set title \"order {}, error 10^{{{:.0f}}}\" offset 0,-0.6\nset xlabel \"{}\" offset 0,0.4\n{}\nplot "
                "{}\n",
                order, std::log10(error), error == horizon_errors.back() ? "samples" : "", key,
                fmt::join(lines, ", \\\n  "));
            key = "unset key";
        }
    }
    return {script + "unset multiplot\n", width, height};
}

}  // namespace bench
