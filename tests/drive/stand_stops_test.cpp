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

}  // namespace
