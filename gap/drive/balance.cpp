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
      drag_(scenario.forces.drag / (step_s * step_s)),
      linear_(forces_.angle_per_unit == 0.0 && forces_.cubic == 0.0 && !forces_.outflow && drag_ == 0.0 &&
              forces_.drag_of_speed == 0.0 && forces_.friction_share == 0.0 && forces_.cogging.empty()) {
    if (forces_.outflow) {
        power_ = 1.0 + forces_.outflow->curvature;
        bend_at_zero_ = std::pow(at_zero, power_);
        bend_at_reference_ = std::pow(1.0 + at_zero, power_) - bend_at_zero_;
        at_rest_ = bent(operating_);
    }
}

double Balance::increment(double forcing, double known, double y) const {
    const double net = forcing - known - resisting(y, 0.0);
    if (forces_.friction_of_speed) {
        return against_speed(net, y);
    }
    return against_motion(forcing, net, y);
}

double Balance::unbalanced(double forcing, double derivatives, double y, double e) const {
    const double net = forcing - derivatives - resisting(y, 0.0);
    const double way = forces_.friction_of_speed ? y + operating_ : e;
    const double of_load = forces_.friction_share * carried(forcing, y);
    const double up = net - forces_.friction_up - of_load;
    const double down = net + forces_.friction_down + of_load;
    if (way != 0.0) {
        return way > 0.0 ? up : down;
    }
    return up > 0.0 ? up : std::min(down, 0.0);
}

void Balance::advance(double y, double e) { travelled_ += step_s_ * (y + operating_ + 0.5 * e); }

double Balance::against_motion(double forcing, double net, double y) const {
    const double of_load = forces_.friction_share * carried(forcing, y);
    if (net > forces_.friction_up + of_load) {
        return solve(net - forces_.friction_up - of_load, y, forces_.friction_share);
    }
    if (net < -forces_.friction_down - of_load) {
        return solve(net + forces_.friction_down + of_load, y, -forces_.friction_share);
    }
    return forces_.friction_up == 0.0 && forces_.friction_down == 0.0 && of_load == 0.0 ? solve(net, y, 0.0) : 0.0;
}

// Friction in one direction if that is where the step ends, in the other one likewise; between both it stands.
double Balance::against_speed(double net, double y) const {
    const double speed = y + operating_;
    const double up = solve(net - forces_.friction_up, y, 0.0);
    if (speed + up > 0.0) {
        return up;
    }
    const double down = solve(net + forces_.friction_down, y, 0.0);
    return speed + down < 0.0 ? down : -speed;
}

double Balance::carried(double forcing, double y) const {
    return std::fabs(forcing) + std::fabs(constant_ * restoring(y));
}

double Balance::solve(double left, double y, double share) const {
    const double stiffness = mass_ + constant_ * slope(y) + 2.0 * forces_.drag_of_speed * std::fabs(y + operating_);
    if (linear_) {
        return left / stiffness;
    }
    if (left == 0.0) {
        return 0.0;
    }
    const double at_rest = resisting(y, 0.0);
    const double load = std::fabs(constant_ * restoring(y));
    const auto miss = [&](double e) {
        const double more_load = share == 0.0 ? 0.0 : std::fabs(constant_ * restoring(y + e)) - load;
        return resisting(y, e) - at_rest + share * more_load - left;
    };
    const auto slope_of_miss = [&](double e) {
        const double of_load =
            share == 0.0 ? 0.0 : std::copysign(constant_ * slope(y + e), constant_ * restoring(y + e));
        return slope_of_resisting(y, e) + share * of_load;
    };
    // A force that gives way, as a sine does behind its top, may have its balance farther off than its slope says:
    // outwards until it is passed, then by Newton's steps as long as these stay within.
    double near = 0.0;
    double far = left / (stiffness > 0.0 ? stiffness : mass_);
    constexpr int doublings = 60;
    for (int i = 0; i < doublings && miss(far) * left < 0.0; ++i) {
        near = far;
        far *= 2.0;
    }
    if (!(miss(far) * left >= 0.0)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    double e = far;
    constexpr int most_steps = 80;
    for (int i = 0; i < most_steps; ++i) {
        const double value = miss(e);
        (value * left < 0.0 ? near : far) = e;
        double next = e - value / slope_of_miss(e);
        if (!((next - near) * (next - far) < 0.0)) {
            next = value == 0.0 ? e : 0.5 * (near + far);
        }
        const double by = next - e;
        e = next;
        if (std::fabs(by) <= 1e-12 * std::fabs(e) + 1e-15 * std::fabs(y)) {
            break;
        }
    }
    return e;
}

double Balance::resisting(double y, double e) const {
    double force = mass_ * e + constant_ * restoring(y + e) + drag_ * e * std::fabs(e) +
                   forces_.drag_of_speed * (squared(y + e + operating_) - squared(operating_));
    for (const Cogging& cogging : forces_.cogging) {
        const double at = cogging.of_speed ? travelled_ + step_s_ * (y + operating_ + 0.5 * e) : y + e + operating_;
        force -= cogging.size * std::sin(2.0 * std::numbers::pi * cogging.per_unit * at + cogging.phase_rad);
    }
    return force;
}

double Balance::slope_of_resisting(double y, double e) const {
    double rise = mass_ + constant_ * slope(y + e) + 2.0 * drag_ * std::fabs(e) +
                  2.0 * forces_.drag_of_speed * std::fabs(y + e + operating_);
    for (const Cogging& cogging : forces_.cogging) {
        const double at = cogging.of_speed ? travelled_ + step_s_ * (y + operating_ + 0.5 * e) : y + e + operating_;
        const double rate = 2.0 * std::numbers::pi * cogging.per_unit;
        rise -=
            cogging.size * rate * (cogging.of_speed ? 0.5 * step_s_ : 1.0) * std::cos(rate * at + cogging.phase_rad);
    }
    return rise;
}

double Balance::restoring(double y) const {
    if (forces_.outflow) {
        return bent(y + operating_) - at_rest_ + forces_.cubic * y * y * y;
    }
    const double kappa = forces_.angle_per_unit;
    return (kappa == 0.0 ? y : std::sin(kappa * y) / kappa) + forces_.cubic * y * y * y;
}

double Balance::slope(double y) const {
    const double of_cube = 3.0 * forces_.cubic * y * y;
    if (forces_.outflow) {
        const double share = std::fabs(y + operating_) / forces_.outflow->reference;
        return power_ * std::pow(share + at_zero, power_ - 1.0) / bend_at_reference_ + of_cube;
    }
    const double kappa = forces_.angle_per_unit;
    return (kappa == 0.0 ? 1.0 : std::cos(kappa * y)) + of_cube;
}

double Balance::bent(double level) const {
    const double share = std::fabs(level) / forces_.outflow->reference;
    const double of_reference = (std::pow(share + at_zero, power_) - bend_at_zero_) / bend_at_reference_;
    return std::copysign(forces_.outflow->reference * of_reference, level);
}

}  // namespace gap
