#include "bench/choose/derivative_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/gnuplot.hpp"

namespace choose {
namespace {

namespace design = glsum::design;

// Frequency, then gain error in % and phase error in degrees, of the filter and of full memory.
std::string responses(const design::Filter& filter, const design::DerivativeGoal& goal) {
    constexpr int points = 400;
    const double low = goal.band->low_hz / 10.0;
    const double high = 0.5 / goal.step_s;
    std::string data;
    for (int i = 0; i <= points; ++i) {
        const double hz = low * std::pow(high / low, static_cast<double>(i) / points);
        const double angle = std::min(2.0 * std::numbers::pi * hz * goal.step_s, std::numbers::pi);
        const std::complex<double> exact = design::exact_response(goal.order, hz);
        const std::complex<double> ours = design::frequency_response(filter, angle) / exact;
        const std::complex<double> sum = design::full_memory_response(goal.order, goal.step_s, angle) / exact;
        constexpr double degrees = 180.0 / std::numbers::pi;
        data += fmt::format("{:.6e} {:.6e} {:.6e} {:.6e} {:.6e}\n", hz, 100.0 * (std::abs(ours) - 1.0),
                            degrees * std::arg(ours), 100.0 * (std::abs(sum) - 1.0), degrees * std::arg(sum));
    }
    return data;
}

// Time, then the error in % of the filter and of full memory.
std::string steps(const design::Filter& filter, const design::DerivativeGoal& goal) {
    std::string data;
    for (const std::size_t k : design::samples_of(goal)) {
        const double time_s = static_cast<double>(k) * goal.step_s;
        const double exact = design::exact_step(goal.order, time_s);
        const double sum = design::full_memory_step(goal.order, goal.step_s, k) / exact;
        data += fmt::format("{:.6e} {:.6e} {:.6e}\n", time_s, 100.0 * (design::step_response(filter, k) / exact - 1.0),
                            100.0 * (sum - 1.0));
    }
    return data;
}

std::string panel(const char* title, const char* xlabel, const char* ylabel, double range, const char* data, int ours,
                  int sum) {
    return fmt::format(
        "set title \"{}\" offset 0,-0.6\nset xlabel \"{}\" offset 0,0.4\nset ylabel \"{}\" offset 1,0\n"
        "set yrange [{}:{}]\nplot {} using 1:{} with lines lw 1.5 dt 2 lc rgb \"{}\" title \"full memory\", \\\n"
        "  {} using 1:{} with lines lw 2 lc rgb \"{}\" title \"chosen\"\n",
        title, xlabel, ylabel, -range, range, data, sum, base::palette[7], data, ours, base::palette[0]);
}

}  // namespace

void plot_derivative(const DerivativeReport& report, const design::DerivativeGoal& goal, double limit,
                     const std::filesystem::path& stem) {
    const design::Filter filter = report.filter.filter();
    const int panels = (goal.band ? 2 : 0) + (goal.step_until_s ? 1 : 0);
    const double percent = 100.0 * limit;
    std::string script = fmt::format(
        "set multiplot layout 1,{} title \"Derivative of order {:g}, h = {:g} s: error\"\nset logscale x\nset format x "
        "\"10^{{%L}}\"\nset grid lc rgb \"#dddddd\"\nset key bottom left\nset xtics nomirror\nset ytics nomirror\n",
        panels, goal.order, goal.step_s);
    if (goal.band) {
        script += fmt::format("$r << EOD\n{}EOD\n", responses(filter, goal));
        script += fmt::format("set xrange [{}:{}]\n", goal.band->low_hz / 10.0, 0.5 / goal.step_s);
        // Where it is promised, and within what.
        const auto shade = [&](double half) {
            return fmt::format(
                "set object 1 rectangle from {},{} to {},{} behind fillcolor rgb \"#e8f1f8\" fillstyle solid "
                "noborder\n",
                goal.band->low_hz, -half, goal.band->high_hz, half);
        };
        script += shade(percent) + panel("gain", "Hz", "%", 4.0 * percent, "$r", 2, 4);
        const double degrees = limit * 180.0 / std::numbers::pi;
        script += shade(degrees) + panel("phase", "Hz", "degrees", 4.0 * degrees, "$r", 3, 5);
        script += "unset object 1\n";
    }
    if (goal.step_until_s) {
        script += fmt::format("$s << EOD\n{}EOD\nset xrange [{}:{}]\n", steps(filter, goal),
                              static_cast<double>(design::first_of_step) * goal.step_s, *goal.step_until_s);
        script += fmt::format(
            "set object 1 rectangle from {},{} to {},{} behind fillcolor rgb \"#e8f1f8\" fillstyle solid noborder\n",
            static_cast<double>(design::first_of_step) * goal.step_s, -percent, *goal.step_until_s, percent);
        script += panel("response to a step", "s", "%", 4.0 * percent, "$s", 2, 3);
    }
    base::draw({script + "unset multiplot\n", static_cast<std::size_t>(420 * panels), 380}, stem);
}

}  // namespace choose
