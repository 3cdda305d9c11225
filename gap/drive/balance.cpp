#include "gap/drive/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gap {
namespace {

double squared(double speed) { return speed * std::fabs(speed); }

// Of an outflow, in shares of the reference: added to the level.
constexpr double at_zero = 0.01;

}  // namespace

Balance::Balance(const Scenario& scenario, double mass, double constant, double step_s)
    : forces_(scenario.forces),
      operating_(scenario.operating_output),
      mass_(mass),
      constant_(constant),
      step_s_(step_s),
      freely_(1.0 / (mass + constant)),
      drag_(scenario.forces.drag / (step_s * step_s)),
      linear_(forces_.angle_per_unit == 0.0 && forces_.cubic == 0.0 && !forces_.outflow && drag_ == 0.0 &&
              forces_.drag_of_speed == 0.0 && forces_.friction_share == 0.0 && forces_.cogging.empty()),
      slides_(linear_ && forces_.friction_up == 0.0 && forces_.friction_down == 0.0) {
    if (forces_.outflow) {
        power_ = 1.0 + forces_.outflow->curvature;
        bend_at_zero_ = std::pow(at_zero, power_);
        bend_at_reference_ = std::pow(1.0 + at_zero, power_) - bend_at_zero_;
        at_rest_ = std::copysign(
            outflow_of(std::pow(std::fabs(operating_) / forces_.outflow->reference + at_zero, power_)), operating_);
    }
}

double Balance::of_forces(double forcing, double known, double y) const {
    const Force at_rest = linear_ ? Force{constant_ * y, mass_ + constant_} : resisting(y, 0.0, 0.0);
    const double net = forcing - known - at_rest.value;
    return forces_.friction_of_speed ? against_speed(net, y, at_rest) : against_motion(forcing, net, y, at_rest);
}

double Balance::unbalanced(double forcing, double derivatives, double y, double e) const {
    const double net = forcing - derivatives - resisting(y, 0.0, 0.0).value;
    const double way = forces_.friction_of_speed ? y + operating_ : e;
    const double of_load = friction_of_load(forcing, y);
    const double up = net - forces_.friction_up - of_load;
    const double down = net + forces_.friction_down + of_load;
    if (way != 0.0) {
        return way > 0.0 ? up : down;
    }
    return up > 0.0 ? up : std::min(down, 0.0);
}

double Balance::against_motion(double forcing, double net, double y, const Force& at_rest) const {
    const double of_load = friction_of_load(forcing, y);
    if (net > forces_.friction_up + of_load) {
        return solve(net - forces_.friction_up - of_load, y, at_rest, forces_.friction_share);
    }
    if (net < -forces_.friction_down - of_load) {
        return solve(net + forces_.friction_down + of_load, y, at_rest, -forces_.friction_share);
    }
    const bool slides = forces_.friction_up == 0.0 && forces_.friction_down == 0.0 && of_load == 0.0;
    return slides ? solve(net, y, at_rest, 0.0) : 0.0;
}

// Friction in one direction if that is where the step ends, in the other one likewise; between both it stands.
double Balance::against_speed(double net, double y, const Force& at_rest) const {
    const double speed = y + operating_;
    const double up = solve(net - forces_.friction_up, y, at_rest, 0.0);
    if (speed + up > 0.0) {
        return up;
    }
    const double down = solve(net + forces_.friction_down, y, at_rest, 0.0);
    return speed + down < 0.0 ? down : -speed;
}

double Balance::friction_of_load(double forcing, double y) const {
    if (forces_.friction_share == 0.0) {
        return 0.0;
    }
    return forces_.friction_share * (std::fabs(forcing) + std::fabs(constant_ * restoring(y).value));
}

