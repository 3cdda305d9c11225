// The virtual stand where a formula has one more factor than usual, and where a size is only just allowed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "drive/stand/chance.hpp"
#include "drive/stand/experiment.hpp"
#include "drive/stand/motion.hpp"
#include "drive/stand/stand.hpp"
#include "tests/drive/stand_rig.hpp"

namespace {

using stand::EventKind;
using test::bare;
using test::message_of;
using testing::HasSubstr;

double natural(const stand::Stand& built) { return std::sqrt(built.gravity_n_m / built.inertia_kg_m2); }

// Nothing but inertia: what pushes it is its speed, summed up.
stand::Stand loose() {
    stand::Stand built = bare();
    built.gravity_n_m = 0.0;
    return built;
}
// The speed after 2 s at one duty, as the constant thrust that would give it.
double pushed(const stand::Stand& built, double duty) {
    const stand::Piece held{0.0, duty, 0.0};
    const auto points = stand::move(built, std::vector{held}, {}, std::vector{2.0}).points;
    return points.front().speed_rad_per_s * built.inertia_kg_m2 / built.full_torque_n_m() / 2.0;
}

TEST(StandEdges, ThrustBendsAtItsReferenceAndGrows) {
    stand::Stand built = loose();
    built.thrust_curvature = 0.25;
    built.thrust_reference = 0.5;
    EXPECT_NEAR(pushed(built, 0.3), 0.3 * (0.75 + 0.25 * 0.3 / 0.5), 1e-10);
    // A growth of d a second is of d t / 2 in the mean.
    built.drift_per_s = 0.1;
    EXPECT_NEAR(pushed(built, 0.3), 0.3 * (0.75 + 0.25 * 0.3 / 0.5) * 1.1, 1e-10);
}

TEST(StandEdges, FrictionUpwardIsNotThatDownward) {
    stand::Stand built = loose();
    built.friction = 0.01;
    built.friction_up = 0.02;
    built.friction_down = 0.05;
    EXPECT_NEAR(pushed(built, 0.2), 0.2 - 0.01 - 0.02, 1e-10);
    EXPECT_NEAR(pushed(built, -0.2), -0.2 + 0.01 + 0.05, 1e-10);
}

// kappa y is the angle of a pendulum that swings as any other.
TEST(StandEdges, WeightIsOfTheAngleTimesItsFactor) {
    stand::Stand built = bare();
    built.sine_per_unit = 2.0;
    const auto motion = stand::move(built, {}, {1.0, 0.0}, test::times(4.0, 0.5));
    const double half_s = 2.0 / natural(built) * boost::math::ellint_1(std::sin(0.5 * 2.0 * 1.0));
    const auto reversals = test::times_of(motion.events, EventKind::reversal);
    ASSERT_GE(reversals.size(), 1U);
    EXPECT_NEAR(reversals.front(), half_s, 1e-8);
}

// A bar that is held at 0.4 reads y ((1 - c) + c y / reference), from the first moment on, whatever lags behind it.
TEST(StandEdges, ReadingsBendAtTheirReference) {
    stand::Stand built = bare();
    built.friction = 1.0;
    built.output_curvature = 0.25;
    built.output_reference = 0.5;
    const double reading = 0.4 * (0.75 + 0.25 * 0.4 / 0.5);
    const auto read = [&] { return stand::move(built, {}, {0.4, 0.0}, std::vector{0.0, 1.0}).points; };
    for (const auto& point : read()) {
        EXPECT_DOUBLE_EQ(point.reading_rad, reading);
    }
    built.tau_up_s = 0.3;
    built.tau_down_s = 0.2;
    for (const auto& point : read()) {
        EXPECT_DOUBLE_EQ(point.reading_rad, reading);
    }
    built.sensor_tau_s = 0.5;
    for (const auto& point : read()) {
        EXPECT_DOUBLE_EQ(point.reading_rad, reading);
    }
}

// A bar that is pushed evenly has turned by a t^2 / 2; a lag of the sensor shows a (t^2 / 2 - tau t + tau^2 (1 - e)).
TEST(StandEdges, ASensorLagsByItsTimeConstant) {
    stand::Stand built = loose();
    built.sensor_tau_s = 0.5;
    const stand::Piece held{0.0, 0.2, 0.0};
    const auto point = stand::move(built, std::vector{held}, {}, std::vector{1.5}).points.front();
    const double a = 0.2 * built.full_torque_n_m() / built.inertia_kg_m2;
    EXPECT_NEAR(point.angle_rad, a * 0.5 * 1.5 * 1.5, 1e-8);
    EXPECT_NEAR(point.reading_rad, a * (0.5 * 1.5 * 1.5 - 0.5 * 1.5 + 0.25 * -std::expm1(-3.0)), 1e-7);
}

// Behind the rotor's lag the battery still weakens: tau n' = u (1 - s u t) - n.
TEST(StandEdges, ALaggingMotorFollowsABatteryThatSags) {
    stand::Stand built = loose();
    built.motor_tau_s = 0.5;
    built.sag_per_unit_s = 0.125;
    const stand::Piece held{0.0, 0.4, 0.0};
    const auto point = stand::move(built, std::vector{held}, {}, std::vector{2.0}).points.front();
    const double risen = -std::expm1(-4.0);
    EXPECT_NEAR(point.rotor, 0.4 * risen - 0.125 * 0.16 * (2.0 - 0.5 * risen), 1e-9);
}

// The second motor lags likewise: what it has pushed is what was asked of it, less what its rotor still holds.
TEST(StandEdges, TheSecondMotorLagsLikeTheFirst) {
    stand::Stand built = loose();
    built.motor_tau_s = 0.25;
    built.disturbance_size = 0.3;
    built.disturbance_from_s = 0.5;
    built.disturbance_to_s = 1.5;
    const double left = 0.3 * -std::expm1(-4.0) * std::exp(-2.0);
    EXPECT_NEAR(pushed(built, 0.0) * 2.0, -(0.3 - 0.25 * left), 1e-9);
}

// A thrust that is more than the friction of its own direction moves the bar at once, and nothing is told of it; one
// that is less leaves it.
TEST(StandEdges, ABarAtRestKnowsTheFrictionOfEachDirection) {
    stand::Stand built = loose();
    built.friction_up = 0.01;
    built.friction_down = 0.05;
    for (const double side : {1.0, -1.0}) {
        const stand::Piece held{0.0, side * 0.03, 0.0};
        const auto motion = stand::move(built, std::vector{held}, {}, std::vector{1.0});
        EXPECT_TRUE(motion.events.empty()) << side;
        EXPECT_EQ(motion.points.front().speed_rad_per_s > 0.0, side > 0.0);
        EXPECT_GE(motion.points.front().speed_rad_per_s, 0.0);
        std::swap(built.friction_up, built.friction_down);
        const auto other = stand::move(built, std::vector{held}, {}, std::vector{1.0});
        EXPECT_TRUE(other.events.empty()) << side;
        EXPECT_EQ(other.points.front().speed_rad_per_s < 0.0, side < 0.0);
        std::swap(built.friction_up, built.friction_down);
    }
    // On its lower stop as well.
    built.lower_stop_rad = 0.0;
    const stand::Piece held{0.0, 0.03, 0.0};
    EXPECT_TRUE(stand::move(built, std::vector{held}, {}, std::vector{1.0}).events.empty());
}

// Without any friction or push a bar stands still, on its stop where it lies there, until something moves it.
TEST(StandEdges, ABarThatNothingMovesStands) {
    stand::Stand built = loose();
    const std::vector<stand::Piece> pieces{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.2}};
    for (const bool on_its_stop : {false, true}) {
        built.lower_stop_rad = on_its_stop ? 0.0 : -1.0;
        const auto motion = stand::move(built, pieces, {}, std::vector{0.5, 1.5});
        ASSERT_EQ(motion.events.size(), 1U);
        EXPECT_EQ(motion.events.front().kind, on_its_stop ? EventKind::leaves_stop : EventKind::breaks_loose);
        EXPECT_NEAR(motion.events.front().time_s, 1.0, 1e-9);
        EXPECT_EQ(motion.points.front().speed_rad_per_s, 0.0);
    }
}

