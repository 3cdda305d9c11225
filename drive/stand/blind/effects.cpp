#include "drive/stand/blind/effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/failure.hpp"

namespace stand::blind {
namespace {

bool is_one_of(const std::string& effect, std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), effect) != names.end();
}

// Where a number of an unlisted effect goes.
double* find_unlisted(const std::string& name, Unlisted& unlisted) {
    const std::map<std::string, double*> all{{"cogging_force", &unlisted.cogging_force},
                                             {"cogging_per_unit", &unlisted.cogging_per_unit},
                                             {"hum_force", &unlisted.hum_force},
                                             {"hum_hz", &unlisted.hum_hz},
                                             {"near_gain", &unlisted.near_gain},
                                             {"stiffening", &unlisted.stiffening},
                                             {"delay_at_rest_s", &unlisted.delay_at_rest_s},
                                             {"hysteresis", &unlisted.hysteresis},
                                             {"damping_growth", &unlisted.damping_growth},
                                             {"input_step", &unlisted.input_step},
                                             {"falling_gain", &unlisted.falling_gain},
                                             {"slip_per_unit", &unlisted.slip_per_unit}};
    const auto found = all.find(name);
    return found == all.end() ? nullptr : found->second;
}

}  // namespace

const char* name_of(EffectSize size) {
    return size == EffectSize::small ? "small" : size == EffectSize::clear ? "clear" : "large";
}

const std::vector<std::string>& listed_effects() {
    static const std::vector<std::string> names{"gain_error",
                                                "time_scale_error",
                                                "dead_time_error",
                                                "order_error",
                                                "input_saturation",
                                                "input_dead_zone",
                                                "start_up_threshold",
                                                "input_curve",
                                                "rate_limit",
                                                "actuator_lag",
                                                "supply_sag",
                                                "gain_drift",
                                                "coulomb_friction",
                                                "direction_dependent_friction",
                                                "quadratic_drag",
                                                "gravity_nonlinearity",
                                                "end_stop",
                                                "backlash",
                                                "structural_resonance",
                                                "direction_asymmetry",
                                                "output_curve",
                                                "load_disturbance",
                                                "sensor_offset",
                                                "sensor_drift",
                                                "sensor_lag",
                                                "sensor_saturation",
                                                "encoder_quantisation",
                                                "missed_counts",
                                                "sampling_jitter",
                                                "dropped_samples"};
    return names;
}

const std::vector<std::string>& unlisted_effects() {
    static const std::vector<std::string> names{
        "cogging",        "hum",        "ground_effect", "stiffening",    "level_dependent_delay", "input_hysteresis",
        "damping_growth", "input_step", "falling_gain",  "slipping_belt", "start_up_time"};
    return names;
}

bool needs_linear_plant(const std::string& effect) {
    const auto& all = unlisted_effects();
    return effect == "order_error" ||
           (effect != "start_up_time" && std::find(all.begin(), all.end(), effect) != all.end());
}

bool is_lag(const std::string& effect) { return is_one_of(effect, {"actuator_lag", "sensor_lag"}); }

bool bends_the_input(const std::string& effect) {
    return is_one_of(effect,
                     {"input_saturation", "input_dead_zone", "start_up_threshold", "input_curve", "supply_sag"});
}

