#include "drive/stand/stand.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <cmath>
#include <sstream>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"

namespace stand {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

constexpr double any = unlimited;

// Names as in the table of effects that the diagnosis knows; start_up_time and noise are the stand's own.
constexpr Size table[] = {
    {"", "inertia_kg_m2", &Stand::inertia_kg_m2, 0.03, 1e-6, 1e3, true, "of the bar and its motors about the pivot"},
    {"", "damping_n_m_s", &Stand::damping_n_m_s, 0.11, 0.0, 1e3, true, "viscous, of the bearing"},
    {"", "gravity_n_m", &Stand::gravity_n_m, 0.18, 0.0, 1e3, true, "torque of the weight, the bar at a right angle"},
    {"", "full_thrust_n", &Stand::full_thrust_n, 7.0, 1e-6, 1e4, true, "of a motor at full duty"},
    {"", "arm_m", &Stand::arm_m, 0.25, 1e-3, 10.0, true, "from the pivot to the motor"},
    {"", "delay_s", &Stand::delay_s, 0.02, 0.0, 10.0, true, "from the command to the driver, on both edges"},
    {"", "interval_s", &Stand::interval_s, 0.01, 1e-4, 10.0, true, "of the acquisition"},
    {"", "spread_s", &Stand::spread_s, 0.001, 0.0, 5.0, true, "stamps lie up to this beside the even ones"},

    {"gain_error", "gain", &Stand::gain, 1.0, 1e-3, 1e3, true, "factor of the thrust"},
    {"time_scale_error", "scale", &Stand::time_scale, 1.0, 1e-2, 1e2, true,
     "everything mechanical takes so many times"},
    {"dead_time_error", "extra_s", &Stand::extra_delay_s, 0.0, 0.0, 10.0, true, "more delay, on both edges"},
    {"start_up_time", "duration_s", &Stand::start_up_s, 0.0, 0.0, 10.0, true,
     "the driver aligns the rotor before it turns"},
    {"start_up_threshold", "threshold", &Stand::threshold, 0.0, 0.0, 1.0, true, "duty below which the motor stands"},
    {"input_dead_zone", "width", &Stand::dead_zone, 0.0, 0.0, 1.0, true, "duty that is lost"},
    {"input_saturation", "limit", &Stand::input_limit, any, 1e-6, any, true, "largest duty that acts"},
    {"rate_limit", "per_s", &Stand::rate_per_s, any, 1e-6, any, true, "the driver's slope"},
    {"actuator_lag", "tau_s", &Stand::motor_tau_s, 0.0, 0.0, 100.0, true, "time constant of the rotor"},
    {"input_curve", "curvature", &Stand::thrust_curvature, 0.0, -1.0, 1.0, true,
     "1: thrust over speed squared; 0: over speed"},
    {"input_curve", "reference", &Stand::thrust_reference, 1.0, 1e-6, 1e6, false, "speed at which both are equal"},
    {"supply_sag", "per_unit_s", &Stand::sag_per_unit_s, 0.0, 0.0, 10.0, true,
     "share of the voltage lost for each duty second"},
    {"supply_sag", "resistance", &Stand::battery_resistance, 0.0, 0.0, 10.0, true,
     "share of it lost inside at full load"},
    {"gain_drift", "per_s", &Stand::drift_per_s, 0.0, -10.0, 10.0, true, "growth of the thrust"},
    {"coulomb_friction", "force", &Stand::friction, 0.0, 0.0, 10.0, true, "of the bearing, against motion"},
    {"coulomb_friction", "stiction", &Stand::stiction, 1.0, 1.0, 100.0, false,
     "to break loose takes so many times more"},
    {"direction_dependent_friction", "force_up", &Stand::friction_up, 0.0, 0.0, 10.0, true, "more friction upward"},
    {"direction_dependent_friction", "force_down", &Stand::friction_down, 0.0, 0.0, 10.0, true,
     "more friction downward"},
    {"quadratic_drag", "coefficient", &Stand::drag, 0.0, 0.0, 100.0, true, "of the air, times (rad/s)^2"},
    {"gravity_nonlinearity", "angle_per_unit", &Stand::sine_per_unit, 0.0, 0.0, 100.0, true,
     "kappa: 1 is a true sine, 0 a spring"},
    {"end_stop", "limit", &Stand::upper_stop_rad, any, -any, any, true, "upper stop"},
    {"end_stop", "lower", &Stand::lower_stop_rad, -any, -any, any, true, "lower stop"},
    {"end_stop", "restitution", &Stand::restitution, 0.0, 0.0, 1.0, false, "share of the speed that a bounce leaves"},
    {"load_disturbance", "from_s", &Stand::disturbance_from_s, 0.0, 0.0, 1e6, false, "the second motor starts"},
    {"load_disturbance", "to_s", &Stand::disturbance_to_s, 0.0, 0.0, 1e6, false, "and stops"},
    {"load_disturbance", "size", &Stand::disturbance_size, 0.0, -10.0, 10.0, true, "its thrust, against the first"},
    {"backlash", "gap", &Stand::backlash_rad, 0.0, 0.0, 10.0, true, "between bar and encoder"},
    {"output_curve", "curvature", &Stand::output_curvature, 0.0, -1.0, 1.0, true, "bend of the reading"},
    {"output_curve", "reference", &Stand::output_reference, 1.0, 1e-6, 1e6, false, "angle that reads as it is"},
    {"direction_asymmetry", "tau_up_s", &Stand::tau_up_s, 0.0, 0.0, 100.0, true, "lag of a rising reading"},
    {"direction_asymmetry", "tau_down_s", &Stand::tau_down_s, 0.0, 0.0, 100.0, true, "lag of a falling one"},
    {"structural_resonance", "hz", &Stand::resonance_hz, 12.0, 1e-2, 1e3, false, "the bar's own swing"},
    {"structural_resonance", "damping", &Stand::resonance_damping, 0.03, 0.0, 1.0, false, "its damping ratio"},
    {"structural_resonance", "share", &Stand::resonance_share, 0.0, -10.0, 10.0, true,
     "its deflection for that of the pivot"},
    {"sensor_lag", "tau_s", &Stand::sensor_tau_s, 0.0, 0.0, 100.0, true, "first order"},
    {"sensor_offset", "offset", &Stand::offset_rad, 0.0, -100.0, 100.0, true, ""},
    {"sensor_drift", "per_s", &Stand::drift_rad_per_s, 0.0, -100.0, 100.0, true, ""},
    {"noise", "deviation", &Stand::noise_rad, 0.0, 0.0, 100.0, true, "white and normal, before the encoder"},
    {"sensor_saturation", "limit", &Stand::sensor_limit_rad, any, 1e-6, any, true, "largest reading, either side"},
    {"encoder_quantisation", "step", &Stand::encoder_step_rad, 0.0, 0.0, 10.0, true, "one count"},
    {"missed_counts", "at_s", &Stand::missed_at_s, 0.0, 0.0, 1e6, false, "from then on"},
    {"missed_counts", "sizes", &Stand::missed_counts, 0.0, -1e6, 1e6, true, "counts that are lost"},
    {"sampling_jitter", "half_width_s", &Stand::jitter_s, 0.0, 0.0, 5.0, true,
     "a sample is taken so far from its stamp"},
    {"dropped_samples", "rate", &Stand::dropped_rate, 0.0, 0.0, 0.99, true,
     "share of samples that repeat the one before"},
};

std::string full_name(const Size& size) {
    return *size.effect == '\0' ? size.name : fmt::format("{}.{}", size.effect, size.name);
}

void set(Stand& stand, const Size& size, double value, const std::string& where) {
    if (!(value >= size.lowest && value <= size.highest)) {
        refuse(
            fmt::format("{}{}: expected {} to {}, found {}", where, full_name(size), size.lowest, size.highest, value));
    }
    stand.*size.value = value;
}

void check_effect(const std::string& effect) {
    const std::vector<std::string> all = effects();
    if (std::find(all.begin(), all.end(), effect) == all.end()) {
        refuse(fmt::format("expected one of the effects {}, found {}; the nearest is {}", fmt::join(all, ", "), effect,
                           base::nearest_name(effect, all)));
    }
}

std::string number(double value) {
    std::string text = fmt::format("{}", value);
    // TOML wants a point or an exponent in a float.
    return std::isfinite(value) && text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::span<const Size> sizes() { return table; }

std::vector<std::string> effects() {
    std::vector<std::string> names;
    for (const Size& size : table) {
        if (*size.effect != '\0' && (names.empty() || names.back() != size.effect)) {
            names.emplace_back(size.effect);
        }
    }
    return names;
}

void set_size(Stand& stand, const std::string& name, double value) {
    std::vector<std::string> names;
    for (const Size& size : table) {
        if (full_name(size) == name) {
            set(stand, size, value, "");
            return;
        }
        names.push_back(full_name(size));
    }
    refuse(fmt::format("expected a size of the stand (--show prints all), found {}; the nearest is {}", name,
                       base::nearest_name(name, names)));
}

void remove_effect(Stand& stand, const std::string& effect) {
    check_effect(effect);
    for (const Size& size : table) {
        if (effect == size.effect) {
            stand.*size.value = size.neutral;
        }
    }
}

void keep_effects(Stand& stand, std::span<const std::string> kept) {
    for (const std::string& effect : kept) {
        check_effect(effect);
    }
    for (const std::string& effect : effects()) {
        if (std::find(kept.begin(), kept.end(), effect) == kept.end()) {
            remove_effect(stand, effect);
        }
    }
}

std::vector<std::string> present_effects(const Stand& stand) {
    std::vector<std::string> names;
    for (const Size& size : table) {
        if (*size.effect != '\0' && size.decides && stand.*size.value != size.neutral &&
            (names.empty() || names.back() != size.effect)) {
            names.emplace_back(size.effect);
        }
    }
    return names;
}

void check(const Stand& stand, const std::string& name) {
    for (const Size& size : table) {
        const double value = stand.*size.value;
        if (!(value >= size.lowest && value <= size.highest)) {
            refuse(fmt::format("{}: {}: expected {} to {}, found {}", name, full_name(size), size.lowest, size.highest,
                               value));
        }
        const bool lag = std::string_view(size.name).starts_with("tau");
        if (lag && value != 0.0 && value < 1e-4) {
            refuse(fmt::format("{}: {}: expected 0 or at least 0.0001 s, found {}", name, full_name(size), value));
        }
    }
    if (!(stand.lower_stop_rad < stand.upper_stop_rad)) {
        refuse(fmt::format("{}: end_stop: expected the lower stop below the upper, found {} and {}", name,
                           stand.lower_stop_rad, stand.upper_stop_rad));
    }
    if ((stand.tau_up_s == 0.0) != (stand.tau_down_s == 0.0)) {
        refuse(fmt::format("{}: direction_asymmetry: expected both lags or none, found {} and {} s", name,
                           stand.tau_up_s, stand.tau_down_s));
    }
    if (!(2.0 * stand.spread_s < stand.interval_s)) {
        refuse(fmt::format("{}: spread_s: expected less than half of the interval {} s, found {}", name,
                           stand.interval_s, stand.spread_s));
    }
    if (stand.disturbance_size != 0.0 && !(stand.disturbance_from_s < stand.disturbance_to_s)) {
        refuse(fmt::format("{}: load_disturbance: expected from_s below to_s, found {} and {}", name,
                           stand.disturbance_from_s, stand.disturbance_to_s));
    }
    if (stand.resonance_share != 0.0 && stand.gravity_n_m == 0.0) {
        refuse(fmt::format("{}: structural_resonance: expected gravity, of whose deflection it is a share, found none",
                           name));
    }
}

Stand parse_stand(const std::string& text, const std::string& name) {
    Stand stand;
    try {
        const toml::table file = toml::parse(text, name);
        for (const auto& [key, node] : file) {
            const std::string effect(key.str() == "parts" ? "" : key.str());
            const auto line = node.source().begin.line;
            if (!node.is_table()) {
                refuse(fmt::format("{}:{}: expected tables [parts] or [EFFECT], found {}", name, line, key.str()));
            }
            for (const auto& [own_key, own] : *node.as_table()) {
                const auto own_line = own.source().begin.line;
                const Size* found = nullptr;
                std::vector<std::string> names;
                for (const Size& size : table) {
                    if (effect == size.effect) {
                        names.emplace_back(size.name);
                        found = own_key.str() == size.name ? &size : found;
                    }
                }
                if (names.empty()) {
                    refuse(fmt::format("{}:{}: expected parts or one of the effects {}, found {}", name, line,
                                       fmt::join(effects(), ", "), effect));
                }
                if (found == nullptr) {
                    refuse(fmt::format("{}:{}: {}: expected {}, found {}", name, own_line, key.str(),
                                       fmt::join(names, ", "), own_key.str()));
                }
                const auto value = own.value<double>();
                if (!value) {
                    refuse(fmt::format("{}:{}: {}: expected a number", name, own_line, full_name(*found)));
                }
                set(stand, *found, *value, fmt::format("{}:{}: ", name, own_line));
            }
        }
    } catch (const toml::parse_error& error) {
        refuse(fmt::format("{}:{}: expected TOML: {}", name, error.source().begin.line, error.description()));
    }
    check(stand, name);
    return stand;
}

std::string to_toml(const Stand& stand) {
    std::string text;
    const char* effect = nullptr;
    for (const Size& size : table) {
        if (effect == nullptr || std::string_view(effect) != size.effect) {
            text +=
                fmt::format("{}[{}]\n", effect == nullptr ? "" : "\n", *size.effect == '\0' ? "parts" : size.effect);
            effect = size.effect;
        }
        const std::string line = fmt::format("{} = {}", size.name, number(stand.*size.value));
        text += *size.meaning == '\0' ? line + "\n" : fmt::format("{:<38} # {}\n", line, size.meaning);
    }
    return text;
}

std::string linear_model_json(const Stand& stand) {
    const double torque = stand.full_torque_n_m() * stand.gain;
    return fmt::format(
        "{{\n  \"kind\": \"fotf\",\n  \"denominator\": [\n    {{\"coefficient\": {}, \"order\": 2}},\n    "
        "{{\"coefficient\": {}, \"order\": 1}},\n    {{\"coefficient\": {}, \"order\": 0}}\n  ],\n  \"delay_s\": "
        "{}\n}}\n",
        stand.inertia_kg_m2 * stand.time_scale * stand.time_scale / torque,
        stand.damping_n_m_s * stand.time_scale / torque, stand.gravity_n_m / torque,
        stand.delay_s + stand.extra_delay_s);
}

}  // namespace stand
