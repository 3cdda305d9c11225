#include "bench/choose/derivative_text.hpp"

#include <fmt/format.h>

#include "base/rounded_up.hpp"

namespace choose {
namespace {

namespace design = glsum::design;

template <class Percent>
std::string line_of(const design::DerivativeError& error, const design::DerivativeGoal& goal, const Percent& percent) {
    std::string text;
    if (goal.band) {
        text = fmt::format("{} % from {:g} to {:g} Hz (worst at {:.3g} Hz)", percent(error.band), goal.band->low_hz,
                           goal.band->high_hz, error.band_hz);
    }
    if (goal.step_until_s) {
        text += fmt::format("{}{} % of a step's response until {:g} s (worst at {:.3g} s)", goal.band ? ", " : "",
                            percent(error.step), *goal.step_until_s, error.step_s);
    }
    return text;
}

}  // namespace

std::string extent(const design::DerivativeGoal& goal) {
    std::string text;
    if (goal.band) {
        text = fmt::format(", from {:g} to {:g} Hz", goal.band->low_hz, goal.band->high_hz);
    }
    if (goal.step_until_s) {
        text += fmt::format(", a step from {:g} s until {:g} s",
                            static_cast<double>(design::first_of_step) * goal.step_s, *goal.step_until_s);
    }
    return text;
}

std::string use_of(const DerivativeReport& report, const design::DerivativeGoal& goal) {
    return fmt::format(
        "{:<10} within {}\n{:<10} {}\n", "certified",
        line_of(report.certified, goal, [](double error) { return base::rounded_up(100.0 * error); }), "measured",
        line_of(report.measured, goal, [](double error) { return fmt::format("{:.3g}", 100.0 * error); }));
}

bench::Json to_json(const design::DerivativeError& error, const design::DerivativeGoal& goal) {
    bench::Json json;
    if (goal.band) {
        json["band_error"] = error.band;
        json["worst_hz"] = error.band_hz;
    }
    if (goal.step_until_s) {
        json["step_error"] = error.step;
        json["worst_s"] = error.step_s;
    }
    return json;
}

}  // namespace choose
