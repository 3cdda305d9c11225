// The virtual stand and linear plants as a family of cases without a model.
#include <algorithm>
#include <cmath>

#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "drive/stand/blind/series.hpp"

namespace stand::blind {
namespace {

class MechanicalRig final : public Rig {
public:
    MechanicalRig(bool physical, bool fractional, Chance& chance)
        : base_(draw_mechanical(physical, fractional, chance)) {
        plant = base_.kind;
        input = physical ? "duty" : "input";
        output = physical ? "angle_rad" : chance.happens(0.5) ? "output" : "y";
        tau_s = base_.tau_s;
        full_input = base_.setup.plant.full_input;
        clock = base_.clock;
        remembers = fractional;
        if (chance.happens(0.5)) {
            base_.setup.stand.offset_rad = digits(base_.setup.plant.full_output * chance.between(-0.3, 0.5));
        }
    }

    [[nodiscard]] Parameters draw(const std::string& effect, EffectSize size, bool one_level,
                                  Chance& chance) const override {
        const Plant& own = base_.setup.plant;
        const Scale scale{full_input,       own.full_output, own.gain * full_input,           tau_s,
                          clock.interval_s, clock.until_s,   0.5 * full_input * clock.until_s};
        return draw_parameters(effect == "cubic_stiffness" ? "stiffening" : effect, size, scale, one_level, chance);
    }

    [[nodiscard]] std::vector<double> read(std::span<const Fault> faults, const Held& held,
                                           const std::vector<double>& noise, std::uint64_t seed) const override {
        Setup setup = base_.setup;
        for (const Fault& fault : faults) {
            apply(fault.effect, fault.parameters, setup);
        }
        return acquire(setup, move_record(base_, setup, held, seed), noise, seed);
    }

private:
    Mechanical base_;
};

std::unique_ptr<Rig> draw_rig(const std::vector<std::string>& effects, Chance& chance) {
    const auto has = [&](const char* name) { return std::find(effects.begin(), effects.end(), name) != effects.end(); };
    const bool linear = has("cubic_stiffness") || std::any_of(effects.begin(), effects.end(), needs_linear_plant);
    const double which = chance.share();
    const bool physical = has("start_up_time") || (!linear && which < 0.4);
    return std::make_unique<MechanicalRig>(physical, !physical && which > 0.85, chance);
}

}  // namespace

const Family& mechanical_family() {
    static const Family family{
        "mechanical",
        {"input_saturation",
         "input_dead_zone",
         "start_up_threshold",
         "input_curve",
         "rate_limit",
         "supply_sag",
         "gain_drift",
         "coulomb_friction",
         "direction_dependent_friction",
         "quadratic_drag",
         "gravity_nonlinearity",
         "end_stop",
         "backlash",
         "direction_asymmetry",
         "output_curve",
         "load_disturbance",
         "sensor_drift",
         "sensor_saturation",
         "encoder_quantisation",
         "missed_counts",
         "dropped_samples",
         "cogging",
         "cubic_stiffness",
         "input_hysteresis"},
        {"hum", "ground_effect", "damping_growth", "input_step", "falling_gain", "slipping_belt", "start_up_time"},
        {"gain_error", "time_scale_error", "dead_time_error", "order_error", "actuator_lag", "sensor_lag",
         "sensor_offset"},
        {"input_saturation", "input_dead_zone", "start_up_threshold", "input_curve", "supply_sag"},
        draw_rig};
    return family;
}

std::span<const Family* const> families() {
    static const Family* const all[] = {&mechanical_family(), &thermal_family(), &hydraulic_family()};
    return all;
}

}  // namespace stand::blind
