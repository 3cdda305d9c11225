// A bar that is pressed onto a stop rests there, on either side: one impact, and nothing behind it.
#include <gtest/gtest.h>

#include <vector>

#include "drive/stand/motion.hpp"

namespace {

using stand::EventKind;

TEST(StandStops, ABarThatIsPressedOntoAStopRestsThere) {
    for (const double side : {1.0, -1.0}) {
        for (const double friction : {0.0, 0.002}) {
            stand::Stand built;
            built.restitution = 0.0;
            built.friction = friction;
            built.lower_stop_rad = side > 0.0 ? 0.2 : -1.0;
            built.upper_stop_rad = side > 0.0 ? 1.0 : -0.2;
            std::vector<double> times_s;
            for (int k = 0; k <= 200; ++k) {
                times_s.push_back(0.05 * k);
            }
            const stand::Motion motion = stand::move(built, {}, {0.5 * side, 0.0}, times_s);
            ASSERT_EQ(motion.events.size(), 2U) << side << ' ' << friction;
            EXPECT_EQ(motion.events[0].kind, EventKind::impact);
            EXPECT_EQ(motion.events[1].kind, EventKind::rests);
            for (const stand::Point& point : motion.points) {
                if (point.time_s > motion.events[1].time_s) {
                    ASSERT_EQ(point.angle_rad, 0.2 * side) << point.time_s;
                    ASSERT_EQ(point.speed_rad_per_s, 0.0) << point.time_s;
                } else {
                    ASSERT_GE(point.angle_rad * side, 0.2) << point.time_s;
                }
            }
        }
    }
}

// Thrust that rises from nothing frees the bar where it is as large as weight and stiction, which differ upward and
// downward: from the lower stop, from the upper one, and from where nothing but friction holds it.
TEST(StandStops, ABarLeavesWhereThrustHoldsWeightAndStiction) {
    stand::Stand built;
    built.motor_tau_s = 0.0;
    built.thrust_curvature = 0.0;
    built.sag_per_unit_s = 0.0;
    built.battery_resistance = 0.0;
    built.sine_per_unit = 0.0;
    built.friction = 0.02;
    built.friction_up = 0.01;
    built.stiction = 1.5;
    const double weight = 0.2 * built.gravity_n_m / built.full_torque_n_m();
    constexpr double slope_per_s = 0.05;
    for (const double side : {1.0, -1.0}) {
        for (const bool on_a_stop : {true, false}) {
            built.lower_stop_rad = on_a_stop && side > 0.0 ? 0.2 : -1.0;
            built.upper_stop_rad = on_a_stop && side < 0.0 ? -0.2 : 1.0;
            const stand::Piece rising{0.0, 0.0, side * slope_per_s};
            const double from = on_a_stop ? 0.2 * side : 0.0;
            const stand::Motion motion = stand::move(built, std::vector{rising}, {from, 0.0}, std::vector{0.0, 2.0});
            const double stiction = 1.5 * (side > 0.0 ? 0.03 : 0.02);
            ASSERT_FALSE(motion.events.empty());
            EXPECT_EQ(motion.events[0].kind, on_a_stop ? EventKind::leaves_stop : EventKind::breaks_loose);
            EXPECT_NEAR(motion.events[0].time_s, ((on_a_stop ? weight : 0.0) + stiction) / slope_per_s, 1e-9) << side;
            EXPECT_EQ(motion.events[0].angle_rad, from);
            EXPECT_GT(motion.points.back().speed_rad_per_s * side, 0.0);
        }
    }
}

}  // namespace
