#include "drive/stand/blind/thermal/oven.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stand::thermal {
namespace {

constexpr double kelvin = 273.15;

enum Part : std::size_t { heater, body, wall, thermometer, parts };
using State = std::array<double, parts>;

// The input that acts at a time, bends and slope included; asked for in rising times.
class HeaterInput {
public:
    HeaterInput(const Oven& oven, const blind::Held& held) : oven_(oven), held_(held) {}

    double at(double t, double since_last_s) {
        while (next_ < held_.time_s.size() && held_.time_s[next_] <= t - oven_.delay_s) {
            ++next_;
        }
        const double asked = bend(next_ == 0 ? 0.0 : held_.input[next_ - 1]);
        const double most = oven_.rate_per_s * since_last_s;
        applied_ = std::isfinite(most) ? applied_ + std::clamp(asked - applied_, -most, most) : asked;
        return applied_;
    }

private:
    [[nodiscard]] double bend(double u) const {
        if (u <= oven_.threshold) {
            return 0.0;
        }
        const double w = std::min(std::max(u - oven_.dead_zone, 0.0), oven_.input_limit);
        return w * (1.0 + oven_.curvature * (w / oven_.curve_reference - 1.0));
    }

    const Oven& oven_;
    const blind::Held& held_;
    std::size_t next_ = 0;
    double applied_ = 0.0;
};

double ambient_at(const Oven& oven, double t) {
    return oven.ambient_c + oven.ambient_drift_k_per_s * t +
           oven.ambient_swing_k * std::sin(2.0 * std::numbers::pi * t / oven.ambient_period_s);
}

State slope_of(const Oven& oven, const State& now, double input, double t, bool fan) {
    const double ambient = ambient_at(oven, t);
    const double mains = 1.0 + oven.gain_growth_per_s * t +
                         oven.mains_share * std::sin(2.0 * std::numbers::pi * t / oven.mains_period_s);
    const double power = oven.power_w_per_unit * mains * (oven.heater_tau_s > 0.0 ? now[heater] : input);
    const double to_wall = oven.wall_j_per_k > 0.0 ? oven.coupling_w_per_k * (now[body] - now[wall]) : 0.0;
    const double open = t >= oven.disturbance_from_s && t < oven.disturbance_to_s ? oven.disturbance_w : 0.0;
    const double loss = oven.body_loss_w_per_k * (fan ? 1.0 + oven.fan_share : 1.0) * (now[body] - ambient) +
                        oven.radiation_w_per_k4 * (std::pow(now[body] + kelvin, 4) - std::pow(ambient + kelvin, 4));
    const double from_melting = (now[body] - oven.melting_c) / oven.melting_width_k;
    const double stores =
        oven.body_j_per_k * (1.0 + oven.melting_share * std::exp(-std::min(from_melting * from_melting, 700.0)));
    State slope{};
    slope[heater] = oven.heater_tau_s > 0.0 ? (input - now[heater]) / oven.heater_tau_s : 0.0;
    slope[body] = (power - to_wall - loss - open) / stores;
    slope[wall] =
        oven.wall_j_per_k > 0.0 ? (to_wall - oven.wall_loss_w_per_k * (now[wall] - ambient)) / oven.wall_j_per_k : 0.0;
    const bool falls = now[body] < now[thermometer];
    const double tau_s = falls && oven.falling_tau_s > 0.0 ? oven.falling_tau_s : oven.sensor_tau_s;
    slope[thermometer] = tau_s > 0.0 ? (now[body] - now[thermometer]) / tau_s : slope[body];
    return slope;
}

State moved_by(const State& from, const State& slope, double for_s) {
    State to = from;
    for (std::size_t i = 0; i < parts; ++i) {
        to[i] += for_s * slope[i];
    }
    return to;
}

}  // namespace

double static_loss_w_per_k(const Oven& oven) {
    const double through = oven.coupling_w_per_k + oven.wall_loss_w_per_k;
    const double by_the_wall =
        oven.wall_j_per_k > 0.0 && through > 0.0 ? oven.coupling_w_per_k * oven.wall_loss_w_per_k / through : 0.0;
    return oven.body_loss_w_per_k + by_the_wall;
}

std::vector<double> measure(const Oven& oven, const blind::Held& held, std::span<const double> at_s, double step_s) {
    HeaterInput source(oven, held);
    State now{0.0, oven.start_c, oven.start_c, oven.start_c};
    bool fan = false;
    double t = 0.0;
    std::vector<double> shown;
    shown.reserve(at_s.size());
    for (const double until_s : at_s) {
        const double steps = std::ceil((until_s - t) / step_s - 1e-9);
        const double h = steps > 0.0 ? (until_s - t) / steps : 0.0;
        for (double k = 0.0; k < steps; k += 1.0) {
            const double from_s = t + k * h;
            const double input = source.at(from_s + 0.5 * h, h);
            fan = oven.fan_share > 0.0 && (fan ? now[body] > oven.fan_off_c : now[body] > oven.fan_on_c);
            const State a = slope_of(oven, now, input, from_s, fan);
            const State b = slope_of(oven, moved_by(now, a, 0.5 * h), input, from_s + 0.5 * h, fan);
            const State c = slope_of(oven, moved_by(now, b, 0.5 * h), input, from_s + 0.5 * h, fan);
            const State d = slope_of(oven, moved_by(now, c, h), input, from_s + h, fan);
            for (std::size_t i = 0; i < parts; ++i) {
                now[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
            }
        }
        t = std::max(t, until_s);
        shown.push_back(now[thermometer]);
    }
    return shown;
}

}  // namespace stand::thermal
