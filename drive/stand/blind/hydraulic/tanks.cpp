#include "drive/stand/blind/hydraulic/tanks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drive/stand/chance.hpp"

namespace stand::hydraulic {
namespace {

double swing(double t, double period_s) { return std::sin(2.0 * std::numbers::pi * t / period_s); }

// From the command to the opening of the valve or the speed of the pump; asked in rising times.
class Actuator {
public:
    Actuator(const Tanks& tanks, const blind::Held& held) : tanks_(tanks), held_(held) {}

    double follow(double t, double for_s) {
        const double u = command_at(t);
        double w = u > tanks_.threshold ? u : 0.0;
        w = std::clamp(w - tanks_.dead_zone, 0.0, tanks_.input_limit);
        w += tanks_.curvature * w * (w / tanks_.curve_reference - 1.0);
        if (std::fabs(w - stem_) > tanks_.stiction_band) {
            stem_ = w;
        }
        w = stem_;
        linkage_ = std::clamp(linkage_, w - 0.5 * tanks_.play_width, w + 0.5 * tanks_.play_width);
        w += tanks_.play_share * (linkage_ - w);
        if (tanks_.rate_per_s < brimless) {
            opening_ += std::clamp(w - opening_, -tanks_.rate_per_s * for_s, tanks_.rate_per_s * for_s);
        } else {
            opening_ = w;
        }
        primed_for_s_ = opening_ > 0.0 ? primed_for_s_ + for_s : 0.0;
        return primed_for_s_ < tanks_.priming_s ? 0.0 : opening_;
    }

private:
    double command_at(double t) {
        const double more_s = 0.5 * tanks_.delay_depth_s * (1.0 + swing(t, tanks_.delay_period_s));
        const double then_s = t - tanks_.delay_s - more_s;
        // A delay that grows faster than time passes shows old commands again.
        const auto after = std::upper_bound(held_.time_s.begin(), held_.time_s.end(), then_s);
        return after == held_.time_s.begin() ? 0.0
                                             : held_.input[static_cast<std::size_t>(after - held_.time_s.begin()) - 1];
    }

    const Tanks& tanks_;
    const blind::Held& held_;
    double stem_ = 0.0;
    double linkage_ = 0.0;
    double opening_ = 0.0;
    double primed_for_s_ = 0.0;
};

struct Levels {
    double pump = 0.0;
    double first_cm = 0.0;
    double last_cm = 0.0;
    double gauge_cm = 0.0;
};

double outflow(const Tanks& tanks, double k_cm2_per_s, double level_cm) {
    const double part = std::max(level_cm, 0.0) / tanks.reference_cm;
    return k_cm2_per_s * tanks.reference_cm * ((1.0 - tanks.root_share) * part + tanks.root_share * std::sqrt(part));
}

struct Weather {
    bool siphon = false;
    double flow = 1.0;  // factor of what the pump gives
};

Levels rates(const Tanks& tanks, const Levels& now, double opening, double t, const Weather& weather) {
    const double speed = tanks.pump_tau_s > 0.0 ? now.pump : opening;
    const double inflow = tanks.inflow_per_unit * speed * weather.flow * (1.0 + tanks.gain_growth_per_s * t);
    const double leak = t >= tanks.disturbance_from_s && t < tanks.disturbance_to_s ? tanks.disturbance_cm3_per_s : 0.0;
    const double between = tanks.two ? outflow(tanks, tanks.first_outflow_cm2_per_s, now.first_cm) : inflow;
    const double area = tanks.area_cm2 * (now.last_cm > tanks.wider_from_cm ? 1.0 + tanks.upper_area_share : 1.0);
    Levels rate;
    rate.pump = tanks.pump_tau_s > 0.0 ? (opening - now.pump) / tanks.pump_tau_s : 0.0;
    rate.first_cm = tanks.two ? (inflow - between) / tanks.first_area_cm2 : 0.0;
    rate.last_cm =
        (between - outflow(tanks, tanks.outflow_cm2_per_s, now.last_cm) - leak -
         (weather.siphon ? tanks.siphon_cm3_per_s : 0.0) + tanks.pulsing_cm3_per_s * swing(t, tanks.pulsing_period_s)) /
        area;
    rate.gauge_cm = tanks.sensor_tau_s > 0.0 ? (now.last_cm - now.gauge_cm) / tanks.sensor_tau_s : 0.0;
    return rate;
}

Levels after(const Tanks& tanks, const Levels& now, const Levels& rate, double for_s) {
    Levels next;
    next.pump = now.pump + for_s * rate.pump;
    next.first_cm = std::max(0.0, now.first_cm + for_s * rate.first_cm);
    next.last_cm = std::clamp(now.last_cm + for_s * rate.last_cm, 0.0, tanks.overflow_cm);
    next.gauge_cm = tanks.sensor_tau_s > 0.0 ? now.gauge_cm + for_s * rate.gauge_cm : next.last_cm;
    return next;
}

}  // namespace

std::vector<double> gauge(const Tanks& tanks, const blind::Held& held, std::span<const double> at_s, double step_s) {
    Actuator actuator(tanks, held);
    Chance bubbles(tanks.bubbles_seed, 1);
    double bubbles_change_s = tanks.bubbles_s * bubbles.between(0.5, 1.5);
    Levels now{0.0, tanks.start_cm, tanks.start_cm, tanks.start_cm};
    Weather weather;
    double t = 0.0;
    std::vector<double> shown;
    shown.reserve(at_s.size());
    for (const double until_s : at_s) {
        const int steps = std::max(0, static_cast<int>(std::ceil((until_s - t) / step_s - 1e-9)));
        const double h = steps > 0 ? (until_s - t) / steps : 0.0;
        for (int k = 0; k < steps; ++k) {
            const double from_s = t + k * h;
            if (tanks.siphon_cm3_per_s > 0.0) {
                weather.siphon = now.last_cm > (weather.siphon ? tanks.siphon_off_cm : tanks.siphon_on_cm);
            }
            if (tanks.bubbles_share > 0.0 && from_s >= bubbles_change_s) {
                weather.flow = weather.flow < 1.0 ? 1.0 : 1.0 - tanks.bubbles_share;
                bubbles_change_s = from_s + tanks.bubbles_s * bubbles.between(0.5, 1.5);
            }
            const double opening = actuator.follow(from_s + 0.5 * h, h);
            const Levels begin = rates(tanks, now, opening, from_s, weather);
            const Levels end = rates(tanks, after(tanks, now, begin, h), opening, from_s + h, weather);
            const Levels mean{0.5 * (begin.pump + end.pump), 0.5 * (begin.first_cm + end.first_cm),
                              0.5 * (begin.last_cm + end.last_cm), 0.5 * (begin.gauge_cm + end.gauge_cm)};
            now = after(tanks, now, mean, h);
        }
        t = std::max(t, until_s);
        shown.push_back(now.gauge_cm);
    }
    return shown;
}

}  // namespace stand::hydraulic
