// The output cannot pass a limit, with or without bounce. In its other variant the level before it, behind a lag of its
// own, cannot pass it either, as of two tanks one above the other: of what runs over a share reaches the lower one.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& end_stop();

namespace {

// A limit that nothing reaches.
double none_of(const Scales& scales) { return scales.output_high + 0.02 * scales.output_span; }

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double low = scales.output_low + 0.3 * scales.output_span;
    const double none = none_of(scales);
    const double near = scales.output_high - 0.02 * scales.output_span;
    const double below = scales.output_high - 0.15 * scales.output_span;
    // What integrates, swings or moves is no tank.
    if (!scales.steady || scales.swings || !scales.drains) {
        return {{"limit", "y", low, none, none, {near, below}},
                {"restitution", "1", 0.0, 0.9, 0.0, {0.0}},
                {"before_s", "s", 0.0, 0.0, 0.0, {0.0}, true},
                {"spill", "1", 0.0, 0.0, 0.0, {0.0}, true}};
    }
    const double lag_s = scales.time_constant_s;
    // The upper tank's starts come first: behind them its numbers stay at none. Nothing bounces off a brim.
    return {{"limit", "y", low, none, none, {near, below, near, below}},
            {"restitution", "1", 0.0, 0.9, 0.0, {0.0}, true},
            {"before_s", "s", 0.0, 3.0 * lag_s, 0.0, {0.5 * lag_s, 0.5 * lag_s, 0.0, 0.0}, false, 2},
            {"spill", "1", 0.0, 1.0, 0.0, {0.5, 0.5, 0.0, 0.0}, false, 2}};
}

double constant_of(const std::vector<drive::Term>& terms) {
    double constant = 0.0;
    for (const drive::Term& term : terms) {
        constant += term.order == 0.0 ? term.coefficient : 0.0;
    }
    return constant;
}

// In units of the output, about the operating point.
struct Upper {
    double level;
    double limit;
    double lag_s;
    double spill;
};

// What reaches the lower one, as a mean over a step, while the inflow would hold the level at `rest`. At the limit what
// is beyond it runs over.
double outflow_of(Upper& upper, double rest, double step_s) {
    const double kept = std::exp(-step_s / upper.lag_s);
    const double next = rest + (upper.level - rest) * kept;
    if (next <= upper.limit) {
        const double mean = rest + (upper.level - rest) * (1.0 - kept) * upper.lag_s / step_s;
        upper.level = next;
        return mean;
    }
    const double full_s = upper.lag_s * std::log((rest - upper.level) / (rest - upper.limit));
    const double until_full = rest * full_s + (upper.level - upper.limit) * upper.lag_s;
    upper.level = upper.limit;
    return (until_full + (step_s - full_s) * (upper.limit + upper.spill * (rest - upper.limit))) / step_s;
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.forces.stop = EndStop{values[0], values[1]};
    const double gain =
        scenario.model.gain * constant_of(scenario.model.numerator) / constant_of(scenario.model.denominator);
    if (!(values[2] > 0.0) || !std::isnormal(gain)) {
        return;
    }
    const double limit = values[0] - scenario.operating_output;
    const Upper begun{std::min(scenario.initial_output, limit), limit, values[2], values[3]};
    scenario.input.emplace_back([gain, begun](std::span<double> held, const Grid& grid) {
        Upper upper = begun;
        for (double& u : held) {
            u = outflow_of(upper, gain * u, grid.step_s) / gain;
        }
    });
}

// Of an upper tank that never runs over its lag is left.
std::string linear_with(std::span<const Fitted> fitted, const Scales& scales) {
    const bool upper = fitted[2].value > 0.0;
    return upper && fitted[0].high >= none_of(scales) ? "its level may never reach the limit, so that a lag is left"
                                                      : "";
}

}  // namespace

const Effect& end_stop() {
    static const Effect effect{
        .name = "end_stop",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::plant,
        .numbers = {{"limit"},
                    {"restitution", Number::Given::otherwise, 0.0},
                    {"before_s", Number::Given::otherwise, 0.0},
                    {"spill", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical, Domain::hydraulic},
        .hides_base = true,
        .linear_with = linear_with,
    };
    return effect;
}

}  // namespace gap