Parameters draw_parameters(const std::string& effect, EffectSize size, const Scale& scale, bool one_level,
                           Chance& chance) {
    const double vary = chance.between(0.85, 1.15);
    const auto pick = [&](double small, double clear, double large) {
        return vary * (size == EffectSize::small ? small : size == EffectSize::clear ? clear : large);
    };
    const double sign = chance.happens(0.5) ? 1.0 : -1.0;
    const double u = scale.full_input;
    const double y = scale.full_output;
    const double force = scale.force;
    const double tau_s = scale.tau_s;
    if (effect == "gain_error") {
        return {{"gain", 1.0 + sign * pick(0.03, 0.08, 0.2)}};
    }
    if (effect == "time_scale_error") {
        return {{"scale", std::exp(sign * pick(0.06, 0.15, 0.35))}};
    }
    if (effect == "dead_time_error") {
        return {{"extra_s", tau_s * pick(0.05, 0.15, 0.4)}};
    }
    if (effect == "order_error") {
        return {{"shift", -pick(0.02, 0.05, 0.1)}};
    }
    if (effect == "input_saturation") {
        return {{"limit", u * (1.0 - pick(0.1, 0.25, 0.4))}};
    }
    if (effect == "input_dead_zone") {
        return {{"width", u * pick(0.04, 0.1, 0.2)}};
    }
    if (effect == "start_up_threshold") {
        return {{"threshold", u * pick(0.2, 0.35, 0.5)}};
    }
    if (effect == "input_curve") {
        // At its reference the curve changes nothing: under one level alone the level is another.
        return {{"curvature", pick(0.15, 0.4, 0.8)}, {"reference", one_level ? 1.6 * u : u}};
    }
    if (effect == "rate_limit") {
        return {{"per_s", u / tau_s / pick(0.6, 1.5, 3.0)}};
    }
    if (effect == "actuator_lag" || effect == "sensor_lag") {
        return {{"tau_s", tau_s * pick(0.1, 0.3, 0.7)}};
    }
    if (effect == "supply_sag") {
        return one_level ? Parameters{{"resistance", pick(0.05, 0.12, 0.25) / u}}
                         : Parameters{{"per_unit_s", pick(0.05, 0.12, 0.3) / scale.charge}};
    }
    if (effect == "gain_drift") {
        return {{"per_s", sign * pick(0.05, 0.12, 0.3) / scale.until_s}};
    }
    if (effect == "coulomb_friction") {
        return {{"force", force * pick(0.02, 0.06, 0.15)}};
    }
    if (effect == "direction_dependent_friction") {
        const double more = force * pick(0.04, 0.1, 0.2);
        const double less = more * chance.between(0.1, 0.35);
        return {{"force_up", sign > 0.0 ? more : less}, {"force_down", sign > 0.0 ? less : more}};
    }
    if (effect == "quadratic_drag") {
        const double speed = 0.4 * y / tau_s;
        return {{"coefficient", force / (speed * speed) * pick(0.1, 0.3, 0.9)}};
    }
    if (effect == "gravity_nonlinearity") {
        return {{"angle_per_unit", std::min(pick(0.45, 0.65, 0.82), 0.92) / y}};
    }
    if (effect == "end_stop") {
        return {{"limit", y * (1.0 - pick(0.08, 0.2, 0.4))}, {"restitution", chance.between(0.0, 0.5)}};
    }
    if (effect == "backlash") {
        return {{"gap", y * pick(0.02, 0.06, 0.15)}};
    }
    if (effect == "structural_resonance") {
        return {{"hz", std::min(chance.between(2.0, 5.0) / tau_s, 0.2 / scale.interval_s)},
                {"damping", chance.between(0.015, 0.06)},
                {"share", pick(0.03, 0.08, 0.2)}};
    }
    if (effect == "direction_asymmetry") {
        const double slow_s = tau_s * pick(0.1, 0.3, 0.7);
        const double fast_s = slow_s * chance.between(0.1, 0.4);
        return {{"tau_up_s", sign > 0.0 ? slow_s : fast_s}, {"tau_down_s", sign > 0.0 ? fast_s : slow_s}};
    }
    if (effect == "output_curve") {
        return {{"curvature", sign * pick(0.06, 0.15, 0.35)}, {"reference", y}};
    }
    if (effect == "load_disturbance") {
        return {{"size", sign * force * pick(0.06, 0.15, 0.35)}};
    }
    if (effect == "sensor_offset") {
        return {{"offset", sign * y * pick(0.01, 0.04, 0.1)}};
    }
    if (effect == "sensor_drift") {
        return {{"per_s", sign * y * pick(0.02, 0.06, 0.2) / scale.until_s}};
    }
    if (effect == "sensor_saturation") {
        return {{"limit", y * (1.0 - pick(0.08, 0.2, 0.4))}};
    }
    if (effect == "encoder_quantisation") {
        return {{"step", y * pick(0.015, 0.04, 0.1)}};
    }
    if (effect == "missed_counts") {
        return {{"sizes", sign * y * pick(0.015, 0.05, 0.12)}};
    }
    if (effect == "sampling_jitter") {
        return {{"half_width_s", scale.interval_s * pick(0.3, 0.6, 0.86)}};
    }
    if (effect == "dropped_samples") {
        return {{"rate", pick(0.06, 0.15, 0.35)}};
    }
    if (effect == "cogging") {
        const double per_unit = 2.0 * std::numbers::pi * chance.between(2.0, 5.0) / y;
        return {{"cogging_force", force / (per_unit * y) * pick(0.5, 0.9, 1.5)}, {"cogging_per_unit", per_unit}};
    }
    if (effect == "hum") {
        return {{"hum_force", force * pick(0.03, 0.07, 0.15)}, {"hum_hz", chance.between(0.08, 0.4) / tau_s}};
    }
    if (effect == "ground_effect") {
        return {{"near_gain", pick(0.15, 0.3, 0.6)}};
    }
    if (effect == "stiffening") {
        return {{"stiffening", force / (y * y * y) * pick(0.15, 0.35, 0.8)}};
    }
    if (effect == "level_dependent_delay") {
        return {{"delay_at_rest_s", tau_s * pick(0.2, 0.5, 1.0)}};
    }
    if (effect == "input_hysteresis") {
        return {{"hysteresis", u * pick(0.05, 0.12, 0.25)}};
    }
    if (effect == "damping_growth") {
        return {{"damping_growth", force * tau_s / y / scale.until_s * pick(0.5, 1.2, 2.5)}};
    }
    if (effect == "input_step") {
        return {{"input_step", u * pick(0.08, 0.14, 0.2)}};
    }
    if (effect == "falling_gain") {
        return {{"falling_gain", pick(0.06, 0.14, 0.25)}};
    }
    if (effect == "slipping_belt") {
        return {{"slip_per_unit", pick(0.08, 0.2, 0.4)}};
    }
    if (effect == "start_up_time") {
        return {{"duration_s", tau_s * pick(0.3, 0.7, 1.5)}};
    }
    throw glsum::Failure(glsum::Exit::check_failed, fmt::format("blind: no sizes for {}", effect));
}

