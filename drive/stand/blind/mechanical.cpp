#include "drive/stand/blind/mechanical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "drive/stand/blind/series.hpp"
#include "drive/stand/motion.hpp"

namespace stand::blind {
namespace {

enum MechanicalStream : std::uint64_t { jitter_stream = 5, drop_stream };

std::string fotf_json(const Plant& plant, double interval_s) {
    nlohmann::ordered_json json{{"kind", "fotf"}, {"gain", plant.gain}};
    json["denominator"] = nlohmann::ordered_json::array();
    for (const PlantTerm& term : plant.terms) {
        json["denominator"].push_back({{"coefficient", term.coefficient}, {"order", term.order}});
    }
    json["delay_s"] = plant.delay_s;
    json["sample_time_s"] = interval_s;
    return json.dump(2) + "\n";
}

// The reading before the sensor's own faults.
std::vector<double> move_and_read(const Mechanical& base, const Setup& setup, const Held& held,
                                  const std::vector<double>& at_s) {
    if (!setup.physical) {
        return respond(setup.plant, setup.stand, setup.unlisted, held, at_s, base.step_s);
    }
    std::vector<Command> commands;
    for (std::size_t k = 0; k < held.time_s.size(); ++k) {
        if (commands.empty() || commands.back().duty != held.input[k]) {
            commands.push_back({held.time_s[k], held.input[k]});
        }
    }
    std::vector<double> sorted = at_s;
    std::sort(sorted.begin(), sorted.end());
    const Motion motion = stand::move(setup.stand, drive_motor(setup.stand, commands), {}, sorted);
    std::vector<double> readings;
    for (const double t : at_s) {
        const auto at = std::lower_bound(sorted.begin(), sorted.end(), t) - sorted.begin();
        readings.push_back(motion.points[static_cast<std::size_t>(at)].reading_rad);
    }
    return readings;
}

}  // namespace

Mechanical draw_mechanical(bool physical, bool fractional, Chance& chance) {
    Mechanical base;
    base.setup.stand = no_effects();
    base.setup.physical = physical;
    // Mostly 40 s at 100 Hz; some plants slower or faster, with about as many samples.
    const double pace = physical || chance.happens(0.75) ? 1.0 : digits(chance.scaled(0.5, 6.0));
    base.clock.interval_s = 0.01 * pace;
    const double samples = chance.happens(0.7) ? 4000.0 : 250.0 * std::round(chance.between(8.0, 22.0));
    base.clock.until_s = samples * base.clock.interval_s;
    base.clock.spread_s = chance.happens(0.5) ? 0.1 * base.clock.interval_s : 0.0;
    if (physical) {
        Stand& stand = base.setup.stand;
        stand.inertia_kg_m2 = digits(chance.scaled(0.02, 0.08));
        stand.full_thrust_n = digits(chance.between(5.0, 9.0));
        stand.gravity_n_m = digits(chance.scaled(0.4, 1.2));
        const double own = std::sqrt(stand.gravity_n_m / stand.inertia_kg_m2);
        stand.damping_n_m_s = digits(2.0 * chance.between(0.35, 1.2) * own * stand.inertia_kg_m2);
        stand.delay_s = digits(chance.between(0.0, 0.15));
        stand.interval_s = base.clock.interval_s;
        stand.spread_s = base.clock.spread_s;
        base.kind = "stand";
        base.model = linear_model_json(stand);
        base.tau_s = std::max(1.0 / own, stand.damping_n_m_s / stand.gravity_n_m);
        base.setup.plant.gain = 1.0;
        base.setup.plant.terms = {{stand.gravity_n_m / stand.full_torque_n_m(), 0.0}};
        // So that the bar stays below about a radian.
        base.setup.plant.full_input =
            digits(std::min(0.95, chance.between(0.4, 0.95) * stand.gravity_n_m / stand.full_torque_n_m()));
    } else {
        Plant& plant = base.setup.plant;
        base.tau_s = digits(pace * chance.scaled(0.15, 0.9));
        const double gain = digits(chance.scaled(0.2, 20.0));
        plant.full_input = chance.happens(0.5) ? digits(chance.between(0.3, 1.0)) : digits(chance.between(1.0, 12.0));
        plant.delay_s = chance.happens(0.3) ? 0.0 : digits(base.tau_s * chance.between(0.05, 1.0));
        const double t = base.tau_s;
        const std::size_t shape = chance.below(3);
        if (fractional) {
            plant.gain = 1.0;
            const double high = shape == 0 ? chance.between(0.55, 0.95) : chance.between(1.5, 1.95);
            plant.terms = {{digits(std::pow(t, high) / gain), digits(high)}};
            if (shape != 0) {
                const double low = high * chance.between(0.45, 0.55);
                plant.terms.push_back({digits(chance.between(1.2, 2.2) * std::pow(t, low) / gain), digits(low)});
            }
            plant.terms.push_back({digits(1.0 / gain), 0.0});
        } else {
            plant.gain = gain;
            const double damping = chance.between(0.4, 1.3);
            plant.terms = shape == 0   ? std::vector<PlantTerm>{{t, 1.0}, {1.0, 0.0}}
                          : shape == 1 ? std::vector<PlantTerm>{{0.25 * t * t, 2.0}, {t, 1.0}, {1.0, 0.0}}
                                       : std::vector<PlantTerm>{
                                             {digits(t * t), 2.0}, {digits(2.0 * damping * t), 1.0}, {1.0, 0.0}};
        }
        base.kind = fractional ? "fractional" : "whole";
        base.model = fotf_json(plant, base.clock.interval_s);
        // The plant's weights of whole orders end by themselves; fractional ones cost the square of their number.
        base.step_s = base.clock.interval_s / (fractional ? 5.0 : 10.0);
    }
    base.setup.plant.full_output = static_output(base.setup.plant, base.setup.plant.full_input);
    return base;
}

Moved move_record(const Mechanical& base, const Setup& setup, const Held& held, std::uint64_t seed) {
    Chance jitter(seed, jitter_stream);
    Moved moved{held.time_s, {}};
    if (setup.stand.jitter_s > 0.0) {
        for (double& t : moved.at_s) {
            t = std::max(0.0, t + jitter.around(setup.stand.jitter_s));
        }
    }
    moved.z = move_and_read(base, setup, held, moved.at_s);
    return moved;
}

std::vector<double> acquire(const Setup& setup, const Moved& moved, const std::vector<double>& noise,
                            std::uint64_t seed) {
    Chance drops(seed, drop_stream);
    const std::vector<double>& at_s = moved.at_s;
    std::vector<double> z = moved.z;
    // Stretches of 5 to 25 samples; as many of them as make up the share.
    const double begins = setup.stand.dropped_rate / (15.0 * (1.0 - setup.stand.dropped_rate));
    std::size_t held_for = 0;
    for (std::size_t k = 0; k < z.size(); ++k) {
        z[k] += setup.stand.offset_rad + setup.stand.drift_rad_per_s * at_s[k] + (noise.empty() ? 0.0 : noise[k]);
        z[k] = std::clamp(z[k], -setup.stand.sensor_limit_rad, setup.stand.sensor_limit_rad);
        const double step = setup.stand.encoder_step_rad;
        z[k] = step > 0.0 ? step * std::round(z[k] / step) : z[k];
        z[k] += setup.missed_size != 0.0 && at_s[k] >= setup.missed_at_s ? setup.missed_size : 0.0;
        if (held_for == 0 && drops.share() < begins) {
            held_for = 5 + drops.below(21);
        }
        if (held_for > 0) {
            --held_for;
            z[k] = k > 0 ? z[k - 1] : z[k];
        }
    }
    return z;
}

}  // namespace stand::blind