double Balance::solve(double left, double y, const Force& unloaded, double share) const {
    if (linear_) {
        return left * freely_;
    }
    if (left == 0.0) {
        return 0.0;
    }
    const Force at_rest = share == 0.0 ? unloaded : resisting(y, 0.0, share);
    // Newton's steps, as long as these stay within what is known of the balance: beyond `near`, and, once it was
    // passed, before `far`. A force that gives way, as a sine does behind its top, has it farther off than its slope
    // says.
    double near = 0.0;
    double far = 0.0;
    bool passed = false;
    double e = left / (at_rest.slope > 0.5 * mass_ ? at_rest.slope : mass_);
    double e_before = 0.0;
    double slope_before = at_rest.slope;
    constexpr int most_steps = 140;
    for (int i = 0; i < most_steps; ++i) {
        const Force now = resisting(y, e, share);
        const double miss = now.value - at_rest.value - left;
        if (!std::isfinite(miss)) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        const bool before = miss * left < 0.0;
        passed = passed || !before;
        (before ? near : far) = e;
        double next = e - miss / now.slope;
        const bool sensible = passed ? (next - near) * (next - far) < 0.0
                                     : (next - near) * left > 0.0 && std::fabs(next) <= 2.0 * std::fabs(e);
        if (!sensible) {
            next = miss == 0.0 ? e : passed ? 0.5 * (near + far) : 2.0 * e;
        }
        const double by = next - e;
        const double missed = std::fabs(miss / left);
        // What Newton's step leaves: half of how the slope changes times its square.
        const double bend = std::fabs((now.slope - slope_before) / (e - e_before));
        const bool leaves_nothing = sensible && (passed || missed <= 1e-3) && std::fabs(by) <= 1e-4 * std::fabs(e) &&
                                    bend * by * by <= 1e-12 * std::fabs(now.slope * e);
        e_before = e;
        slope_before = now.slope;
        e = next;
        const double last = sensible ? 1e-7 : 1e-12;
        if (leaves_nothing ||
            ((passed || missed <= 1e-6) && std::fabs(by) <= last * std::fabs(e) + 1e-15 * std::fabs(y))) {
            return e;
        }
    }
    return passed ? e : std::numeric_limits<double>::quiet_NaN();
}

Balance::Force Balance::resisting(double y, double e, double share) const {
    const Force spring = restoring(y + e);
    const double speed = y + e + operating_;
    Force force{
        mass_ * e + constant_ * spring.value + drag_ * squared(e) +
            forces_.drag_of_speed * (squared(speed) - squared(operating_)),
        mass_ + constant_ * spring.slope + 2.0 * drag_ * std::fabs(e) + 2.0 * forces_.drag_of_speed * std::fabs(speed)};
    if (share != 0.0) {
        const double load = constant_ * spring.value;
        force.value += share * std::fabs(load);
        force.slope += share * std::copysign(1.0, load) * constant_ * spring.slope;
    }
    for (const Cogging& cogging : forces_.cogging) {
        const double at = cogging.of_speed ? travelled_ + step_s_ * (y + operating_ + 0.5 * e) : speed;
        const double rate = 2.0 * std::numbers::pi * cogging.per_unit;
        const double phase = rate * at + cogging.phase_rad;
        double sine;
        double cosine;
        ::sincos(phase, &sine, &cosine);
        force.value -= cogging.size * sine;
        force.slope -= cogging.size * rate * (cogging.of_speed ? 0.5 * step_s_ : 1.0) * cosine;
    }
    return force;
}

Balance::Force Balance::restoring(double y) const {
    const double cube = forces_.cubic * y * y;
    const double kappa = forces_.angle_per_unit;
    if (forces_.outflow) {
        const double level = y + operating_;
        const double from_zero = std::fabs(level) / forces_.outflow->reference + at_zero;
        const double power = std::pow(from_zero, power_);
        return {std::copysign(outflow_of(power), level) - at_rest_ + cube * y,
                power_ * power / from_zero / bend_at_reference_ + 3.0 * cube};
    }
    if (kappa != 0.0) {
        return {std::sin(kappa * y) / kappa + cube * y, std::cos(kappa * y) + 3.0 * cube};
    }
    return {y + cube * y, 1.0 + 3.0 * cube};
}

double Balance::outflow_of(double power) const {
    return forces_.outflow->reference * (power - bend_at_zero_) / bend_at_reference_;
}

}  // namespace gap
