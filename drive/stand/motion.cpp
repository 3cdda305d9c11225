#include "drive/stand/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <numbers>

#include "base/failure.hpp"

namespace stand {
namespace {

enum Index { angle, speed, rotor, second_rotor, charge, play, asymmetric, swing, swing_speed, lagged, state_size };
using State = std::array<double, state_size>;

enum class Mode { up, down, stuck, on_upper, on_lower };
enum class Contact { free, up, down };

constexpr double longest_step_s = 0.005;
constexpr double rest_speed = 1e-6;  // slower impacts end the bouncing
constexpr std::size_t most_events = 1'000'000;

class Bar {
public:
    Bar(const Stand& stand, const Start& start) : stand_(stand) {
        const double torque = stand.full_torque_n_m();
        inertia_ = stand.inertia_kg_m2 * stand.time_scale * stand.time_scale / torque;
        damping_ = stand.damping_n_m_s * stand.time_scale / torque;
        spring_ = stand.gravity_n_m / torque;
        state_ = {};
        state_[angle] = start.angle_rad;
        state_[play] = start.angle_rad;
        state_[charge] = start.charge;
        state_[asymmetric] = curved(start.angle_rad);
        state_[lagged] = state_[asymmetric];
    }

    Motion run(std::span<const Piece> pieces, std::span<const double> times_s) {
        const double end_s = times_s.empty() ? 0.0 : times_s.back();
        std::vector<double> breaks;
        for (const Piece& piece : pieces) {
            breaks.push_back(piece.time_s);
        }
        if (stand_.disturbance_size != 0.0) {
            breaks.push_back(stand_.disturbance_from_s);
            breaks.push_back(stand_.disturbance_to_s);
        }
        breaks.push_back(end_s);
        std::sort(breaks.begin(), breaks.end());
        std::size_t piece = 0;
        double now_s = 0.0;
        next_ = 0;
        for (const double break_s : breaks) {
            if (break_s < now_s || break_s > end_s) {
                continue;
            }
            advance(now_s, break_s, times_s);
            now_s = break_s;
            while (piece < pieces.size() && pieces[piece].time_s <= now_s) {
                piece_ = pieces[piece++];
            }
            disturbed_ =
                stand_.disturbance_size != 0.0 && now_s >= stand_.disturbance_from_s && now_s < stand_.disturbance_to_s;
        }
        while (next_ < times_s.size()) {
            motion_.points.push_back(point_at(times_s[next_++], state_));
        }
        return std::move(motion_);
    }

private:
    [[nodiscard]] double curved(double y) const {
        const double c = stand_.output_curvature;
        return y * ((1.0 - c) + c * y / stand_.output_reference);
    }
    [[nodiscard]] double duty_at(double t) const { return piece_.level + piece_.slope_per_s * (t - piece_.time_s); }

    // The rotor's speed; without a lag, where voltage and load meet.
    [[nodiscard]] double rotor_of(const State& x, double t) const {
        if (stand_.motor_tau_s > 0.0) {
            return x[rotor];
        }
        const double duty = duty_at(t);
        const double target = duty * (1.0 - stand_.sag_per_unit_s * x[charge]);
        const double load = stand_.battery_resistance * duty * duty;
        return load == 0.0 ? target : 2.0 * target / (1.0 + std::sqrt(1.0 + 4.0 * load * target));
    }
    [[nodiscard]] double thrust(const State& x, double t) const {
        const double n = rotor_of(x, t);
        const double c = stand_.thrust_curvature;
        return stand_.gain * (1.0 + stand_.drift_per_s * t) * n * ((1.0 - c) + c * n / stand_.thrust_reference);
    }
    [[nodiscard]] double second_target() const { return disturbed_ ? stand_.disturbance_size : 0.0; }
    [[nodiscard]] double second_thrust(const State& x) const {
        return stand_.motor_tau_s > 0.0 ? x[second_rotor] : second_target();
    }

    // All but friction, in units of the full thrust's torque.
    [[nodiscard]] double torque(const State& x, double t) const {
        const double kappa = stand_.sine_per_unit;
        const double weight = kappa == 0.0 ? x[angle] : std::sin(kappa * x[angle]) / kappa;
        return thrust(x, t) - second_thrust(x) - damping_ * x[speed] - spring_ * weight -
               stand_.drag * x[speed] * std::fabs(x[speed]);
    }
    [[nodiscard]] double friction(bool upward) const {
        return stand_.friction + (upward ? stand_.friction_up : stand_.friction_down);
    }
    [[nodiscard]] double hold(bool upward) const { return stand_.stiction * friction(upward); }

