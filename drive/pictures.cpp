#include "drive/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drive/indices.hpp"

namespace drive {
namespace {

// Okabe and Ito's palette, which colour-blind readers can tell apart.
constexpr const char* palette[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#000000", "#8C6D1F"};

// A record of any length as at most some thousand points: more cannot be seen.
std::string data_block(std::size_t index, const Curve& curve) {
    std::string block = fmt::format("$d{} << EOD\n", index);
    const std::size_t stride = std::max<std::size_t>(1, curve.time_s.size() / 2500);
    for (std::size_t i = 0; i < curve.time_s.size(); i += stride) {
        if (std::isfinite(curve.value[i])) {
            block += fmt::format("{:.7g} {:.7g}\n", curve.time_s[i], curve.value[i]);
        }
    }
    return block + "EOD\n";
}

// Titles of curves side by side below the picture, as many as have room there.
struct Key {
    std::size_t columns;
    std::size_t rows;
};

Key key_of(const std::vector<Curve>& curves) {
    constexpr double width = 850.0;
    constexpr double letter = 7.5;
    constexpr double sample = 70.0;
    std::size_t longest = 0;
    for (const Curve& curve : curves) {
        longest = std::max(longest, curve.title.size());
    }
    const double room = width / (letter * static_cast<double>(longest) + sample);
    const std::size_t columns = std::clamp<std::size_t>(static_cast<std::size_t>(room), 1, 3);
    return {columns, (curves.size() + columns - 1) / columns};
}

// How far the roots keep from the unstable sector, or how many lie in it.
std::string roots_message(const StabilityVerdict& judged) {
    if (judged.roots.empty()) {
        return "Stable: there is no root";
    }
    const double share = judged.smallest_angle_rad / judged.limit_rad;
    switch (judged.verdict) {
        case Stability::stable:
            return fmt::format(
                "Stable: no root (of {}) comes nearer than {:.3g} times the angle of the unstable sector",
                judged.roots.size(), share);
        case Stability::borderline:
            return fmt::format("Borderline: the nearest root (of {}) lies on the edge of the unstable sector",
                               judged.roots.size());
        case Stability::unstable:
            break;
    }
    return fmt::format("Unstable: roots in the unstable sector, {} of {}, the farthest in at {:.3g} of its angle",
                       judged.unstable_by_roots, judged.roots.size(), share);
}

}  // namespace

base::Picture picture_of_curves(const std::vector<Curve>& curves, const std::string& title, const std::string& unit,
                                Axis axis) {
    std::string script;
    std::vector<std::string> plots;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        script += data_block(i, curves[i]);
        // Measured samples lie behind, in grey; the last line is the one that matters, and solid.
        const std::size_t dash = i + 1 == curves.size() ? 1 : i % 4 + 2;
        plots.push_back(fmt::format("$d{} using 1:2 with {} lc rgb \"{}\" title \"{}\" noenhanced", i,
                                    curves[i].points ? "points pt 7 ps 0.5" : fmt::format("lines lw 2 dt {}", dash),
                                    curves[i].points ? "#AAAAAA" : palette[i % std::size(palette)], curves[i].title));
    }
    const Key key = key_of(curves);
    script += fmt::format(
        "set title \"{}\" noenhanced\n"
        "set xlabel \"t [s]\" offset 0,0.6\n"
        "set ylabel \"{}\"\n"
        "set grid lc rgb \"#dddddd\"\n"
        "set key outside below horizontal maxcols {} width 2\n"
        "set bmargin {}\n"
        "set border 3\n"
        "set tics nomirror\n"
        "set xrange [*:*] noextend\n"
        "{}plot {}\n",
        title, unit, key.columns, 4 + key.rows,
        axis == Axis::logarithmic ? "set logscale y\nset format y \"10^{%L}\"\n" : "", fmt::join(plots, ", \\\n  "));
    return {script, 900, 460 + 20 * key.rows};
}

base::Picture picture_of_fit(const Record& record, const std::vector<double>& start, const std::vector<double>& fitted,
                             const Model& model) {
    const Indices before = compute_indices(record.time_s, record.output, start);
    const Indices after = compute_indices(record.time_s, record.output, fitted);
    const double unexplained = (1.0 - after.nrmse_fit) * (1.0 - after.nrmse_fit);
    const std::string message =
        fmt::format("The fit explains {:.5g} % of the variance: a residual of {:.3g} rms, the start's is {:.3g}",
                    100.0 * (1.0 - unexplained), after.rmse, before.rmse);
    return picture_of_curves({{"measured", record.time_s, record.output, true},
                              {"start", record.time_s, start},
                              {"fitted", record.time_s, fitted}},
                             message + "\\n" + short_text(model), "output");
}

std::string short_text(Model model) {
    const auto round = [](double value) { return std::stod(fmt::format("{:.4g}", value)); };
    model.gain = round(model.gain);
    model.delay_s = round(model.delay_s);
    for (auto* terms : {&model.numerator, &model.denominator}) {
        for (Term& term : *terms) {
            term = {round(term.coefficient), round(term.order)};
        }
    }
    return to_text(model);
}

base::Picture picture_of_roots(const StabilityVerdict& judged, const std::string& model) {
    std::string roots = "$roots << EOD\n";
    double largest = 0.0;
    double nearest = 1.0;
    double nearest_angle = 10.0;
    for (const auto& root : judged.roots) {
        roots += fmt::format("{:.9g} {:.9g}\n", root.real(), root.imag());
        largest = std::max(largest, std::abs(root));
        if (std::fabs(std::arg(root)) < nearest_angle) {
            nearest_angle = std::fabs(std::arg(root));
            nearest = std::abs(root);
        }
    }
    const double reach = 1.15 * std::max(largest, 1e-9);
    const double slope = std::tan(std::min(judged.limit_rad, 1.5706));
    const std::string axes =
        "set xlabel \"Re s^q\" enhanced\nset ylabel \"Im s^q\" enhanced\nset grid lc rgb \"#dddddd\"\n"
        "set zeroaxis lc rgb \"#888888\"\nset tics nomirror\nset border 3\nunset key\n";
    const auto panel = [&](double x0, double x1, double y1, const std::string& name) {
        const double right = std::min(x1, y1 / slope);
        return fmt::format(
            "set title \"{}\" noenhanced\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\nset object 1 polygon "
            "from 0,0 to "
            "{:.9g},{:.9g} to {:.9g},{:.9g} to {:.9g},{:.9g} to {:.9g},{:.9g} to 0,0 fillcolor rgb \"#D55E00\" "
            "fillstyle solid 0.25 "
            "noborder behind\nplot $roots using 1:2 with points pt 2 ps 0.9 lw 1.6 lc rgb \"#0072B2\"\n",
            name, x0, x1, -y1, y1, right, right * slope, x1, std::min(y1, x1 * slope), x1, -std::min(y1, x1 * slope),
            right, -right * slope);
    };
    const double close = std::max(nearest * 1.3, 1e-9);
    const double height = std::max(3.0 * close * std::sin(std::min(judged.limit_rad, 1.0)),
                                   1.6 * nearest * std::sin(std::min(nearest_angle, 1.5)));
    const bool whole_plane = judged.limit_rad > 0.5;  // nothing more to see at close range
    const std::string all = fmt::format("roots of P(s^q), q = {}", judged.base_order);
    std::string script = roots + "EOD\n" +
                         fmt::format("set multiplot layout 1,{} title \"{}\\n{}\" noenhanced\n", whole_plane ? 1 : 2,
                                     roots_message(judged), model) +
                         axes + panel(-reach, reach, reach, all + (whole_plane ? "; shaded: |arg| < q pi/2" : ""));
    if (!whole_plane) {
        script += panel(-0.05 * close, close, height, "near the positive axis; shaded: |arg| < q pi/2");
    }
    script += "unset multiplot\n";
    return {script, whole_plane ? 640U : 1100U, 520};
}

}  // namespace drive
