// The laboratory stand as physics: a bar on a pivot, two motors with propellers, what drives and what reads them.
//
//   J y'' + b y' + M sin(kappa y)/kappa = T thrust - T disturbance - T friction(y') - T drag y' |y'|
//
// y is the angle in rad, T the torque of the full thrust; sizes of forces are in units of T, so in units of the duty
// that would hold them. With every effect absent, thrust is the duty itself and the stand is linear, of second order.
// None of this shares code or formulas with the models of `drive/`.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace stand {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

struct Stand {
    // What it is made of.
    double inertia_kg_m2 = 0.03;
    double damping_n_m_s = 0.11;  ///< viscous, of the bearing
    double gravity_n_m = 0.18;    ///< torque of the weight about the pivot, the bar at a right angle
    double full_thrust_n = 7.0;
    double arm_m = 0.25;
    double delay_s = 0.02;     ///< from the command to the driver's output, on both edges
    double interval_s = 0.01;  ///< of the acquisition
    double spread_s = 0.001;   ///< its stamps lie up to this beside the even ones, and say so

    // What may be missing from a model. Each value that follows belongs to one effect of `sizes()`.
    double gain = 1.0;
    double time_scale = 1.0;
    double extra_delay_s = 0.0;
    double start_up_s = 0.85;
    double threshold = 0.05;
    double dead_zone = 0.0;
    double input_limit = 1.0;
    double rate_per_s = unlimited;
    double motor_tau_s = 0.12;
    double thrust_curvature = 1.0;
    double thrust_reference = 1.0;
    double sag_per_unit_s = 0.004;
    double battery_resistance = 0.3;
    double drift_per_s = 0.0;
    double friction = 0.0015;
    double stiction = 1.4;
    double friction_up = 0.0;
    double friction_down = 0.0;
    double drag = 0.0005;
    double sine_per_unit = 1.0;
    double upper_stop_rad = 1.3;
    double lower_stop_rad = 0.0;
    double restitution = 0.35;
    double disturbance_from_s = 0.0;
    double disturbance_to_s = 0.0;
    double disturbance_size = 0.0;
    double backlash_rad = 0.0;
    double resonance_hz = 12.0;
    double resonance_damping = 0.03;
    double resonance_share = 0.0;
    double tau_up_s = 0.0;
    double tau_down_s = 0.0;
    double output_curvature = 0.0;
    double output_reference = 1.0;
    double offset_rad = 0.0;
    double drift_rad_per_s = 0.0;
    double sensor_tau_s = 0.0;
    double sensor_limit_rad = unlimited;
    double encoder_step_rad = 0.006283185307179586;  ///< 1000 pulses a turn
    double missed_at_s = 0.0;
    double missed_counts = 0.0;
    double jitter_s = 0.0;
    double dropped_rate = 0.0;
    double noise_rad = 0.0;
    bool operator==(const Stand&) const = default;

    [[nodiscard]] double full_torque_n_m() const { return full_thrust_n * arm_m; }
};

/// One number of one effect. The effect is absent when all of its `decides` sizes have their neutral values.
struct Size {
    const char* effect;  ///< empty: what the stand is made of
    const char* name;
    double Stand::*value;
    double neutral;
    double lowest;
    double highest;
    bool decides;  ///< false: says where or how, and matters only beside a size that decides
    const char* meaning;
};

/// All sizes, in the order of the stand's file: first the parts, then the effects along the signal's way.
[[nodiscard]] std::span<const Size> sizes();

/// The effects' names, in that order.
[[nodiscard]] std::vector<std::string> effects();

/// Sets `effect.name`, or a part by its name. \throws glsum::Failure (bad input) naming what there is, or the range.
void set_size(Stand& stand, const std::string& name, double value);

/// Makes an effect absent. \throws glsum::Failure (bad input) naming the effects, if there is none of that name.
void remove_effect(Stand& stand, const std::string& effect);

/// Makes all others absent. \throws as `remove_effect`
void keep_effects(Stand& stand, std::span<const std::string> kept);

/// \throws glsum::Failure (bad input) where sizes contradict each other: stops that leave no room, a curve without an
/// actuator it can belong to.
void check(const Stand& stand, const std::string& name);

/// Effects that are present.
[[nodiscard]] std::vector<std::string> present_effects(const Stand& stand);

/// TOML: `[parts]` and one table for each effect; sizes that are left out keep the usual values. \param name  begins
/// every message \throws glsum::Failure (bad input) naming file, line, what was expected and what was found.
[[nodiscard]] Stand parse_stand(const std::string& text, const std::string& name);
[[nodiscard]] std::string to_toml(const Stand& stand);

/// The linear stand that is left without any effect, as a model file (JSON): time_scale, gain and delay included.
[[nodiscard]] std::string linear_model_json(const Stand& stand);

}  // namespace stand