    void derive(const State& x, State& dx, double t) const {
        const bool moves = mode_ == Mode::up || mode_ == Mode::down;
        dx[angle] = moves ? x[speed] : 0.0;
        dx[speed] = 0.0;
        if (moves) {
            const double against = mode_ == Mode::up ? friction(true) : -friction(false);
            dx[speed] = (torque(x, t) - against) / inertia_;
        }
        const double duty = duty_at(t);
        dx[charge] = duty;
        dx[rotor] = 0.0;
        dx[second_rotor] = 0.0;
        if (stand_.motor_tau_s > 0.0) {
            const double voltage =
                1.0 - stand_.sag_per_unit_s * x[charge] - stand_.battery_resistance * duty * x[rotor] * x[rotor];
            dx[rotor] = (duty * voltage - x[rotor]) / stand_.motor_tau_s;
            dx[second_rotor] = (second_target() - x[second_rotor]) / stand_.motor_tau_s;
        }
        const bool carried = contact_ != Contact::free || stand_.backlash_rad == 0.0;
        dx[play] = carried ? dx[angle] : 0.0;
        dx[asymmetric] = 0.0;
        if (stand_.tau_up_s > 0.0) {
            const double rest = curved(x[play]) - x[asymmetric];
            dx[asymmetric] = rest / (rest > 0.0 ? stand_.tau_up_s : stand_.tau_down_s);
        }
        dx[swing] = 0.0;
        dx[swing_speed] = 0.0;
        if (stand_.resonance_share != 0.0) {
            const double w = 2.0 * std::numbers::pi * stand_.resonance_hz;
            const double to = stand_.resonance_share * thrust(x, t) / spring_;
            dx[swing] = x[swing_speed];
            dx[swing_speed] = w * w * (to - x[swing]) - 2.0 * stand_.resonance_damping * w * x[swing_speed];
        }
        dx[lagged] = stand_.sensor_tau_s > 0.0 ? (before_lag(x) - x[lagged]) / stand_.sensor_tau_s : 0.0;
    }
    [[nodiscard]] double before_lag(const State& x) const {
        return (stand_.tau_up_s > 0.0 ? x[asymmetric] : curved(x[play])) + x[swing];
    }
    [[nodiscard]] Point point_at(double t, const State& x) const {
        return {
            t, x[angle], x[speed], rotor_of(x, t), x[charge], stand_.sensor_tau_s > 0.0 ? x[lagged] : before_lag(x)};
    }

    // What the bar does next, standing still.
    void choose_mode(double t) {
        const double net = torque(state_, t);
        if (state_[angle] >= stand_.upper_stop_rad && net >= -hold(false)) {
            mode_ = Mode::on_upper;
        } else if (state_[angle] <= stand_.lower_stop_rad && net <= hold(true)) {
            mode_ = Mode::on_lower;
        } else if (net > hold(true)) {
            mode_ = Mode::up;
        } else if (net < -hold(false)) {
            mode_ = Mode::down;
        } else {
            mode_ = Mode::stuck;
        }
    }
    [[nodiscard]] bool moves() const { return mode_ == Mode::up || mode_ == Mode::down; }

    // Above 0 from where the present mode no longer holds.
    [[nodiscard]] double leaving(const State& x, double t) const {
        switch (mode_) {
            case Mode::up:
                return std::max(-x[speed], x[angle] - stand_.upper_stop_rad);
            case Mode::down:
                return std::max(x[speed], stand_.lower_stop_rad - x[angle]);
            case Mode::stuck:
                return std::max(torque(x, t) - hold(true), -torque(x, t) - hold(false));
            case Mode::on_upper:
                return -torque(x, t) - hold(false);
            case Mode::on_lower:
                return torque(x, t) - hold(true);
        }
        return 0.0;
    }
    [[nodiscard]] double touching(const State& x) const {
        if (stand_.backlash_rad == 0.0 || contact_ != Contact::free) {
            return -1.0;
        }
        return std::fabs(x[angle] - x[play]) - 0.5 * stand_.backlash_rad;
    }
    [[nodiscard]] bool changes(const State& x, double t) const { return leaving(x, t) > 0.0 || touching(x) > 0.0; }

    void note(double t, EventKind kind, double at_speed) {
        motion_.events.push_back({t, kind, state_[angle], at_speed});
        if (motion_.events.size() > most_events) {
            throw glsum::Failure(glsum::Exit::check_failed,
                                 fmt::format("stand: more than {} events by {} s", most_events, t));
        }
    }

