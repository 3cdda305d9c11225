// The virtual stand against what mechanics says in closed form.
#include "drive/stand/stand.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <numbers>

#include "drive/model_file.hpp"
#include "drive/response.hpp"
#include "drive/stand/experiment.hpp"
#include "drive/stand/motion.hpp"
#include "tests/drive/stand_rig.hpp"

namespace {

using stand::Event;
using stand::EventKind;
using test::bare;
using test::times;
using test::times_of;

double natural(const stand::Stand& built) { return std::sqrt(built.gravity_n_m / built.inertia_kg_m2); }

TEST(Stand, WithoutFrictionItsEnergyStaysAndItsPeriodIsTheEllipticIntegral) {
    stand::Stand built = bare();
    built.sine_per_unit = 1.0;
    const double from = 2.0;
    const auto motion = stand::move(built, {}, {from, 0.0}, times(60.0, 0.01));
    for (const stand::Point& point : motion.points) {
        const double energy = 0.5 * built.inertia_kg_m2 * point.speed_rad_per_s * point.speed_rad_per_s -
                              built.gravity_n_m * std::cos(point.angle_rad);
        ASSERT_NEAR(energy, -built.gravity_n_m * std::cos(from), 1e-9 * built.gravity_n_m) << point.time_s;
    }
    const double period = 4.0 / natural(built) * boost::math::ellint_1(std::sin(0.5 * from));
    const auto reversals = times_of(motion.events, EventKind::reversal);
    ASSERT_GE(reversals.size(), 20U);
    for (std::size_t i = 0; i < reversals.size(); ++i) {
        ASSERT_NEAR(reversals[i], 0.5 * period * static_cast<double>(i + 1), 1e-7) << i;
    }
}

TEST(Stand, BouncesLeaveTheShareOfTheSpeedThatTheRestitutionSays) {
    stand::Stand built = bare();
    built.lower_stop_rad = 0.0;
    built.restitution = 0.6;
    const auto motion = stand::move(built, {}, {0.5, 0.0}, times(20.0, 0.1));
    const double w = natural(built);
    double impact_s = 0.5 * std::numbers::pi / w;
    double speed = -0.5 * w;
    std::size_t impacts = 0;
    for (const Event& event : motion.events) {
        if (event.kind == EventKind::impact && impacts < 8) {
            ASSERT_NEAR(event.time_s, impact_s, 1e-8);
            ASSERT_NEAR(event.speed_rad_per_s, speed, 1e-8);
            impact_s += std::numbers::pi / w;
            speed *= 0.6;
            ++impacts;
        }
    }
    EXPECT_EQ(impacts, 8U);
    built.restitution = 0.0;
    const auto dead = stand::move(built, {}, {0.5, 0.0}, times(20.0, 0.1));
    EXPECT_EQ(times_of(dead.events, EventKind::impact).size(), 1U);
    EXPECT_EQ(dead.points.back().angle_rad, 0.0);
}

// On a spring, friction F takes 2 F / k off the amplitude in each half swing, and holds the bar where the spring is too
// weak for it.
TEST(Stand, FrictionTakesEqualStepsOffTheSwingAndThenSticks) {
    stand::Stand built = bare();
    built.friction = 0.002;
    built.stiction = 1.0;
    const double spring = built.gravity_n_m / built.full_torque_n_m();
    const double step = 2.0 * built.friction / spring;
    const auto motion = stand::move(built, {}, {0.3, 0.0}, times(20.0, 0.01));
    double amplitude = 0.3;
    double side = 1.0;
    std::size_t halves = 0;
    for (const Event& event : motion.events) {
        if (event.kind == EventKind::reversal || event.kind == EventKind::sticks) {
            amplitude -= step;
            side = -side;
            ++halves;
            ASSERT_NEAR(event.angle_rad, side * amplitude, 1e-9);
            ASSERT_NEAR(event.time_s, std::numbers::pi / natural(built) * static_cast<double>(halves), 1e-8);
        }
    }
    ASSERT_FALSE(motion.events.empty());
    EXPECT_EQ(motion.events.back().kind, EventKind::sticks);
    EXPECT_LE(amplitude, 0.5 * step);
    EXPECT_NEAR(motion.points.back().angle_rad, side * amplitude, 1e-9);
}

TEST(Stand, StictionHoldsUntilTheThrustIsLargeEnough) {
    stand::Stand built = bare();
    built.friction = 0.01;
    built.stiction = 2.0;
    built.rate_per_s = 0.01;
    const std::vector<stand::Command> commands{{0.0, 0.5}};
    const auto motion = stand::move(built, stand::drive_motor(built, commands), {}, times(3.0, 0.01));
    ASSERT_FALSE(motion.events.empty());
    EXPECT_EQ(motion.events[0].kind, EventKind::breaks_loose);
    EXPECT_NEAR(motion.events[0].time_s, 2.0, 1e-9);  // 0.02 at 0.01 a second
    built.friction_up = 0.003;
    const auto later = stand::move(built, stand::drive_motor(built, commands), {}, times(3.0, 0.01));
    EXPECT_NEAR(later.events[0].time_s, 2.6, 1e-9);
}

TEST(Stand, StandsAtTheAngleWhereWeightAndThrustAreEqual) {
    stand::Stand built = bare();
    built.sine_per_unit = 1.0;
    built.damping_n_m_s = 0.2;
    built.thrust_curvature = 1.0;
    const auto record = stand::run(built, {.name = "step", .duty = 0.27, .until_s = 60.0}, 1);
    const double thrust = 0.27 * 0.27 * built.full_torque_n_m();
    EXPECT_NEAR(record.truth.points.back().angle_rad, std::asin(thrust / built.gravity_n_m), 1e-9);
    built.disturbance_from_s = 30.0;
    built.disturbance_to_s = 90.0;
    built.disturbance_size = 0.02;
    const auto disturbed = stand::run(built, {.name = "step", .duty = 0.27, .until_s = 60.0}, 1);
    EXPECT_NEAR(disturbed.truth.points.back().angle_rad,
                std::asin((thrust - 0.02 * built.full_torque_n_m()) / built.gravity_n_m), 1e-9);
}

TEST(Stand, WithoutEffectsItIsTheLinearModelThatItWrites) {
    stand::Stand built = bare();
    built.damping_n_m_s = 0.11;
    built.delay_s = 0.137;
    built.time_scale = 1.3;
    built.gain = 0.8;
    built.spread_s = 0.001;
    for (const char* name : {"step", "pulse", "staircase", "ramp", "chirp", "prbs"}) {
        const auto record = stand::run(built, {.name = name, .duty = 0.2, .off_s = 2.6, .until_s = 6.0}, 3);
        const auto model = drive::parse_model(stand::linear_model_json(built), "linear");
        const auto modelled = drive::respond(model, drive::changes_of(record.time_s, record.duty), record.time_s);
        for (std::size_t k = 0; k < modelled.size(); ++k) {
            ASSERT_NEAR(record.angle_rad[k], modelled[k], 2e-8) << name << " at " << record.time_s[k];
        }
    }
}

TEST(Stand, TheMotorIsOfFirstOrderAndTheDriverTakesItsTime) {
    stand::Stand built = bare();
    built.motor_tau_s = 0.2;
    built.start_up_s = 0.5;
    built.threshold = 0.1;
    built.delay_s = 0.05;
    const auto rotor_at = [&](const std::vector<stand::Command>& commands, double t) {
        return stand::move(built, stand::drive_motor(built, commands), {}, std::vector<double>{t}).points[0].rotor;
    };
    EXPECT_EQ(rotor_at({{0.1, 0.3}}, 0.65), 0.0);
    EXPECT_NEAR(rotor_at({{0.1, 0.3}}, 1.05), 0.3 * -std::expm1(-0.4 / 0.2), 1e-10);
    EXPECT_EQ(rotor_at({{0.1, 0.09}}, 2.0), 0.0);  // below the threshold
    // Off: at once, but for the delay; on again: the start-up once more.
    const double at_off = 0.3 * -std::expm1(-0.4 / 0.2);
    EXPECT_NEAR(rotor_at({{0.1, 0.3}, {1.0, 0.0}}, 1.45), at_off * std::exp(-0.4 / 0.2), 1e-10);
    EXPECT_NEAR(rotor_at({{0.1, 0.3}, {1.0, 0.0}, {1.1, 0.3}}, 1.65), at_off * std::exp(-0.6 / 0.2), 1e-10);
    built.dead_zone = 0.05;
    built.input_limit = 0.2;
    EXPECT_NEAR(rotor_at({{0.0, 0.3}}, 9.0), 0.2, 1e-10);
    EXPECT_NEAR(rotor_at({{0.0, 0.15}}, 9.0), 0.1, 1e-10);
    // A slope ends where it was to go.
    built.rate_per_s = 0.2;
    EXPECT_NEAR(rotor_at({{0.0, 0.15}}, 9.0), 0.1, 1e-10);
    built.rate_per_s = 0.01;
    EXPECT_LT(rotor_at({{0.0, 0.15}}, 9.0), 0.09);
}

TEST(Stand, TheBatterySagsUnderLoadAndWithTheChargeThatItGave) {
    stand::Stand built = bare();
    built.battery_resistance = 0.4;
    const double duty = 0.8;
    const auto speed_of = [&] {
        const auto record = stand::run(built, {.name = "step", .duty = duty, .until_s = 10.0}, 1);
        return record.truth.points.back().rotor;
    };
    const double without_lag = speed_of();
    EXPECT_NEAR(without_lag, duty * (1.0 - 0.4 * duty * without_lag * without_lag), 1e-12);
    built.motor_tau_s = 0.1;
    EXPECT_NEAR(speed_of(), without_lag, 1e-9);
    built.motor_tau_s = 0.0;
    built.battery_resistance = 0.0;
    built.sag_per_unit_s = 0.01;
    EXPECT_NEAR(speed_of(), duty * (1.0 - 0.01 * duty * 10.0), 1e-10);
}

TEST(Stand, DragSlowsTheBarAsItsSpeedSquared) {
    stand::Stand built = bare();
    built.gravity_n_m = 0.0;
    built.drag = 0.01;
    // A kick: thrust for a short time, then free.
    const std::vector<stand::Command> commands{{0.0, 1.0}, {0.1, 0.0}};
    const auto points =
        stand::move(built, stand::drive_motor(built, commands), {}, std::vector<double>{0.1, 5.0}).points;
    const double inertia = built.inertia_kg_m2 / built.full_torque_n_m();
    const double first = points[0].speed_rad_per_s;
    EXPECT_NEAR(first, std::tanh(0.1 * std::sqrt(0.01) / inertia) / std::sqrt(0.01), 1e-9);
    EXPECT_NEAR(points[1].speed_rad_per_s, first / (1.0 + 0.01 * first * 4.9 / inertia), 1e-9);
}

TEST(Stand, TheBarsOwnSwingAndTheLagsAreThoseOfTheirEquations) {
    stand::Stand built = bare();
    built.inertia_kg_m2 = 1e3;  // the bar itself hardly moves
    built.resonance_share = 0.5;
    built.resonance_hz = 3.0;
    built.resonance_damping = 0.1;
    const auto at = [&](double t) {
        return stand::move(built, stand::drive_motor(built, std::vector<stand::Command>{{0.0, 0.2}}), {},
                           std::vector<double>{t})
            .points[0];
    };
    const double w = 6.0 * std::numbers::pi;
    const double damped = w * std::sqrt(0.99);
    const double steady = 0.5 * 0.2 * built.full_torque_n_m() / built.gravity_n_m;
    const double expected = steady * (1.0 - std::exp(-0.1 * w * 0.7) *
                                                (std::cos(damped * 0.7) + 0.1 * w / damped * std::sin(damped * 0.7)));
    EXPECT_NEAR(at(0.7).reading_rad - at(0.7).angle_rad, expected, 1e-9);

    stand::Stand lagging = bare();
    lagging.friction = 1.0;  // held
    lagging.upper_stop_rad = 1.0;
    lagging.sensor_tau_s = 0.3;
    const auto start = stand::move(lagging, {}, {0.4, 0.0}, std::vector<double>{2.0});
    EXPECT_EQ(start.points[0].reading_rad, 0.4);
}

TEST(Stand, TheReadingFollowsWithPlayAndOtherLagsUpThanDown) {
    stand::Stand built = bare();
    built.backlash_rad = 0.1;
    const auto motion = stand::move(built, {}, {0.5, 0.0}, times(10.0, 0.001));
    // Released at 0.5 in the middle of the play: the axle follows 0.05 late, and turns back 0.1 later.
    double lowest = 1.0, highest_after = -1.0;
    for (const stand::Point& point : motion.points) {
        ASSERT_LE(std::fabs(point.reading_rad - point.angle_rad), 0.05 + 1e-9);
        lowest = std::min(lowest, point.reading_rad);
        if (point.time_s > 1.5) {
            highest_after = std::max(highest_after, point.reading_rad);
        }
    }
    EXPECT_NEAR(lowest, -0.45, 1e-6);
    EXPECT_NEAR(highest_after, 0.45, 1e-6);

    stand::Stand lagging = bare();
    lagging.tau_up_s = 0.5;
    lagging.tau_down_s = 0.1;
    lagging.inertia_kg_m2 = 1e-6;  // quick, and well damped
    lagging.damping_n_m_s = 0.002;
    const auto record = stand::run(lagging, {.name = "pulse", .duty = 0.1, .off_s = 4.0, .until_s = 6.0}, 1);
    const double steady = 0.1 * lagging.full_torque_n_m() / lagging.gravity_n_m;
    // Rising as 0.5 s, falling as 0.1 s: after 3 and 0.5 s, whatever the first 0.3 s were, in ratio.
    EXPECT_NEAR((steady - record.angle_rad[300]) / (steady - record.angle_rad[200]), std::exp(-1.0 / 0.5), 1e-3);
    EXPECT_NEAR(record.angle_rad[470] / record.angle_rad[450], std::exp(-0.2 / 0.1), 1e-2);
}

}  // namespace