TEST(StandEdges, NothingIsToldFromBehindTheLastTime) {
    const stand::Stand built = bare();
    const std::vector<stand::Piece> pieces{{0.0, 0.0, 0.0}, {20.0, 0.5, 0.0}};
    const auto motion = stand::move(built, pieces, {0.5, 0.0}, std::vector{0.0, 2.0});
    ASSERT_EQ(motion.events.size(), 1U);  // half a period is 1.28 s
    EXPECT_NEAR(motion.events.front().time_s, 3.14159265358979 / natural(built), 1e-8);
}

// Of an impact at amplitude times w a speed of up to 1e-6 rad/s is left to nothing.
TEST(StandEdges, SlowImpactsEndTheBouncing) {
    stand::Stand built = bare();
    built.lower_stop_rad = 0.0;
    built.restitution = 0.5;
    const auto kinds = [&](double left_rad_per_s) {
        const double from_rad = left_rad_per_s / built.restitution / natural(built);
        std::vector<EventKind> found;
        for (const auto& event : stand::move(built, {}, {from_rad, 0.0}, std::vector{0.0, 1.0}).events) {
            found.push_back(event.kind);
        }
        return found;
    };
    EXPECT_THAT(kinds(1.005e-6), testing::ElementsAre(EventKind::impact));
    EXPECT_THAT(kinds(0.995e-6), testing::ElementsAre(EventKind::impact, EventKind::rests));
    const auto resting = stand::move(built, {}, {1e-6 / natural(built), 0.0}, std::vector{1.0}).points.front();
    EXPECT_EQ(resting.speed_rad_per_s, 0.0);
    EXPECT_EQ(resting.angle_rad, 0.0);
}