    // state_ is just beyond an event.
    void change(double t) {
        if (touching(state_) > 0.0) {
            contact_ = state_[angle] > state_[play] ? Contact::up : Contact::down;
        }
        if (!(leaving(state_, t) > 0.0)) {
            return;
        }
        const bool upward = mode_ == Mode::up;
        if (!moves()) {
            note(t, mode_ == Mode::stuck ? EventKind::breaks_loose : EventKind::leaves_stop, 0.0);
            // The torque that freed it says whereto.
            mode_ = torque(state_, t) > 0.0 ? Mode::up : Mode::down;
            return;
        }
        const double stop = upward ? stand_.upper_stop_rad : stand_.lower_stop_rad;
        if (upward ? state_[angle] > stop : state_[angle] < stop) {
            const double before = state_[speed];
            state_[angle] = stop;
            state_[speed] = -stand_.restitution * before;
            contact_ = Contact::free;
            note(t, EventKind::impact, before);
            if (std::fabs(state_[speed]) > rest_speed) {
                mode_ = upward ? Mode::down : Mode::up;
                return;
            }
            state_[speed] = 0.0;
            choose_mode(t);
            if (!moves()) {
                note(t, EventKind::rests, 0.0);
            }
            return;
        }
        contact_ = Contact::free;
        state_[speed] = 0.0;
        choose_mode(t);
        if (mode_ == Mode::stuck) {
            note(t, EventKind::sticks, 0.0);
        } else {
            note(t, moves() ? EventKind::reversal : EventKind::rests, 0.0);
        }
    }

    void advance(double from_s, double to_s, std::span<const double> times_s) {
        namespace odeint = boost::numeric::odeint;
        const auto system = [this](const State& x, State& dx, double t) { derive(x, dx, t); };
        double now_s = from_s;
        while (now_s < to_s) {
            if (state_[speed] == 0.0 && moves() == false) {
                choose_mode(now_s);
            }
            auto stepper = odeint::make_dense_output(1e-12, 1e-11, longest_step_s, odeint::runge_kutta_dopri5<State>());
            stepper.initialize(state_, now_s, std::min(1e-4, to_s - now_s));
            bool changed = false;
            while (!changed && now_s < to_s) {
                stepper.do_step(system);
                const double until_s = std::min(stepper.current_time(), to_s);
                State x{};
                const auto changes_at = [&](double t) {
                    stepper.calc_state(t, x);
                    return changes(x, t);
                };
                double stop_s = until_s;
                double last_s = now_s;
                for (int part = 1; part <= 4 && !changed; ++part) {
                    const double t = part == 4 ? until_s : now_s + (until_s - now_s) * part / 4.0;
                    if (changes_at(t)) {
                        // The mode holds at the one end and not at the other: halved down to 1e-13 s.
                        const auto bracket = boost::math::tools::bisect(
                            [&](double at) { return at > last_s && changes_at(at) ? 1.0 : -1.0; }, last_s, t,
                            [](double a, double b) { return b - a < 1e-13 || b - a < 4e-16 * b; });
                        stop_s = bracket.second;
                        changed = true;
                    }
                    last_s = t;
                }
                while (next_ < times_s.size() && times_s[next_] < stop_s) {
                    stepper.calc_state(times_s[next_], x);
                    motion_.points.push_back(point_at(times_s[next_++], x));
                }
                stepper.calc_state(stop_s, state_);
                now_s = stop_s;
            }
            if (changed) {
                change(now_s);
            }
        }
    }

    const Stand& stand_;
    double inertia_ = 0.0;
    double damping_ = 0.0;
    double spring_ = 0.0;
    State state_{};
    Mode mode_ = Mode::stuck;
    Contact contact_ = Contact::free;
    Piece piece_{0.0, 0.0, 0.0};
    bool disturbed_ = false;
    std::size_t next_ = 0;
    Motion motion_;
};

}  // namespace

Motion move(const Stand& stand, std::span<const Piece> pieces, const Start& start, std::span<const double> times_s) {
    check(stand, "stand");
    if (start.angle_rad < stand.lower_stop_rad || start.angle_rad > stand.upper_stop_rad) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("stand: expected a start between the stops at {} and {} rad, found {}",
                                         stand.lower_stop_rad, stand.upper_stop_rad, start.angle_rad));
    }
    return Bar(stand, start).run(pieces, times_s);
}

}  // namespace stand
