// The equation of motion over one step: what moves, resists, sticks and pulls back, solved together.
#pragma once

#include "gap/drive/scenario.hpp"

namespace gap {

class Balance {
public:
    /// \param mass      the newest increment's weight in the model's derivatives
    /// \param constant  a_0
    Balance(const Scenario& scenario, double mass, double constant, double step_s);

    /// The increment e at which the forces balance:
    ///   forcing - known - mass e - a_0 restoring(y + e) - drag e |e| / h^2 - drag_of_speed (y + e) |y + e| + cogging(y
    ///   + e) - friction = 0.
    /// Of several the first in the direction in which it is drawn. \param known  of the derivatives, what past
    /// increments make \param y  before the step, without the operating point. Not a number where nothing balances.
    [[nodiscard]] double increment(double forcing, double known, double y) const {
        return slides_ ? (forcing - known - constant_ * y) * freely_ : of_forces(forcing, known, y);
    }

    /// The force that nothing balances where a motion of even increments e at y goes over into that of the scenario.
    /// \param derivatives  of the even motion
    [[nodiscard]] double unbalanced(double forcing, double derivatives, double y, double e) const;

    /// The step was made: from y by e.
    void advance(double y, double e) { travelled_ += step_s_ * (y + operating_ + 0.5 * e); }

private:
    // A force, and how it grows with the place.
    struct Force {
        double value;
        double slope;
    };
    [[nodiscard]] double of_forces(double forcing, double known, double y) const;
    // Forces beside friction that the place y + e and the increment e make, against motion upwards, and a share of the
    // load that the spring is.
    [[nodiscard]] Force resisting(double y, double e, double share) const;
    [[nodiscard]] Force restoring(double y) const;
    // \param power  of a level, in shares of the reference and beyond `at_zero`
    [[nodiscard]] double outflow_of(double power) const;
    [[nodiscard]] double friction_of_load(double forcing, double y) const;
    // \param at_rest  resisting(y, 0, 0)
    [[nodiscard]] double against_motion(double forcing, double net, double y, const Force& at_rest) const;
    [[nodiscard]] double against_speed(double net, double y, const Force& at_rest) const;
    // e where resisting(y, e, share) - resisting(y, 0, share) = left. \param unloaded  resisting(y, 0, 0)
    [[nodiscard]] double solve(double left, double y, const Force& unloaded, double share) const;

    const Forces& forces_;
    double operating_;
    double mass_;
    double constant_;
    double step_s_;
    double freely_;  // what a force moves where nothing resists but the model's derivatives and its spring
    double drag_;
    double travelled_ = 0.0;  // the integral of the output
    bool linear_;
    bool slides_;         // nor does friction
    double power_ = 1.0;  // of an outflow
    double bend_at_zero_ = 0.0;
    double bend_at_reference_ = 1.0;  // less that
    double at_rest_ = 0.0;            // what flows out at the operating point
};

}  // namespace gap
