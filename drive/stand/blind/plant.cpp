#include "drive/stand/blind/plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/failure.hpp"

namespace stand::blind {
namespace {

// sum_i a_i h^-alpha_i (1 - z)^alpha_i (1 + alpha_i/2 (1 - z)), order 0 left out; ends where whole orders end.
std::vector<double> weights_of(const std::vector<PlantTerm>& terms, double step_s, std::size_t count) {
    std::vector<double> merged(count, 0.0);
    std::size_t used = 1;
    for (const PlantTerm& term : terms) {
        if (term.order == 0.0) {
            continue;
        }
        const double factor = term.coefficient * std::pow(step_s, -term.order);
        const double half = 0.5 * term.order;
        double weight = 1.0;
        double before = 0.0;
        for (std::size_t j = 0; j < count; ++j) {
            const double value = (1.0 + half) * weight - half * before;
            merged[j] += factor * value;
            used = value != 0.0 ? std::max(used, j + 1) : used;
            before = weight;
            weight *= 1.0 - (1.0 + term.order) / static_cast<double>(j + 1);
        }
    }
    merged.resize(used);
    return merged;
}

// sum_{j=1} W_j y_(k-j), in four chains.
double past_sum(const std::vector<double>& weights, const std::vector<double>& y, std::size_t k) {
    const std::size_t last = std::min(k, weights.size() - 1);
    double sums[4] = {};
    std::size_t j = 1;
    for (; j + 3 <= last; j += 4) {
        sums[0] += weights[j] * y[k - j];
        sums[1] += weights[j + 1] * y[k - j - 1];
        sums[2] += weights[j + 2] * y[k - j - 2];
        sums[3] += weights[j + 3] * y[k - j - 3];
    }
    for (; j <= last; ++j) {
        sums[0] += weights[j] * y[k - j];
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

struct Level {
    double from_s;
    double value;
};

// What the actuator is asked for: delay and everything without a memory of time.
std::vector<Level> levels_of(const Plant& plant, const Stand& effects, const Unlisted& unlisted, const Held& held) {
    std::vector<Level> levels{{0.0, 0.0}};
    double played = 0.0;
    double before = 0.0;
    for (std::size_t i = 0; i < held.time_s.size(); ++i) {
        double u = held.input[i];
        if (i > 0 && u == held.input[i - 1]) {
            continue;
        }
        const bool falls = u < before;
        before = u;
        const double delay_s = plant.delay_s + effects.extra_delay_s +
                               unlisted.delay_at_rest_s * std::clamp(1.0 - u / plant.full_input, 0.0, 1.0);
        u = unlisted.input_step > 0.0 ? unlisted.input_step * std::round(u / unlisted.input_step) : u;
        if (unlisted.hysteresis > 0.0) {
            played = std::clamp(played, u - 0.5 * unlisted.hysteresis, u + 0.5 * unlisted.hysteresis);
            u = played;
        }
        u = falls ? u * (1.0 - unlisted.falling_gain) : u;
        u = u < effects.threshold ? 0.0 : u;
        u = std::max(0.0, u - effects.dead_zone);
        u = std::min(u, effects.input_limit);
        u *= (1.0 - effects.thrust_curvature) + effects.thrust_curvature * u / effects.thrust_reference;
        // No command overtakes another.
        levels.push_back({std::max(held.time_s[i] + delay_s, levels.back().from_s), effects.gain * u});
    }
    return levels;
}

// Slope, lag, charge and drift: the mean of the effective input over the step around each node.
std::vector<double> effective_input(const Stand& effects, const std::vector<Level>& levels, double step_s,
                                    std::size_t nodes) {
    std::vector<double> mean(nodes, 0.0);
    std::size_t next = 0;
    double now_s = 0.0;
    double target = 0.0;
    double level = 0.0;
    double lagged = 0.0;
    double charge = 0.0;
    for (std::size_t k = 0; k < nodes; ++k) {
        const double end_s = (static_cast<double>(k) + 0.5) * step_s;
        while (now_s < end_s) {
            while (next < levels.size() && levels[next].from_s <= now_s) {
                target = levels[next++].value;
            }
            const double until_s = next < levels.size() ? std::min(end_s, levels[next].from_s) : end_s;
            const double span_s = until_s - now_s;
            const double reach = effects.rate_per_s * span_s;
            const double to = std::clamp(target, level - reach, level + reach);
            // A ramp, and what is left of the span at its end.
            const double ramp_s = std::min(span_s, std::fabs(to - level) / effects.rate_per_s);
            const double asked = to - 0.5 * (to - level) * ramp_s / span_s;
            level = to;
            double area = asked * span_s;
            if (effects.motor_tau_s > 0.0) {
                const double left = std::exp(-span_s / effects.motor_tau_s);
                area += (lagged - asked) * effects.motor_tau_s * (1.0 - left);
                lagged = asked + (lagged - asked) * left;
            }
            const double w = area / span_s;
            charge += area;
            const double factor = (1.0 + effects.drift_per_s * (now_s + 0.5 * span_s)) *
                                  (1.0 - effects.sag_per_unit_s * charge) * (1.0 - effects.battery_resistance * w);
            mean[k] += area * factor / step_s;
            now_s = until_s;
        }
    }
    return mean;
}

class Friction {
public:
    Friction(const Stand& effects, double full_output)
        : up_(effects.friction + effects.friction_up),
          down_(effects.friction + effects.friction_down),
          bend_(0.004 * std::fabs(full_output)) {}
    /// After the output has moved by `by`.
    double move(double by) {
        const double limit = by > 0.0 ? up_ : -down_;
        if (by != 0.0) {
            force_ = limit + (force_ - limit) * std::exp(-std::fabs(by) / bend_);
        }
        return force_;
    }
    [[nodiscard]] bool any() const { return up_ > 0.0 || down_ > 0.0; }

private:
    double up_;
    double down_;
    double bend_;
    double force_ = 0.0;
};

// The plant's output at the nodes.
std::vector<double> move(const Plant& plant, const Stand& effects, const Unlisted& unlisted,
                         const std::vector<double>& input, double step_s) {
    std::vector<PlantTerm> terms = plant.terms;
    for (PlantTerm& term : terms) {
        term.coefficient *= std::pow(effects.time_scale, term.order);
    }
    const double spring = terms.back().order == 0.0 ? terms.back().coefficient : 0.0;
    const std::vector<double> weights = weights_of(terms, step_s, input.size());
    const double kappa = effects.sine_per_unit;
    Friction friction(effects, plant.full_output);
    std::vector<double> y(input.size(), 0.0);
    const auto y_before = [&](std::size_t k, std::size_t by) { return k >= by ? y[k - by] : 0.0; };
    bool on_stop = false;
    for (std::size_t k = 0; k < y.size(); ++k) {
        const double t = static_cast<double>(k) * step_s;
        const double y1 = y_before(k, 1);
        const double y2 = y_before(k, 2);
        const double y3 = y_before(k, 3);
        const double next = 2.0 * y1 - y2;
        const double speed = (2.5 * y1 - 4.0 * y2 + 1.5 * y3) / step_s;
        double drive = plant.gain * input[k] * (1.0 + unlisted.near_gain * std::exp(-3.0 * next / plant.full_output));
        if (effects.disturbance_size != 0.0 && t >= effects.disturbance_from_s && t < effects.disturbance_to_s) {
            drive -= effects.disturbance_size;
        }
        drive -= effects.drag * speed * std::fabs(speed);
        drive -= friction.any() ? friction.move(y1 - y2) : 0.0;
        drive -= unlisted.cogging_force * std::sin(unlisted.cogging_per_unit * next);
        drive -= unlisted.hum_force * std::sin(2.0 * std::numbers::pi * unlisted.hum_hz * t);
        drive -= unlisted.stiffening * next * next * next;
        drive -= unlisted.damping_growth * t * speed;
        drive += kappa > 0.0 ? spring * (next - std::sin(kappa * next) / kappa) : 0.0;
        y[k] = (drive - past_sum(weights, y, k)) / (weights[0] + spring);
        // A stop holds as long as the plant leans on it at rest.
        const double limit = effects.upper_stop_rad;
        on_stop = y[k] > limit || (on_stop && drive > spring * limit);
        y[k] = on_stop ? limit : y[k];
        if (!(std::fabs(y[k]) < 1e6 * std::fabs(plant.full_output))) {
            throw glsum::Failure(glsum::Exit::check_failed, fmt::format("blind: a plant runs away by {} s", t));
        }
    }
    return y;
}

// A lightly damped mode on the mean input of each step, exactly; its deflection at the nodes.
std::vector<double> swing(const Plant& plant, const Stand& effects, const std::vector<double>& input, double step_s) {
    const double w = 2.0 * std::numbers::pi * effects.resonance_hz;
    const double decay = effects.resonance_damping * w;
    const double turn = w * std::sqrt(1.0 - effects.resonance_damping * effects.resonance_damping);
    const double left = std::exp(-decay * step_s);
    const double c = std::cos(turn * step_s);
    const double s = std::sin(turn * step_s);
    const double share = effects.resonance_share * plant.gain / plant.terms.back().coefficient;
    std::vector<double> at_nodes(input.size());
    double place = 0.0;
    double speed = 0.0;
    for (std::size_t k = 0; k < input.size(); ++k) {
        const double rest = share * input[k];
        const double from = place - rest;
        const double next = left * (from * c + (speed + decay * from) / turn * s);
        speed = left * (speed * c - (speed * decay + w * w * from) / turn * s);
        at_nodes[k] = 0.5 * (place + next + rest);
        place = next + rest;
    }
    return at_nodes;
}

// A first-order lag of what is given at the nodes; two time constants for rising and falling.
void lag(std::vector<double>& z, double up_s, double down_s, double step_s) {
    double state = 0.0;
    double before = 0.0;
    for (double& value : z) {
        const double mean = 0.5 * (before + value);
        before = value;
        const double tau_s = mean > state ? up_s : down_s;
        state = mean + (state - mean) * std::exp(-step_s / tau_s);
        value = state;
    }
}

}  // namespace

Stand no_effects() {
    Stand stand;
    for (const std::string& effect : effects()) {
        remove_effect(stand, effect);
    }
    return stand;
}

double static_output(const Plant& plant, double input) { return plant.gain * input / plant.terms.back().coefficient; }

std::vector<double> respond(const Plant& plant, const Stand& effects, const Unlisted& unlisted, const Held& held,
                            std::span<const double> at_s, double step_s) {
    const double end_s = std::max(*std::max_element(at_s.begin(), at_s.end()), held.time_s.back());
    const auto nodes = static_cast<std::size_t>(std::ceil(end_s / step_s)) + 2;
    const std::vector<double> input =
        effective_input(effects, levels_of(plant, effects, unlisted, held), step_s, nodes);
    std::vector<double> z = move(plant, effects, unlisted, input, step_s);
    if (effects.backlash_rad > 0.0) {
        double carried = 0.0;
        for (double& value : z) {
            carried = std::clamp(carried, value - 0.5 * effects.backlash_rad, value + 0.5 * effects.backlash_rad);
            value = carried;
        }
    }
    if (unlisted.slip_per_unit > 0.0) {
        double lost = 0.0;
        double before = 0.0;
        for (std::size_t k = 0; k < z.size(); ++k) {
            const double by = z[k] - before;
            before = z[k];
            const double hard = std::fabs(plant.gain * input[k] - plant.terms.back().coefficient * z[k]);
            lost += unlisted.slip_per_unit * hard / std::fabs(plant.gain * plant.full_input) * by;
            z[k] -= lost;
        }
    }
    if (effects.tau_up_s > 0.0) {
        lag(z, effects.tau_up_s, effects.tau_down_s, step_s);
    }
    if (effects.output_curvature != 0.0) {
        const double c = effects.output_curvature;
        for (double& value : z) {
            value *= (1.0 - c) + c * value / effects.output_reference;
        }
    }
    if (effects.resonance_share != 0.0) {
        const std::vector<double> swings = swing(plant, effects, input, step_s);
        for (std::size_t k = 0; k < z.size(); ++k) {
            z[k] += swings[k];
        }
    }
    if (effects.sensor_tau_s > 0.0) {
        lag(z, effects.sensor_tau_s, effects.sensor_tau_s, step_s);
    }
    std::vector<double> readings;
    for (const double t : at_s) {
        const double place = std::max(t, 0.0) / step_s;
        const auto k = static_cast<std::size_t>(place);
        const double part = place - static_cast<double>(k);
        readings.push_back((1.0 - part) * z[k] + part * z[k + 1]);
    }
    return readings;
}

}  // namespace stand::blind
