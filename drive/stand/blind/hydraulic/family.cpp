// Tanks with a pump or a valve: what is drawn of them, how large an effect is, and what a gauge makes of it.
#include "drive/stand/blind/family.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "drive/stand/blind/hydraulic/tanks.hpp"
#include "drive/stand/blind/series.hpp"

namespace stand::hydraulic {
namespace {

using blind::EffectSize;
using blind::Fault;
using blind::Parameters;

// The gauge and what sends its values.
struct Transmitter {
    double zero_cm = 0.0;
    double creep_cm_per_s = 0.0;
    double top_cm = brimless;
    double resolution_cm = 0.0;
    double stale_share = 0.0;
};

class TankRig final : public blind::Rig {
public:
    explicit TankRig(Chance& chance);
    [[nodiscard]] Parameters draw(const std::string& effect, EffectSize size, bool one_level,
                                  Chance& chance) const override;
    [[nodiscard]] std::vector<double> read(std::span<const Fault> faults, const blind::Held& held,
                                           const std::vector<double>& noise, std::uint64_t seed) const override;

private:
    Tanks tanks_;
    double zero_cm_ = 0.0;
};

TankRig::TankRig(Chance& chance) {
    tau_s = blind::digits(chance.scaled(4.0, 400.0));
    const double full_cm = blind::digits(chance.scaled(5.0, 200.0));
    full_input = chance.happens(0.4) ? 10.0 : chance.happens(0.5) ? 100.0 : blind::digits(chance.between(2.0, 24.0));
    tanks_.two = chance.happens(0.5);
    plant = tanks_.two ? "two tanks" : "one tank";
    tanks_.area_cm2 = blind::digits(chance.scaled(10.0, 2000.0));
    tanks_.outflow_cm2_per_s = blind::digits(tanks_.area_cm2 / tau_s);
    tanks_.first_area_cm2 = blind::digits(tanks_.area_cm2 * chance.between(0.3, 1.0));
    tanks_.first_outflow_cm2_per_s = tanks_.outflow_cm2_per_s;
    tanks_.reference_cm = full_cm;
    tanks_.inflow_per_unit = blind::digits(tanks_.outflow_cm2_per_s * full_cm / full_input);
    tanks_.pump_tau_s = chance.happens(0.5) ? 0.0 : blind::digits(tau_s * chance.between(0.03, 0.2));
    tanks_.delay_s = chance.happens(0.4) ? 0.0 : blind::digits(tau_s * chance.between(0.02, 0.4));
    zero_cm_ = chance.happens(0.5) ? 0.0 : blind::digits(full_cm * chance.between(-0.3, 0.6));
    input = "input";
    output = chance.happens(0.5) ? "output" : "y";
    clock.interval_s = blind::digits(tau_s / chance.between(20.0, 40.0));
    clock.until_s = clock.interval_s * 250.0 * std::round(chance.between(6.0, 12.0));
}

Parameters TankRig::draw(const std::string& effect, EffectSize size, bool one_level, Chance& chance) const {
    const double some = chance.between(0.85, 1.15);
    const auto of = [&](double small, double clear, double large) {
        return some * (size == EffectSize::small ? small : size == EffectSize::clear ? clear : large);
    };
    const double either = chance.happens(0.5) ? 1.0 : -1.0;
    const double full_cm = tanks_.reference_cm;
    const double full_flow = tanks_.outflow_cm2_per_s * full_cm;
    if (effect == "gain_error") {
        return {{"gain", 1.0 + either * of(0.05, 0.15, 0.3)}};
    }
    if (effect == "time_scale_error") {
        return {{"scale", std::exp(either * of(0.1, 0.2, 0.4))}};
    }
    if (effect == "dead_time_error") {
        return {{"extra_s", tau_s * of(0.05, 0.15, 0.4)}};
    }
    if (effect == "actuator_lag" || effect == "sensor_lag") {
        return {{"tau_s", tau_s * of(0.05, 0.15, 0.3)}};
    }
    if (effect == "sensor_offset") {
        return {{"offset", either * full_cm * of(0.02, 0.06, 0.15)}};
    }
    if (effect == "input_saturation") {
        return {{"limit", full_input * (1.0 - of(0.2, 0.35, 0.5))}};
    }
    if (effect == "input_dead_zone") {
        return {{"width", full_input * of(0.06, 0.12, 0.2)}};
    }
    if (effect == "start_up_threshold") {
        return {{"threshold", full_input * of(0.2, 0.3, 0.4)}};
    }
    if (effect == "input_curve") {
        return {{"curvature", of(0.2, 0.45, 0.8)}, {"reference", one_level ? 1.6 * full_input : full_input}};
    }
    if (effect == "rate_limit") {
        return {{"per_s", full_input / tau_s / of(0.8, 1.6, 3.0)}};
    }
    if (effect == "valve_stiction") {
        const double band = full_input * of(0.05, 0.1, 0.18);
        return {{"band", band}, {"jump", band}};
    }
    if (effect == "input_hysteresis") {
        return {{"width", full_input * of(0.12, 0.25, 0.4)}, {"share", chance.between(0.6, 1.0)}};
    }
    if (effect == "variable_delay") {
        return {{"depth_s", tau_s * of(0.3, 0.6, 1.0)}, {"period_s", tau_s * chance.between(6.0, 14.0)}};
    }
    if (effect == "gain_drift") {
        return {{"per_s", either * of(0.1, 0.2, 0.4) / clock.until_s}};
    }
    if (effect == "output_curve") {
        return {{"root_share", std::min(1.0, of(0.4, 0.7, 0.95))}};
    }
    if (effect == "end_stop") {
        return {{"limit", full_cm * (1.0 - of(0.25, 0.4, 0.55))}, {"restitution", 0.0}};
    }
    if (effect == "load_disturbance") {
        // Water that somebody adds: a leak would end where the tank is empty.
        return {{"size", -full_flow * of(0.08, 0.16, 0.3)}};
    }
    if (effect == "sensor_drift") {
        return {{"per_s", either * full_cm * of(0.05, 0.1, 0.2) / clock.until_s}};
    }
    if (effect == "sensor_saturation") {
        return {{"limit", zero_cm_ + full_cm * (1.0 - of(0.25, 0.4, 0.55))}};
    }
    if (effect == "encoder_quantisation") {
        return {{"step", full_cm * of(0.03, 0.06, 0.1)}};
    }
    if (effect == "dropped_samples") {
        return {{"rate", of(0.1, 0.2, 0.35)}};
    }
    if (effect == "stepped_area") {
        return {{"wider_share", of(1.0, 2.0, 4.0)}, {"from_cm", full_cm * chance.between(0.25, 0.45)}};
    }
    if (effect == "siphon") {
        const double on_cm = full_cm * chance.between(0.35, 0.5);
        return {
            {"flow", full_flow * of(0.3, 0.6, 1.0)}, {"on_cm", on_cm}, {"off_cm", on_cm * chance.between(0.2, 0.6)}};
    }
    if (effect == "pulsing_inflow") {
        // Not below what flows anyway: the level stays above the bottom.
        return {{"flow", full_flow * of(0.05, 0.08, 0.15)}, {"period_s", tau_s * chance.between(3.0, 9.0)}};
    }
    if (effect == "priming_time") {
        return {{"duration_s", tau_s * of(0.4, 0.8, 1.5)}};
    }
    if (effect == "bubbles") {
        return {{"bubbles_share", of(0.2, 0.4, 0.6)}, {"for_s", tau_s * chance.between(0.8, 2.5)}};
    }
    throw glsum::Failure(glsum::Exit::check_failed, fmt::format("blind: no sizes for {} of tanks", effect));
}

// Where each number goes.
void set(const Fault& fault, Tanks& tanks, Transmitter& sender) {
    const std::vector<std::tuple<const char*, const char*, double*>> places{
        {"actuator_lag", "tau_s", &tanks.pump_tau_s},
        {"sensor_lag", "tau_s", &tanks.sensor_tau_s},
        {"input_saturation", "limit", &tanks.input_limit},
        {"input_dead_zone", "width", &tanks.dead_zone},
        {"start_up_threshold", "threshold", &tanks.threshold},
        {"input_curve", "curvature", &tanks.curvature},
        {"input_curve", "reference", &tanks.curve_reference},
        {"rate_limit", "per_s", &tanks.rate_per_s},
        {"valve_stiction", "band", &tanks.stiction_band},
        {"input_hysteresis", "width", &tanks.play_width},
        {"input_hysteresis", "share", &tanks.play_share},
        {"variable_delay", "depth_s", &tanks.delay_depth_s},
        {"variable_delay", "period_s", &tanks.delay_period_s},
        {"gain_drift", "per_s", &tanks.gain_growth_per_s},
        {"output_curve", "root_share", &tanks.root_share},
        {"end_stop", "limit", &tanks.overflow_cm},
        {"load_disturbance", "size", &tanks.disturbance_cm3_per_s},
        {"load_disturbance", "from_s", &tanks.disturbance_from_s},
        {"load_disturbance", "to_s", &tanks.disturbance_to_s},
        {"sensor_drift", "per_s", &sender.creep_cm_per_s},
        {"sensor_saturation", "limit", &sender.top_cm},
        {"encoder_quantisation", "step", &sender.resolution_cm},
        {"dropped_samples", "rate", &sender.stale_share},
        {"stepped_area", "wider_share", &tanks.upper_area_share},
        {"stepped_area", "from_cm", &tanks.wider_from_cm},
        {"siphon", "flow", &tanks.siphon_cm3_per_s},
        {"siphon", "on_cm", &tanks.siphon_on_cm},
        {"siphon", "off_cm", &tanks.siphon_off_cm},
        {"pulsing_inflow", "flow", &tanks.pulsing_cm3_per_s},
        {"pulsing_inflow", "period_s", &tanks.pulsing_period_s},
        {"priming_time", "duration_s", &tanks.priming_s},
        {"bubbles", "bubbles_share", &tanks.bubbles_share},
        {"bubbles", "for_s", &tanks.bubbles_s}};
    for (const auto& [name, value] : fault.parameters) {
        if (fault.effect == "gain_error") {
            tanks.inflow_per_unit *= value;
        } else if (fault.effect == "time_scale_error") {
            tanks.first_area_cm2 *= value;
            tanks.area_cm2 *= value;
        } else if (fault.effect == "dead_time_error") {
            tanks.delay_s += value;
        } else if (fault.effect == "sensor_offset") {
            sender.zero_cm += value;
        } else {
            bool found = fault.effect == "valve_stiction" || fault.effect == "end_stop";  // jump, restitution
            for (const auto& [effect, number, place] : places) {
                if (fault.effect == effect && name == number) {
                    *place = value;
                    found = true;
                }
            }
            if (!found) {
                throw glsum::Failure(glsum::Exit::check_failed,
                                     fmt::format("blind: no place for {}.{} in tanks", fault.effect, name));
            }
        }
    }
}

std::vector<double> TankRig::read(std::span<const Fault> faults, const blind::Held& held,
                                  const std::vector<double>& noise, std::uint64_t seed) const {
    Tanks tanks = tanks_;
    Transmitter sender;
    sender.zero_cm = zero_cm_;
    for (const Fault& fault : faults) {
        set(fault, tanks, sender);
    }
    tanks.bubbles_seed = seed;
    const std::vector<double> level_cm = gauge(tanks, held, held.time_s, clock.interval_s / 10.0);
    // Stale stretches of 5 to 25 values, and fresh ones between them to match the share.
    Chance chance(seed, 47);
    const double mean_fresh = sender.stale_share > 0.0 ? 15.0 * (1.0 / sender.stale_share - 1.0) : 0.0;
    std::size_t next_stale = 0;
    std::size_t next_fresh = 0;
    std::vector<double> sent;
    for (std::size_t k = 0; k < level_cm.size(); ++k) {
        const double t = held.time_s[k];
        double value = level_cm[k] + sender.zero_cm + sender.creep_cm_per_s * t + (noise.empty() ? 0.0 : noise[k]);
        value = std::min(value, sender.top_cm);
        if (sender.resolution_cm > 0.0) {
            value = sender.resolution_cm * std::floor(value / sender.resolution_cm + 0.5);
        }
        if (mean_fresh > 0.0 && k >= next_fresh) {
            next_stale = k + 1 + static_cast<std::size_t>(2.0 * mean_fresh * chance.share());
            next_fresh = next_stale + 5 + chance.below(21);
        }
        sent.push_back(mean_fresh > 0.0 && k >= next_stale && k > 0 ? sent.back() : value);
    }
    return sent;
}

}  // namespace
}  // namespace stand::hydraulic

namespace stand::blind {

const Family& hydraulic_family() {
    static const Family family{
        "hydraulic",
        {"input_saturation", "input_dead_zone", "start_up_threshold", "input_curve", "rate_limit", "valve_stiction",
         "input_hysteresis", "variable_delay", "gain_drift", "output_curve", "end_stop", "load_disturbance",
         "sensor_drift", "sensor_saturation", "encoder_quantisation", "dropped_samples"},
        {"stepped_area", "siphon", "pulsing_inflow", "priming_time", "bubbles"},
        {"gain_error", "time_scale_error", "dead_time_error", "actuator_lag", "sensor_lag", "sensor_offset"},
        {"input_saturation", "input_dead_zone", "start_up_threshold", "input_curve"},
        [](const std::vector<std::string>&, Chance& chance) -> std::unique_ptr<Rig> {
            return std::make_unique<stand::hydraulic::TankRig>(chance);
        }};
    return family;
}

}  // namespace stand::blind
