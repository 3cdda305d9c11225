#include "cli/derivative_goal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "base/failure.hpp"
#include "cli/band.hpp"
#include "cli/name_value.hpp"
#include "glsum/design/rational.hpp"

namespace cli {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); }

}  // namespace

void add_goal(Command& command, Budget& budget) {
    command.add_option("--derivative-error", budget.derivative_error,
                       "Largest relative error of the derivative (or integral) itself, as in 5%, and not of the sum: "
                       "over a --band, along a step (--step-until), or both");
    command.add_option("--band", budget.band,
                       "Hertz, as in 0.05..80: there |H - (jw)^v| / w^v is held within --derivative-error");
    command
        .add_option("--step-until", budget.step_until_s,
                    "Seconds: until then, from ten samples on, the response to a unit step is held within it of "
                    "t^-v / Gamma(1 - v)")
        .above(0);
    command.add_option("--design", budget.design,
                       "With --band: fitted (default), or oustaloup or charef, whose filters are tuned to the band");
}

std::optional<glsum::design::DerivativeGoal> derivative_goal(const Budget& budget) {
    if (budget.derivative_error.empty()) {
        if (!budget.band.empty() || budget.step_until_s != 0.0 || !budget.design.empty() || !budget.plot.empty()) {
            refuse("--band, --step-until, --design and --plot: only with --derivative-error");
        }
        return std::nullopt;
    }
    if (budget.max_error != 0.0 || !budget.signals.empty()) {
        refuse(
            "--derivative-error: it takes the place of --max-error and --signal, which speak of the sum; expected one");
    }
    if (budget.band.empty() && budget.step_until_s == 0.0) {
        refuse("--derivative-error: expected --band, --step-until or both beside it");
    }
    glsum::design::DerivativeGoal goal{budget.order, budget.step_s};
    if (!budget.band.empty()) {
        goal.band = to_band("--band", budget.band, budget.step_s);
    }
    if (budget.step_until_s != 0.0) {
        if (!glsum::design::has_step(budget.order)) {
            refuse(fmt::format("--step-until: the derivative of order {:g} of a step is 0: no relative error",
                               budget.order));
        }
        const double samples = budget.step_until_s / budget.step_s;
        if (!(samples >= static_cast<double>(glsum::design::first_of_step) && samples <= most_samples)) {
            refuse(fmt::format("--step-until: expected {} to {:g} samples, found {:g}", glsum::design::first_of_step,
                               most_samples, samples));
        }
        goal.step_until_s = budget.step_until_s;
    }
    return goal;
}

choose::FilterDesign filter_design(const Budget& budget) {
    if (budget.design.empty() || budget.design == "fitted") {
        return choose::FilterDesign::fitted;
    }
    if (budget.design != "oustaloup" && budget.design != "charef") {
        refuse(fmt::format("--design: expected fitted, oustaloup or charef, found {}", budget.design));
    }
    if (budget.band.empty()) {
        refuse(fmt::format("--design {}: it is tuned to a --band, and there is none", budget.design));
    }
    if (!glsum::design::has_rational(budget.order)) {
        refuse(fmt::format("--design {}: expected an order in (-1, 2) that is no whole number, found {:g}",
                           budget.design, budget.order));
    }
    return budget.design == "oustaloup" ? choose::FilterDesign::oustaloup : choose::FilterDesign::charef;
}

double derivative_error(const Budget& budget) {
    const std::string& text = budget.derivative_error;
    const bool percent = text.ends_with('%');
    const auto value = to_number<double>(percent ? text.substr(0, text.size() - 1) : text);
    if (!value || !(*value > 0.0) || !std::isfinite(*value)) {
        refuse(fmt::format("--derivative-error: expected a share above 0, as in 5%, found {}", text));
    }
    return percent ? *value / 100.0 : *value;
}

}  // namespace cli