void draw_event(const std::string& effect, Parameters& parameters, const Scale& scale, Chance& chance) {
    if (effect == "load_disturbance") {
        const double from_s = scale.until_s * chance.between(0.15, 0.65);
        parameters["from_s"] = from_s;
        parameters["to_s"] = from_s + scale.until_s * chance.between(0.08, 0.25);
    } else if (effect == "missed_counts") {
        parameters["at_s"] = scale.until_s * chance.between(0.15, 0.75);
    }
}

void apply(const std::string& effect, const Parameters& parameters, Setup& setup) {
    for (const auto& [name, value] : parameters) {
        if (effect == "order_error") {
            for (PlantTerm& term : setup.plant.terms) {
                term.order = term.order > 0.0 ? std::max(0.05, term.order + value) : 0.0;
            }
            continue;
        }
        if (effect == "missed_counts") {
            (name == "at_s" ? setup.missed_at_s : setup.missed_size) = value;
            continue;
        }
        if (double* own = find_unlisted(name, setup.unlisted)) {
            *own = value;
            continue;
        }
        bool found = false;
        for (const Size& size : sizes()) {
            if (effect == size.effect && name == size.name) {
                setup.stand.*size.value = value;
                found = true;
            }
        }
        if (!found) {
            throw glsum::Failure(glsum::Exit::check_failed, fmt::format("blind: no place for {}.{}", effect, name));
        }
    }
}

}  // namespace stand::blind
