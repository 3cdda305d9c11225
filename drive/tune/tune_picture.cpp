#include "drive/tune/tune_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "drive/tune/tune_report.hpp"

namespace tune {
namespace {

struct Shown {
    const Design* design;
    const char* name;
    const char* style;
    const char* colour = base::palette[0];
    const char* title = name;
};

// Frequency, |L|, phase in degrees, |S|.
std::string frequencies(const SampledPlant& plant, const Design& design, double low, double high) {
    const Loop loop{&plant, design.controller.gains};
    constexpr int points = 600;
    double phase = -0.5 * pi * (plant.integrations() + design.controller.gains.integral_order);
    std::string data;
    for (int i = 0; i <= points; ++i) {
        const double w = low * std::pow(high / low, static_cast<double>(i) / points);
        const Complex value = loop(w);
        phase += std::remainder(std::arg(value) - phase, 2.0 * pi);
        data += fmt::format("{:.6e} {:.6e} {:.6e} {:.6e}\n", w, std::abs(value), phase * 180.0 / pi,
                            1.0 / std::abs(1.0 + value));
    }
    return data;
}

std::string course(const Course& course) {
    std::string data;
    const std::size_t stride = std::max<std::size_t>(1, course.time_s.size() / 2500);
    for (std::size_t i = 0; i < course.time_s.size(); i += stride) {
        data += fmt::format("{:.6e} {:.6e} {:.6e}\n", course.time_s[i], course.output[i], course.input[i]);
    }
    return data;
}

}  // namespace

base::Picture picture_of(const Tuned& tuned, const std::string& name) {
    const SampledPlant plant(tuned.plant, tuned.request.sample_time_s, name);
    std::vector<Shown> shown;
    if (tuned.steep) {
        shown.push_back({&*tuned.steep, "steep", "dt 3 lc rgb", base::palette[2], "integer, not flat"});
    }
    if (tuned.integer) {
        shown.push_back({&*tuned.integer, "integer", "dt 2 lc rgb", base::palette[1]});
    }
    if (tuned.fractional) {
        shown.push_back({&*tuned.fractional, "fractional", "lc rgb"});
    }
    std::string script;
    const double middle = shown.back().design->margins.crossover;
    const double low = middle / 50.0;
    const double high = std::min(middle * 20.0, plant.nyquist());
    for (const Shown& one : shown) {
        script += fmt::format("$f{0} << EOD\n{1}EOD\n$t{0} << EOD\n{2}EOD\n", one.name,
                              frequencies(plant, *one.design, low, high), course(one.design->course));
    }
    const auto plot = [&](const char* block, int column) {
        std::vector<std::string> curves;
        for (const Shown& one : shown) {
            curves.push_back(fmt::format("${}{} using 1:{} with lines lw 2 {} \"{}\" title \"{}\"", block, one.name,
                                         column, one.style, one.colour, one.title));
        }
        return fmt::format("plot {}\n", fmt::join(curves, ", \\\n  "));
    };
    const auto line = [](double x0, double y0, double x1, double y1, const char* units) {
        return fmt::format(
            "set arrow 1 from {3} {0:.6g},{1:.6g} to {3} {2:.6g},{4:.6g} nohead lc rgb \"#888888\" back\n", x0, y0, x1,
            units, y1);
    };
    script += fmt::format(
        "set multiplot layout 2,3 title \"{}\\n{}: {}\" noenhanced\nset grid lc rgb \"#dddddd\"\nset border 3\nset "
        "tics nomirror\nset logscale x\nset format x \"10^{{%L}}\"\nset xrange [{:.6e}:{:.6e}]\nset xlabel \"rad/s\" "
        "offset 0,0.5\nset key bottom left\n",
        conclusion(tuned), base::gnuplot_text(name), wish_text(tuned), low, high);
    script += "set title \"open loop: gain\"\nset logscale y\nset yrange [0.01:100]\n" +
              line(low, 1, high, 1, "first") + plot("f", 2);
    script +=
        "unset key\nset title \"open loop: phase, degrees\"\nunset logscale y\nset yrange [-360:0]\nset ytics 60\n" +
        line(low, -180, high, -180, "first") + plot("f", 3);
    script +=
        fmt::format("set title \"|S|\"\nset ytics autofreq\nset yrange [0:{:.4g}]\n{}{}", 1.3 * tuned.wish.sensitivity,
                    line(low, tuned.wish.sensitivity, high, tuned.wish.sensitivity, "first"), plot("f", 4));
    script +=
        "unset arrow 1\nunset logscale x\nset format x \"%g\"\nset xrange [0:*]\nset yrange [*:*]\nset xlabel \"t "
        "[s]\" offset 0,0.5\nset title \"output: set point, then load\"\n" +
        plot("t", 2) + "set title \"input\"\n" + plot("t", 3) +
        fmt::format("set title \"output: the load\"\nset xrange [{:.6g}:{:.6g}]\n", tuned.trial.until_s,
                    1.6 * tuned.trial.until_s) +
        plot("t", 2) + "unset multiplot\n";
    return {script, 1200, 680};
}

}  // namespace tune
