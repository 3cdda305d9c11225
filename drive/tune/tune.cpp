#include "drive/tune/tune.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "drive/refusal.hpp"

namespace tune {
namespace {

constexpr double usual_sensitivity = 2.0;  // the upper end of what is usual [Astrom2006]

// A phase margin keeps 1 + L at most 2 sin(margin / 2) from 0, at the crossover.
double least_sensitivity(double margin_rad) { return 1.0 / (2.0 * std::sin(0.5 * margin_rad)); }

Wish wish_of(const Request& request, const SampledPlant& plant) {
    if (request.margin_deg.has_value() != request.crossover.has_value()) {
        drive::refuse("--margin and --crossover: expected both or neither");
    }
    if (!request.crossover && !request.sensitivity) {
        drive::refuse("expected --margin DEGREES with --crossover RAD_S, --sensitivity S, or all three");
    }
    Wish wish{request.crossover, {}, request.sensitivity.value_or(usual_sensitivity)};
    if (!request.crossover) {
        return wish;
    }
    wish.margin_rad = *request.margin_deg * pi / 180.0;
    const double least = least_sensitivity(*wish.margin_rad);
    if (!request.sensitivity) {
        wish.sensitivity = std::max(usual_sensitivity, 1.3 * least);
    } else if (*request.sensitivity < least) {
        drive::refuse(
            fmt::format("--sensitivity {} and --margin {} contradict each other: that margin has |S| = {:.3g} at the "
                        "crossover",
                        *request.sensitivity, *request.margin_deg, least));
    }
    if (*request.crossover >= 0.5 * plant.nyquist()) {
        drive::refuse(
            fmt::format("--crossover: expected less than {:.4g} rad/s, a quarter of the sampling frequency at {} s, "
                        "found {}",
                        0.5 * plant.nyquist(), plant.step_s(), *request.crossover));
    }
    return wish;
}

// Set point, load and limits must agree: a loop that cannot rest would be judged by its limits alone.
Trial trial_of(const Request& request, const SampledPlant& plant, double scale) {
    Trial trial;
    trial.setpoint = request.setpoint;
    trial.until_s = request.until_s.value_or(20.0 / scale);
    const bool integrates = plant.integrations() > 0.0;
    const double holding = integrates ? 0.0 : trial.setpoint / drive::static_gain(plant.model());
    trial.load = request.load.value_or(integrates ? 0.5 : 0.5 * holding);
    if (!(request.low < request.high)) {
        drive::refuse(fmt::format("--low {} and --high {} contradict each other: expected low below high", request.low,
                                  request.high));
    }
    for (const auto& [input, what] : {std::pair(holding, "a set point"), std::pair(holding - trial.load, "a load")}) {
        if (input < request.low || input > request.high) {
            drive::refuse(
                fmt::format("--low {} and --high {}: {} of {:.4g} needs an input of {:.4g}; expected limits around "
                            "it, or another {}",
                            request.low, request.high, what, input == holding ? trial.setpoint : trial.load, input,
                            input == holding ? "--setpoint" : "--load"));
        }
    }
    return trial;
}

Design judge(const SampledPlant& plant, const Request& request, const Trial& trial, const Found& found) {
    Design design;
    design.controller = {found.gains, request.sample_time_s, request.low, request.high, request.setpoint_weight, {}};
    design.flat = found.flat;
    design.load_iae = found.iae;
    design.tries = found.tries;
    design.margins = margins_of({&plant, found.gains});
    for (const auto& [factor, margin] : {std::pair(0.8, &design.weak_deg), std::pair(1.25, &design.strong_deg)}) {
        drive::Gains other = found.gains;
        other.kp *= factor;
        other.ki *= factor;
        other.kd *= factor;
        *margin = margins_of({&plant, other}).phase_deg;
    }
    design.course = run(plant, design.controller, trial);
    return design;
}

// The grid that the search asks is coarser than the sweep: what is a little above is looked for a little below.
std::optional<Found> find(const Search& search, const SampledPlant& plant, const Wish& wish, Orders orders,
                          const std::optional<Found>& beside) {
    Wish lower = wish;
    for (int turn = 0; turn < 4; ++turn) {
        const std::optional<Found> found = search.best(lower, orders, beside);
        if (!found) {
            return found;
        }
        const Margins margins = margins_of({&plant, found->gains});
        if (meets(wish, margins)) {
            return found;
        }
        lower.sensitivity -= 1.1 * std::max(margins.sensitivity - wish.sensitivity, 1e-3);
    }
    return std::nullopt;
}

std::string nearest_of(const Search& search, const SampledPlant& plant, const Wish& wish) {
    const auto any = [&](const Wish& other) {
        return search.reachable(other, Orders::integer) || search.reachable(other, Orders::fractional);
    };
    if (!wish.crossover) {
        Wish other = wish;
        for (const double more : {1.05, 1.1, 1.2, 1.35, 1.5, 1.75, 2.0, 2.5, 3.0}) {
            other.sensitivity = wish.sensitivity * more;
            if (const auto found = search.best(other, Orders::fractional)) {
                return fmt::format("--sensitivity {:.3g} can be met", other.sensitivity);
            }
        }
        return "nor can three times that |S|";
    }
    std::string text;
    for (double factor = 1.03; factor < 200.0 && text.empty(); factor *= 1.03) {
        for (const double w : {*wish.crossover / factor, *wish.crossover * factor}) {
            Wish other = wish;
            other.crossover = w;
            if (w < 0.5 * plant.nyquist() && text.empty() && any(other)) {
                text = fmt::format("with that margin, --crossover {:.3g} can be met", w);
            }
        }
    }
    const std::size_t before = text.size();
    for (double degrees = 1.0; degrees < 90.0 && text.size() == before; degrees += 1.0) {
        for (const double margin : {*wish.margin_rad * 180.0 / pi - degrees, *wish.margin_rad * 180.0 / pi + degrees}) {
            Wish other = wish;
            other.margin_rad = margin * pi / 180.0;
            if (margin > 5.0 && margin < 120.0 && text.size() == before &&
                least_sensitivity(*other.margin_rad) < other.sensitivity && any(other)) {
                text += fmt::format("{}at that crossover, --margin {:.0f}{}", before == 0 ? "" : "; ", margin,
                                    before == 0 ? " can be met" : "");
            }
        }
    }
    return text.empty() ? "nothing near can be met" : text;
}

}  // namespace

double Tuned::saving() const { return 1.0 - fractional->course.load_iae / integer->course.load_iae; }

Tuned tune(const drive::Model& model, const Request& request, const std::string& name) {
    const SampledPlant plant(model, request.sample_time_s, name);
    Tuned tuned{model, request, wish_of(request, plant), {}, {}, {}, {}, {}};
    const double scale = request.crossover.value_or(plant.scale());
    tuned.trial = trial_of(request, plant, scale);
    const double filter_s = request.filter_s.value_or(std::max(0.1 / scale, request.sample_time_s));
    tuned.request.filter_s = filter_s;
    const Search search(plant, filter_s, tuned.trial.until_s);
    const std::optional<Found> integer = find(search, plant, tuned.wish, Orders::integer, {});
    const std::optional<Found> fractional = find(search, plant, tuned.wish, Orders::fractional, integer);
    if (integer) {
        tuned.integer = judge(plant, request, tuned.trial, *integer);
    }
    if (fractional) {
        tuned.fractional = judge(plant, request, tuned.trial, *fractional);
    }
    if (integer && integer->flat) {
        Wish wish = tuned.wish;
        wish.flat = false;
        if (const std::optional<Found> steep = find(search, plant, wish, Orders::integer, {})) {
            tuned.steep = judge(plant, request, tuned.trial, *steep);
        }
    }
    if (!integer && !fractional) {
        tuned.nearest = nearest_of(search, plant, tuned.wish);
    }
    return tuned;
}

}  // namespace tune
