// Ovens, hot plates, rooms: what is drawn of them, how large an effect is, and what a thermometer makes of it.
#include "drive/stand/blind/family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "drive/stand/blind/series.hpp"
#include "drive/stand/blind/thermal/oven.hpp"

namespace stand::thermal {
namespace {

using blind::EffectSize;
using blind::Fault;
using blind::Parameters;

struct Reading {
    double offset_k = 0.0;
    double drift_k_per_s = 0.0;
    double highest_c = without_bound;
    double step_k = 0.0;
    double curvature = 0.0;  ///< of what is shown over the rise above the ambient
    double held_share = 0.0;
};

class OvenRig final : public blind::Rig {
public:
    explicit OvenRig(Chance& chance);
    [[nodiscard]] Parameters draw(const std::string& effect, EffectSize size, bool one_level,
                                  Chance& chance) const override;
    [[nodiscard]] std::vector<double> read(std::span<const Fault> faults, const blind::Held& held,
                                           const std::vector<double>& noise, std::uint64_t seed) const override;

private:
    void add(const Fault& fault, Oven& oven, Reading& reading) const;

    Oven oven_;
    double rise_k_ = 1.0;  // at the full input
    double loss_w_per_k_ = 1.0;
};

OvenRig::OvenRig(Chance& chance) {
    tau_s = blind::digits(chance.scaled(20.0, 2000.0));
    rise_k_ = blind::digits(chance.scaled(20.0, 350.0));
    full_input = chance.happens(0.4) ? 100.0 : chance.happens(0.5) ? 1.0 : blind::digits(chance.between(5.0, 230.0));
    oven_.body_loss_w_per_k = blind::digits(chance.scaled(0.2, 20.0));
    plant = "body";
    if (chance.happens(0.5)) {
        plant = "body and wall";
        oven_.coupling_w_per_k = blind::digits(oven_.body_loss_w_per_k * chance.between(0.5, 3.0));
        oven_.wall_loss_w_per_k = blind::digits(oven_.body_loss_w_per_k * chance.between(0.2, 2.0));
    }
    const double wall_share = chance.scaled(0.1, 0.6);
    const double all_w_per_k = oven_.body_loss_w_per_k + oven_.wall_loss_w_per_k;
    oven_.body_j_per_k = blind::digits(tau_s * all_w_per_k * (oven_.coupling_w_per_k > 0.0 ? 1.0 - wall_share : 1.0));
    oven_.wall_j_per_k = oven_.coupling_w_per_k > 0.0 ? blind::digits(tau_s * all_w_per_k * wall_share) : 0.0;
    loss_w_per_k_ = static_loss_w_per_k(oven_);
    oven_.power_w_per_unit = blind::digits(rise_k_ * loss_w_per_k_ / full_input);
    oven_.delay_s = chance.happens(0.4) ? 0.0 : blind::digits(tau_s * chance.between(0.02, 0.4));
    oven_.sensor_tau_s = chance.happens(0.5) ? 0.0 : blind::digits(tau_s * chance.between(0.05, 0.2));
    oven_.ambient_c = blind::digits(chance.between(5.0, 30.0));
    oven_.start_c = oven_.ambient_c;
    input = chance.happens(0.5) ? "input" : "duty";
    output = chance.happens(0.5) ? "output" : "y";
    if (input == "duty") {  // a share of the full power
        oven_.power_w_per_unit *= full_input;
        full_input = 1.0;
    }
    clock.interval_s = blind::digits(tau_s / chance.between(20.0, 40.0));
    clock.until_s = clock.interval_s * 250.0 * std::round(chance.between(6.0, 12.0));
}

Parameters OvenRig::draw(const std::string& effect, EffectSize size, bool one_level, Chance& chance) const {
    const double vary = chance.between(0.85, 1.15);
    const auto pick = [&](double small, double clear, double large) {
        return vary * (size == EffectSize::small ? small : size == EffectSize::clear ? clear : large);
    };
    const double sign = chance.happens(0.5) ? 1.0 : -1.0;
    const double full_w = loss_w_per_k_ * rise_k_;
    if (effect == "gain_error") {
        return {{"gain", 1.0 + sign * pick(0.05, 0.15, 0.3)}};
    }
    if (effect == "time_scale_error") {
        return {{"scale", std::exp(sign * pick(0.1, 0.2, 0.4))}};
    }
    if (effect == "dead_time_error") {
        return {{"extra_s", tau_s * pick(0.05, 0.15, 0.4)}};
    }
    if (effect == "actuator_lag" || effect == "sensor_lag") {
        return {{"tau_s", tau_s * pick(0.05, 0.15, 0.3)}};
    }
    if (effect == "sensor_offset") {
        return {{"offset", sign * rise_k_ * pick(0.02, 0.06, 0.15)}};
    }
    if (effect == "input_saturation") {
        return {{"limit", full_input * (1.0 - pick(0.2, 0.35, 0.5))}};
    }
    if (effect == "input_dead_zone") {
        return {{"width", full_input * pick(0.06, 0.12, 0.2)}};
    }
    if (effect == "start_up_threshold") {
        return {{"threshold", full_input * pick(0.2, 0.3, 0.4)}};
    }
    if (effect == "input_curve") {
        return {{"curvature", pick(0.2, 0.45, 0.8)}, {"reference", one_level ? 1.6 * full_input : full_input}};
    }
    if (effect == "rate_limit") {
        return {{"per_s", full_input / tau_s / pick(0.8, 1.6, 3.0)}};
    }
    if (effect == "gain_drift") {
        return {{"per_s", sign * pick(0.1, 0.2, 0.4) / clock.until_s}};
    }
    if (effect == "output_curve") {
        // Radiation bends what flows out, where the body becomes hot; elsewhere the thermometer bends what is read.
        if (rise_k_ > 100.0) {
            const double hot = oven_.ambient_c + rise_k_ + 273.15;
            const double fourth = std::pow(hot, 4) - std::pow(oven_.ambient_c + 273.15, 4);
            return {{"radiation_w_per_k4", full_w * pick(0.4, 0.8, 1.5) / fourth}};
        }
        return {{"curvature", sign * pick(0.1, 0.2, 0.4)}};
    }
    if (effect == "direction_asymmetry") {
        const double slow_s = tau_s * pick(0.2, 0.4, 0.8);
        const double fast_s = slow_s * chance.between(0.1, 0.35);
        return {{"tau_up_s", sign > 0.0 ? slow_s : fast_s}, {"tau_down_s", sign > 0.0 ? fast_s : slow_s}};
    }
    if (effect == "load_disturbance") {
        return {{"size", sign * full_w * pick(0.1, 0.2, 0.35)}};
    }
    if (effect == "sensor_drift") {
        // A reading that drifts, or the surroundings, whose drift the body follows.
        const double per_s = sign * rise_k_ * pick(0.05, 0.1, 0.2) / clock.until_s;
        return {{chance.happens(0.5) ? "per_s" : "ambient_per_s", per_s}};
    }
    if (effect == "sensor_saturation") {
        return {{"limit", oven_.ambient_c + rise_k_ * (1.0 - pick(0.25, 0.4, 0.55))}};
    }
    if (effect == "encoder_quantisation") {
        return {{"step", rise_k_ * pick(0.03, 0.06, 0.1)}};
    }
    if (effect == "dropped_samples") {
        return {{"rate", pick(0.1, 0.2, 0.35)}};
    }
    if (effect == "ambient_swing") {
        return {{"swing_k", rise_k_ * pick(0.05, 0.1, 0.2)}, {"period_s", clock.until_s / chance.between(3.0, 8.0)}};
    }
    if (effect == "melting") {
        return {{"share", pick(2.0, 4.0, 8.0)},
                {"melting_c", oven_.ambient_c + rise_k_ * chance.between(0.25, 0.45)},
                {"width_k", rise_k_ * chance.between(0.04, 0.08)}};
    }
    if (effect == "thermostat_fan") {
        const double on_c = oven_.ambient_c + rise_k_ * chance.between(0.35, 0.5);
        return {
            {"fan_share", pick(0.4, 0.8, 1.5)}, {"on_c", on_c}, {"off_c", on_c - rise_k_ * chance.between(0.1, 0.2)}};
    }
    if (effect == "mains_swing") {
        return {{"mains_share", pick(0.08, 0.15, 0.3)}, {"period_s", tau_s * chance.between(2.0, 6.0)}};
    }
    throw glsum::Failure(glsum::Exit::check_failed, fmt::format("blind: no sizes for {} of an oven", effect));
}

void OvenRig::add(const Fault& fault, Oven& oven, Reading& reading) const {
    const auto number = [&](const char* name) { return fault.parameters.at(name); };
    const auto has = [&](const char* name) { return fault.parameters.contains(name); };
    if (fault.effect == "gain_error") {
        oven.power_w_per_unit *= number("gain");
    } else if (fault.effect == "time_scale_error") {
        for (double* slow : {&oven.body_j_per_k, &oven.wall_j_per_k, &oven.sensor_tau_s}) {
            *slow *= number("scale");
        }
    } else if (fault.effect == "dead_time_error") {
        oven.delay_s += number("extra_s");
    } else if (fault.effect == "actuator_lag") {
        oven.heater_tau_s = number("tau_s");
    } else if (fault.effect == "sensor_lag") {
        oven.sensor_tau_s += number("tau_s");
    } else if (fault.effect == "sensor_offset") {
        reading.offset_k = number("offset");
    } else if (fault.effect == "input_saturation") {
        oven.input_limit = number("limit");
    } else if (fault.effect == "input_dead_zone") {
        oven.dead_zone = number("width");
    } else if (fault.effect == "start_up_threshold") {
        oven.threshold = number("threshold");
    } else if (fault.effect == "input_curve") {
        oven.curvature = number("curvature");
        oven.curve_reference = number("reference");
    } else if (fault.effect == "rate_limit") {
        oven.rate_per_s = number("per_s");
    } else if (fault.effect == "gain_drift") {
        oven.gain_growth_per_s = number("per_s");
    } else if (fault.effect == "output_curve") {
        (has("curvature") ? reading.curvature : oven.radiation_w_per_k4) =
            number(has("curvature") ? "curvature" : "radiation_w_per_k4");
    } else if (fault.effect == "direction_asymmetry") {
        oven.sensor_tau_s = number("tau_up_s");
        oven.falling_tau_s = number("tau_down_s");
    } else if (fault.effect == "load_disturbance") {
        oven.disturbance_w = number("size");
        oven.disturbance_from_s = number("from_s");
        oven.disturbance_to_s = number("to_s");
    } else if (fault.effect == "sensor_drift") {
        (has("per_s") ? reading.drift_k_per_s : oven.ambient_drift_k_per_s) =
            number(has("per_s") ? "per_s" : "ambient_per_s");
    } else if (fault.effect == "sensor_saturation") {
        reading.highest_c = number("limit");
    } else if (fault.effect == "encoder_quantisation") {
        reading.step_k = number("step");
    } else if (fault.effect == "dropped_samples") {
        reading.held_share = number("rate");
    } else if (fault.effect == "ambient_swing") {
        oven.ambient_swing_k = number("swing_k");
        oven.ambient_period_s = number("period_s");
    } else if (fault.effect == "melting") {
        oven.melting_share = number("share");
        oven.melting_c = number("melting_c");
        oven.melting_width_k = number("width_k");
    } else if (fault.effect == "thermostat_fan") {
        oven.fan_share = number("fan_share");
        oven.fan_on_c = number("on_c");
        oven.fan_off_c = number("off_c");
    } else if (fault.effect == "mains_swing") {
        oven.mains_share = number("mains_share");
        oven.mains_period_s = number("period_s");
    } else {
        throw glsum::Failure(glsum::Exit::check_failed, fmt::format("blind: no place for {} in an oven", fault.effect));
    }
}

std::vector<double> OvenRig::read(std::span<const Fault> faults, const blind::Held& held,
                                  const std::vector<double>& noise, std::uint64_t seed) const {
    Oven oven = oven_;
    Reading reading;
    for (const Fault& fault : faults) {
        add(fault, oven, reading);
    }
    std::vector<double> shown = measure(oven, held, held.time_s, clock.interval_s / 10.0);
    Chance holds(seed, 31);
    int keeps = 0;
    for (std::size_t k = 0; k < shown.size(); ++k) {
        const double rise_k = shown[k] - oven.ambient_c;
        double z = oven.ambient_c + rise_k * (1.0 + reading.curvature * (rise_k / rise_k_ - 1.0));
        z += reading.offset_k + reading.drift_k_per_s * held.time_s[k] + (noise.empty() ? 0.0 : noise[k]);
        z = std::min(z, reading.highest_c);
        z = reading.step_k > 0.0 ? reading.step_k * std::round(z / reading.step_k) : z;
        // Of every 15 or so samples that are held, as many are not as the share leaves.
        if (keeps == 0 && holds.share() * 15.0 * (1.0 - reading.held_share) < reading.held_share) {
            keeps = 5 + static_cast<int>(holds.below(21));
        }
        shown[k] = keeps > 0 && k > 0 ? shown[k - 1] : z;
        keeps = std::max(0, keeps - 1);
    }
    return shown;
}

}  // namespace
}  // namespace stand::thermal

namespace stand::blind {

const Family& thermal_family() {
    static const Family family{
        "thermal",
        {"input_saturation", "input_dead_zone", "start_up_threshold", "input_curve", "rate_limit", "gain_drift",
         "output_curve", "direction_asymmetry", "load_disturbance", "sensor_drift", "sensor_saturation",
         "encoder_quantisation", "dropped_samples"},
        {"ambient_swing", "melting", "thermostat_fan", "mains_swing"},
        {"gain_error", "time_scale_error", "dead_time_error", "actuator_lag", "sensor_lag", "sensor_offset"},
        {"input_saturation", "input_dead_zone", "start_up_threshold", "input_curve"},
        [](const std::vector<std::string>&, Chance& chance) -> std::unique_ptr<Rig> {
            return std::make_unique<stand::thermal::OvenRig>(chance);
        }};
    return family;
}

}  // namespace stand::blind