TEST(StandEdges, EffectsAreNeitherPartsNorWhatOnlyShapesThem) {
    stand::Stand built = bare();
    built.inertia_kg_m2 = 0.7;
    built.restitution = 0.5;
    built.resonance_hz = 3.0;
    EXPECT_THAT(stand::present_effects(built), testing::IsEmpty());
    built.upper_stop_rad = 1.0;
    built.lower_stop_rad = -1.0;
    built.backlash_rad = 0.1;
    EXPECT_THAT(stand::present_effects(built), testing::ElementsAre("end_stop", "backlash"));
    EXPECT_THAT(message_of([&] { stand::remove_effect(built, "backlahs"); }), HasSubstr("the nearest is backlash"));
    const std::vector<std::string> unknown{"end_stops"};
    EXPECT_THAT(message_of([&] { stand::keep_effects(built, unknown); }), HasSubstr("the nearest is end_stop"));
}

TEST(StandEdges, SizesAreHeldAgainstEachOtherAtTheirLimits) {
    const auto said = [](double stand::Stand::*size, double value) {
        stand::Stand built = bare();
        built.lower_stop_rad = -1.0;
        built.interval_s = 0.125;
        built.*size = value;
        return message_of([&] { stand::check(built, "my.toml"); });
    };
    EXPECT_EQ(said(&stand::Stand::friction, 10.0), "no failure");
    EXPECT_THAT(said(&stand::Stand::friction, 10.1), HasSubstr("my.toml: coulomb_friction.force: expected 0 to 10"));
    EXPECT_THAT(said(&stand::Stand::friction, -0.1), HasSubstr("found -0.1"));
    EXPECT_THAT(said(&stand::Stand::friction, std::nan("")), HasSubstr("found nan"));
    // A lag is none, or 1e-4 s and longer.
    EXPECT_EQ(said(&stand::Stand::sensor_tau_s, 0.0), "no failure");
    EXPECT_EQ(said(&stand::Stand::sensor_tau_s, 1e-4), "no failure");
    EXPECT_THAT(said(&stand::Stand::sensor_tau_s, 0.9999e-4), HasSubstr("expected 0 or at least 0.0001 s"));
    // Stops with room between them, stamps less than half an interval beside their places.
    EXPECT_EQ(said(&stand::Stand::upper_stop_rad, -0.999), "no failure");
    EXPECT_THAT(said(&stand::Stand::upper_stop_rad, -1.0), HasSubstr("expected the lower stop below the upper"));
    EXPECT_EQ(said(&stand::Stand::spread_s, 0.0624), "no failure");
    EXPECT_THAT(said(&stand::Stand::spread_s, 0.0625), HasSubstr("expected less than half of the interval"));
    EXPECT_THAT(said(&stand::Stand::tau_down_s, 0.1), HasSubstr("expected both lags or none"));
    // What swings by a share of the weight's deflection needs a weight.
    stand::Stand built = bare();
    built.resonance_share = 0.5;
    EXPECT_EQ(message_of([&] { stand::check(built, "s"); }), "no failure");
    built.gravity_n_m = 0.0;
    EXPECT_THAT(message_of([&] { stand::check(built, "s"); }), HasSubstr("structural_resonance: expected gravity"));
    // A disturbance ends later than it begins, where there is one.
    built = bare();
    built.disturbance_from_s = built.disturbance_to_s = 2.0;
    EXPECT_EQ(message_of([&] { stand::check(built, "s"); }), "no failure");
    built.disturbance_size = 0.5;
    EXPECT_THAT(message_of([&] { stand::check(built, "s"); }), HasSubstr("expected from_s below to_s, found 2 and 2"));
}

TEST(StandEdges, ItsLinearModelWaitsForBothDelays) {
    stand::Stand built = bare();
    built.delay_s = 0.25;
    built.extra_delay_s = 0.125;
    EXPECT_THAT(stand::linear_model_json(built), HasSubstr("\"delay_s\": 0.375"));
}

// A command counts from 1e-9 s before its time on: stamps are sums of rounded steps.
TEST(StandEdges, CommandsCountFromTheirTimesOn) {
    const stand::Stand built = loose();
    const auto duties = [&](stand::Experiment asked) {
        asked.duty = 0.5;
        asked.until_s = 0.5;
        return stand::run(built, asked, 3).duty;
    };
    EXPECT_EQ(duties({.name = "pulse", .off_s = 0.25 + 0.995e-9})[25], 0.0);
    EXPECT_EQ(duties({.name = "pulse", .off_s = 0.25 + 1.005e-9})[25], 0.5);
    EXPECT_EQ(duties({.name = "pulse", .off_s = 1e-9})[0], 0.0);
    // Bits of a shift register, x^10 + x^7 + 1, that the fifth stream of the seed fills with 1 to 1023.
    unsigned state = static_cast<unsigned>(stand::Chance(3, 5).word() % 1023U) + 1U;
    std::vector<double> bits;
    for (int i = 0; i < 40; ++i) {
        const unsigned bit = ((state >> 9U) ^ (state >> 6U)) & 1U;
        state = (state << 1U | bit) & 1023U;
        bits.push_back(bit != 0 ? 0.5 : 0.0);
    }
    const auto on_time = duties({.name = "prbs", .bit_s = 0.01});
    EXPECT_EQ(std::vector(on_time.begin(), on_time.begin() + 40), bits);
    const auto changed =
        static_cast<std::size_t>(std::adjacent_find(bits.begin(), bits.end(), std::not_equal_to<>()) - bits.begin()) +
        1;
    const double stamp_s = 0.01 * static_cast<double>(changed);
    const auto shifted = [&](double by_s) {
        return duties({.name = "prbs", .bit_s = (stamp_s + by_s) / static_cast<double>(changed)})[changed];
    };
    EXPECT_EQ(shifted(0.995e-9), bits[changed]);
    EXPECT_EQ(shifted(1.005e-9), bits[changed - 1]);
}

TEST(StandEdges, ARecordHasUpToAMillionSteps) {
    const stand::Experiment longest{.until_s = 1e6 / 128.0};
    EXPECT_EQ(message_of([&] { stand::check(longest, 1.0 / 128.0); }), "no failure");
    EXPECT_THAT(message_of([&] { stand::check(longest, 1.0 / 128.01); }), HasSubstr("10^6 samples"));
    stand::Stand built = loose();
    built.interval_s = 0.0;
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {}, 1); }),
                HasSubstr("stand: interval_s: expected 0.0001 to 10"));
}

}  // namespace
