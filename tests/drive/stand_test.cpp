// The virtual stand against what mechanics says in closed form.
#include "drive/stand/stand.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "base/failure.hpp"
#include "drive/log.hpp"
#include "drive/model_file.hpp"
#include "drive/response.hpp"
#include "drive/stand/experiment.hpp"
#include "drive/stand/motion.hpp"

namespace {

using stand::Event;
using stand::EventKind;
using testing::HasSubstr;

// Nothing but inertia, weight and what a test adds.
stand::Stand bare() {
    stand::Stand built;
    for (const std::string& effect : stand::effects()) {
        stand::remove_effect(built, effect);
    }
    built.damping_n_m_s = 0.0;
    built.delay_s = 0.0;
    built.spread_s = 0.0;
    return built;
}

std::vector<double> times(double until_s, double step_s) {
    std::vector<double> all;
    for (double k = 0; k * step_s <= until_s + 1e-12; ++k) {
        all.push_back(k * step_s);
    }
    return all;
}

std::vector<double> times_of(const std::vector<Event>& events, EventKind kind) {
    std::vector<double> found;
    for (const Event& event : events) {
        if (event.kind == kind) {
            found.push_back(event.time_s);
        }
    }
    return found;
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "no failure";
}

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

// Each piece by hand: where it begins, from which level, how steeply.
void expect_pieces(const stand::Stand& built, const std::vector<stand::Command>& commands,
                   const std::vector<stand::Piece>& expected) {
    const std::vector<stand::Piece> found = stand::drive_motor(built, commands);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_DOUBLE_EQ(found[i].time_s, expected[i].time_s) << i;
        EXPECT_NEAR(found[i].level, expected[i].level, 1e-15) << i;
        EXPECT_NEAR(found[i].slope_per_s, expected[i].slope_per_s, 1e-15) << i;
    }
}

TEST(Driver, HoldsLevelsBehindItsDelay) {
    stand::Stand built = bare();
    built.delay_s = 0.25;
    built.extra_delay_s = 0.5;
    built.start_up_s = 0.0;
    built.threshold = 0.125;
    built.dead_zone = 0.0625;
    built.input_limit = 0.5;
    // At the threshold it turns, below it does not; what is commanded again changes nothing.
    expect_pieces(built, {{0.0, 0.125}, {1.0, 0.12}, {2.0, 0.375}, {3.0, 0.375}, {4.0, 1.0}},
                  {{0.0, 0.0, 0.0}, {0.75, 0.0625, 0.0}, {1.75, 0.0, 0.0}, {2.75, 0.3125, 0.0}, {4.75, 0.5, 0.0}});
    built.delay_s = built.extra_delay_s = 0.0;
    built.threshold = 0.0;
    expect_pieces(built, {{0.0, 0.25}, {1.0, -0.5}, {2.0, 0.03125}}, {{0.0, 0.1875, 0.0}, {1.0, 0.0, 0.0}});
}

TEST(Driver, StartsAMotorThatStandsEachTimeAnew) {
    stand::Stand built = bare();
    built.delay_s = 0.0;
    built.start_up_s = 0.5;
    built.threshold = 0.125;
    // Other duties while it starts count from its turning on; off before it turns, it never does.
    expect_pieces(built, {{1.0, 0.25}, {1.25, 0.5}, {2.0, 0.0}, {3.0, 0.25}, {3.25, 0.0}, {4.0, 0.75}},
                  {{0.0, 0.0, 0.0}, {1.5, 0.5, 0.0}, {2.0, 0.0, 0.0}, {4.5, 0.75, 0.0}});
    // It turns just as the next command comes: with that one.
    expect_pieces(built, {{1.0, 0.25}, {1.5, 0.5}}, {{0.0, 0.0, 0.0}, {1.5, 0.5, 0.0}});
}

TEST(Driver, GoesFromLevelToLevelByItsSlope) {
    stand::Stand built = bare();
    built.delay_s = 0.0;
    built.start_up_s = 0.0;
    built.threshold = 0.0;
    built.rate_per_s = 0.5;
    // Up to 0.5 in a second; down from there; cut short by the next; arrived just as it comes.
    expect_pieces(built, {{1.0, 0.5}, {3.0, 0.25}, {4.0, 1.0}, {5.0, 0.5}, {5.5, 0.25}},
                  {{0.0, 0.0, 0.0},
                   {1.0, 0.0, 0.5},
                   {2.0, 0.5, 0.0},
                   {3.0, 0.5, -0.5},
                   {3.5, 0.25, 0.0},
                   {4.0, 0.25, 0.5},
                   {5.0, 0.75, -0.5},
                   {5.5, 0.5, -0.5},
                   {6.0, 0.25, 0.0}});
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

TEST(Stand, ReadsWholeCountsAtStampsThatItsSeedFixes) {
    stand::Stand built;
    const stand::Experiment pulse;
    const auto record = stand::run(built, pulse, 5);
    ASSERT_EQ(record.time_s.size(), 501U);
    double widest = 0.0;
    for (std::size_t k = 0; k < record.time_s.size(); ++k) {
        const double counts = record.angle_rad[k] * 1000.0 / (2.0 * std::numbers::pi);
        ASSERT_NEAR(counts, std::round(counts), 1e-9);
        ASSERT_NEAR(record.angle_rad[k], record.truth.points[k].angle_rad, 0.5 * built.encoder_step_rad + 1e-12);
        widest = std::max(widest, std::fabs(record.time_s[k] - 0.01 * static_cast<double>(k)));
    }
    EXPECT_LE(widest, 0.001);
    EXPECT_GT(widest, 0.0009);
    EXPECT_EQ(stand::to_csv(record, true), stand::to_csv(stand::run(built, pulse, 5), true));
    EXPECT_NE(record.time_s, stand::run(built, pulse, 6).time_s);
    const auto log = drive::parse_log(stand::to_csv(record, true), "stand");
    EXPECT_EQ(log.output, record.angle_rad);
    EXPECT_EQ(log.input, record.duty);
}

TEST(Stand, WhatIsWrongWithTheReadingIsInTheReadingOnly) {
    stand::Stand built;
    const stand::Experiment pulse;
    const auto good = stand::run(built, pulse, 5);
    const auto changed = [&](auto set) {
        stand::Stand other = built;
        set(other);
        auto record = stand::run(other, pulse, 5);
        EXPECT_EQ(record.time_s, good.time_s);
        for (std::size_t k = 0; k < good.time_s.size(); ++k) {
            EXPECT_NEAR(record.truth.points[k].angle_rad, good.truth.points[k].angle_rad, 1e-7);
        }
        return record.angle_rad;
    };
    const double count = built.encoder_step_rad;
    EXPECT_NEAR(changed([&](auto& s) { s.offset_rad = 3.0 * count; })[10], good.angle_rad[10] + 3.0 * count, 1e-12);
    EXPECT_NEAR(changed([&](auto& s) { s.drift_rad_per_s = count; })[500], good.angle_rad[500] + 5.0 * count,
                1.01 * count);
    const auto missed = changed([&](auto& s) {
        s.missed_counts = 4.0;
        s.missed_at_s = 2.0;
    });
    EXPECT_EQ(missed[150], good.angle_rad[150]);
    EXPECT_NEAR(missed[250], good.angle_rad[250] - 4.0 * count, 1e-12);
    const auto limited = changed([&](auto& s) { s.sensor_limit_rad = 0.3; });
    EXPECT_LE(*std::max_element(limited.begin(), limited.end()), 0.3 + count);
    const auto dropped = changed([&](auto& s) { s.dropped_rate = 0.5; });
    std::size_t held = 0, moved = 0;
    for (std::size_t k = 110; k < 180; ++k) {  // where the bar moves at more than a count a sample
        held += dropped[k] == dropped[k - 1] ? 1 : 0;
        moved += good.angle_rad[k] != good.angle_rad[k - 1] ? 1 : 0;
    }
    EXPECT_GT(held, 20U);
    EXPECT_GT(moved, 50U);
    const auto jittered = changed([&](auto& s) { s.jitter_s = 0.004; });
    EXPECT_NE(jittered, good.angle_rad);
    const auto noisy = changed([&](auto& s) { s.noise_rad = 0.02; });
    EXPECT_NE(noisy, good.angle_rad);
}

TEST(Stand, JitterAndStampsAreDrawnApart) {
    stand::Stand built;
    built.encoder_step_rad = 0.0;
    const stand::Experiment pulse;
    const auto good = stand::run(built, pulse, 5);
    built.jitter_s = 0.001;
    const auto late = stand::run(built, pulse, 5);
    // How late each sample was taken, from how fast the bar moves then.
    double product = 0.0, of_stamps = 0.0, of_jitter = 0.0;
    for (std::size_t k = 1; k + 1 < good.time_s.size(); ++k) {
        const double speed =
            (good.angle_rad[k + 1] - good.angle_rad[k - 1]) / (good.time_s[k + 1] - good.time_s[k - 1]);
        if (std::fabs(speed) > 0.2) {
            const double jitter = (late.angle_rad[k] - good.angle_rad[k]) / speed;
            const double stamp = good.time_s[k] - 0.01 * static_cast<double>(k);
            product += jitter * stamp;
            of_stamps += stamp * stamp;
            of_jitter += jitter * jitter;
        }
    }
    EXPECT_GT(of_jitter, 1e-6);
    EXPECT_LT(std::fabs(product), 0.3 * std::sqrt(of_stamps * of_jitter));
}

TEST(Stand, ThreeSeriesRepeatAndTheFourthIsDisturbed) {
    const auto series = stand::run_series(stand::Stand(), {}, 1);
    ASSERT_EQ(series.size(), 4U);
    // Samples come at other times; the truth is compared where all are nearest to even stamps.
    const auto distance = [&](std::size_t other) {
        double largest = 0.0;
        for (std::size_t k = 0; k < series[0].time_s.size(); ++k) {
            largest = std::max(largest, std::fabs(series[0].angle_rad[k] - series[other].angle_rad[k]));
        }
        return largest;
    };
    EXPECT_LT(distance(1), 0.05);
    EXPECT_LT(distance(2), 0.05);
    EXPECT_GT(distance(3), 0.1);
    const double top = *std::max_element(series[0].angle_rad.begin(), series[0].angle_rad.end());
    EXPECT_GT(top, 0.6);
    EXPECT_LT(top, 1.0);
    EXPECT_EQ(series[0].duty[259], 0.27);
    EXPECT_EQ(series[0].duty[262], 0.0);
}

// The stand that published fits and pictures are of. Whoever changes one of these changes them, and says so here.
TEST(Stand, IsTheOneThatResultsAreOf) {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    const std::map<std::string, double> expected = {
        {"inertia_kg_m2", 0.03},
        {"damping_n_m_s", 0.11},
        {"gravity_n_m", 0.18},
        {"full_thrust_n", 7.0},
        {"arm_m", 0.25},
        {"delay_s", 0.02},
        {"interval_s", 0.01},
        {"spread_s", 0.001},
        {"gain_error.gain", 1.0},
        {"time_scale_error.scale", 1.0},
        {"dead_time_error.extra_s", 0.0},
        {"start_up_time.duration_s", 0.85},
        {"start_up_threshold.threshold", 0.05},
        {"input_dead_zone.width", 0.0},
        {"input_saturation.limit", 1.0},
        {"rate_limit.per_s", unlimited},
        {"actuator_lag.tau_s", 0.12},
        {"input_curve.curvature", 1.0},
        {"input_curve.reference", 1.0},
        {"supply_sag.per_unit_s", 0.004},
        {"supply_sag.resistance", 0.3},
        {"gain_drift.per_s", 0.0},
        {"coulomb_friction.force", 0.0015},
        {"coulomb_friction.stiction", 1.4},
        {"direction_dependent_friction.force_up", 0.0},
        {"direction_dependent_friction.force_down", 0.0},
        {"quadratic_drag.coefficient", 0.0005},
        {"gravity_nonlinearity.angle_per_unit", 1.0},
        {"end_stop.limit", 1.3},
        {"end_stop.lower", 0.0},
        {"end_stop.restitution", 0.35},
        {"load_disturbance.from_s", 0.0},
        {"load_disturbance.to_s", 0.0},
        {"load_disturbance.size", 0.0},
        {"backlash.gap", 0.0},
        {"output_curve.curvature", 0.0},
        {"output_curve.reference", 1.0},
        {"direction_asymmetry.tau_up_s", 0.0},
        {"direction_asymmetry.tau_down_s", 0.0},
        {"structural_resonance.hz", 12.0},
        {"structural_resonance.damping", 0.03},
        {"structural_resonance.share", 0.0},
        {"sensor_lag.tau_s", 0.0},
        {"sensor_offset.offset", 0.0},
        {"sensor_drift.per_s", 0.0},
        {"noise.deviation", 0.0},
        {"sensor_saturation.limit", unlimited},
        {"encoder_quantisation.step", 0.006283185307179586},
        {"missed_counts.at_s", 0.0},
        {"missed_counts.sizes", 0.0},
        {"sampling_jitter.half_width_s", 0.0},
        {"dropped_samples.rate", 0.0},
    };
    const stand::Stand built;
    std::size_t met = 0;
    for (const stand::Size& size : stand::sizes()) {
        const std::string name = *size.effect == '\0' ? size.name : std::string(size.effect) + '.' + size.name;
        ASSERT_TRUE(expected.contains(name)) << name;
        EXPECT_EQ(built.*size.value, expected.at(name)) << name;
        ++met;
    }
    EXPECT_EQ(met, expected.size());
}

TEST(Stand, EachEffectCanBeAbsentAndBeBroughtBack) {
    stand::Stand none;
    for (const std::string& effect : stand::effects()) {
        stand::remove_effect(none, effect);
    }
    EXPECT_TRUE(stand::present_effects(none).empty());
    for (const stand::Size& size : stand::sizes()) {
        if (*size.effect != '\0' && size.decides) {
            stand::Stand one = none;
            one.*size.value = size.neutral == 0.0 ? 0.01 : 0.5;
            EXPECT_EQ(stand::present_effects(one), std::vector<std::string>{size.effect}) << size.name;
            stand::remove_effect(one, size.effect);
            EXPECT_EQ(one, none);
        }
    }
    const std::set<std::string> names = [] {
        const auto all = stand::effects();
        return std::set<std::string>(all.begin(), all.end());
    }();
    EXPECT_EQ(names.size(), stand::effects().size());  // the sizes of an effect stand together
    EXPECT_EQ(stand::parse_stand(stand::to_toml(stand::Stand()), "own"), stand::Stand());
    EXPECT_EQ(stand::parse_stand(stand::to_toml(none), "own"), none);
}

TEST(Stand, AllEffectsButTheKeptAreAbsent) {
    stand::Stand built;
    built.backlash_rad = 0.01;
    const std::vector<std::string> kept{"coulomb_friction", "backlash"};
    stand::keep_effects(built, kept);
    EXPECT_THAT(stand::present_effects(built), testing::UnorderedElementsAreArray(kept));
    EXPECT_EQ(built.friction, stand::Stand().friction);
    const stand::Stand before = built;
    EXPECT_THROW(stand::keep_effects(built, std::vector<std::string>{"coulomb"}), glsum::Failure);
    EXPECT_EQ(built, before);
    stand::keep_effects(built, {});
    EXPECT_TRUE(stand::present_effects(built).empty());
}

TEST(Stand, ARecordIsToldByItsHighestAngleAndImpacts) {
    stand::Record record;
    record.time_s = {0.0, 0.1, 0.2};
    record.angle_rad = {0.1, 0.25, 0.2};
    record.truth.events = {{0.05, EventKind::impact, 0.1, 0.3},
                           {0.06, EventKind::sticks, 0.1, 0.0},
                           {0.15, EventKind::impact, 0.25, 0.2}};
    EXPECT_EQ(stand::to_text(record), "3 samples, up to 0.2500 rad, 2 impacts on a stop");
}

// What is commanded, by the closed form of each name.
TEST(Stand, CommandsAreWhatTheirNamesSay) {
    const stand::Experiment usual;
    EXPECT_EQ(usual.name, "pulse");
    EXPECT_EQ(usual.duty, 0.27);
    EXPECT_EQ(usual.low_duty, 0.0);
    EXPECT_EQ(usual.off_s, 2.6);
    EXPECT_EQ(usual.until_s, 5.0);
    EXPECT_EQ(usual.stairs, 4);
    EXPECT_EQ(usual.from_hz, 0.05);
    EXPECT_EQ(usual.to_hz, 2.0);
    EXPECT_EQ(usual.bit_s, 0.25);
    EXPECT_EQ(usual.angle_rad, 0.7);
    const auto duties = [](stand::Experiment experiment, std::uint64_t seed = 1) {
        return stand::run(bare(), experiment, seed).duty;
    };
    stand::Experiment asked{.name = "pulse", .duty = 0.5, .low_duty = 0.1, .off_s = 3.0, .until_s = 8.0};
    const auto pulse = duties(asked);
    ASSERT_EQ(pulse.size(), 801U);
    EXPECT_EQ(pulse[299], 0.5);
    EXPECT_EQ(pulse[300], 0.0);
    asked.name = "staircase";
    const auto stairs = duties(asked);
    const double levels[] = {0.2, 0.3, 0.4, 0.5, 0.4, 0.3, 0.2, 0.1};
    for (std::size_t k = 0; k < 801; ++k) {
        EXPECT_NEAR(stairs[k], levels[std::min<std::size_t>(k / 100, 7)], 1e-12) << k;
    }
    asked.name = "ramp";
    const auto ramp = duties(asked);
    for (std::size_t k = 0; k < 801; ++k) {
        EXPECT_NEAR(ramp[k], 0.5 - 0.4 * std::fabs(static_cast<double>(k) - 400.0) / 400.0, 1e-12) << k;
    }
    asked.name = "release";
    EXPECT_EQ(duties(asked), std::vector<double>(801, 0.0));
    EXPECT_EQ(stand::run(bare(), asked, 1).angle_rad[0], 0.7);
    // Of 0.5 to 4 Hz in 8 s three octaves: T f (2^(3 t/T) - 1) / (3 ln 2) turns from the lowest, 13.46 in all.
    asked.name = "chirp";
    asked.from_hz = 0.5;
    asked.to_hz = 4.0;
    const auto chirp = duties(asked);
    for (std::size_t k = 0; k < 801; ++k) {
        const double turns = 4.0 * (std::exp2(3.0 * static_cast<double>(k) / 800.0) - 1.0) / (3.0 * std::numbers::ln2);
        EXPECT_NEAR(chirp[k], 0.3 - 0.2 * std::cos(2.0 * std::numbers::pi * turns), 1e-9) << k;
    }
    // Of ten bits the longest sequence: 1023 bits that come again, 512 of them high; other seeds begin elsewhere in it.
    asked.name = "prbs";
    asked.bit_s = 0.02;
    asked.until_s = 41.5;
    const auto bits = duties(asked);
    std::size_t high = 0;
    for (std::size_t bit = 0; bit < 1023; ++bit) {
        const double value = bits[2 * bit];
        EXPECT_TRUE(value == 0.5 || value == 0.1) << bit;
        EXPECT_EQ(bits[2 * bit + 1], value) << bit;  // held
        EXPECT_EQ(bits[2 * (bit + 1023)], value) << bit;
        high += value == 0.5 ? 1 : 0;
    }
    EXPECT_EQ(high, 512U);
    EXPECT_NE(duties(asked, 2), bits);
}

TEST(Stand, SeriesShareABatteryAndTheLastIsBlownUpon) {
    stand::Stand built = bare();
    built.damping_n_m_s = 0.11;
    built.sag_per_unit_s = 0.05;
    built.start_up_s = 0.5;
    const stand::Experiment pulse{.name = "pulse", .duty = 0.4, .off_s = 2.0, .until_s = 3.0};
    const auto series = stand::run_series(built, pulse, 7, 3);
    ASSERT_EQ(series.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string number = std::to_string(i + 1);
        EXPECT_EQ(series[i].name, "series " + number + ", pulse, seed 700" + number);
        // From the end of the start-up, of up to 10 ms more or less, to the end of the pulse.
        EXPECT_NEAR(series[i].truth.points.back().charge, 0.4 * 1.5 * static_cast<double>(i + 1),
                    0.4 * 0.01 * static_cast<double>(i + 1));
    }
    // Alone there is no last one; of two it is disturbed from 1.5 s to 2.1 s and not before.
    const auto alone = stand::run_series(built, pulse, 7, 1);
    EXPECT_EQ(alone[0].angle_rad, series[0].angle_rad);
    stand::Stand blown = built;
    const auto two = stand::run_series(built, pulse, 7, 2);
    std::size_t apart = 0;
    for (std::size_t k = 0; k < 301; ++k) {
        const double difference = two[1].truth.points[k].angle_rad - series[1].truth.points[k].angle_rad;
        if (k <= 150) {
            EXPECT_NEAR(difference, 0.0, 1e-7) << k;
        }
        apart += difference < -1e-3 ? 1 : 0;  // against the first motor
    }
    EXPECT_GT(apart, 80U);
    blown.disturbance_from_s = 1.5;
    blown.disturbance_to_s = 2.1;
    blown.disturbance_size = 0.3 * 0.4 * 0.4;
    blown.start_up_s = 0.0;
    built.start_up_s = 0.0;
    const auto same = stand::run(blown, pulse, 7002, 0.8);  // the first took 0.4 for 2 s
    const auto without_start = stand::run_series(built, pulse, 7, 2);
    for (std::size_t k = 0; k < 301; ++k) {
        EXPECT_NEAR(without_start[1].angle_rad[k], same.angle_rad[k], 1e-6) << k;
    }
}

// What each size is where its effect is absent, and the least and the largest that it may be: such are taken, what lies
// beyond is refused. Files of stands hold such values.
TEST(Stand, SizesAreTakenToTheirEndsAndNotBeyond) {
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    struct Range {
        const char* name;
        double absent, least, most;
    };
    const Range ranges[] = {
        {"inertia_kg_m2", 0.03, 1e-6, 1e3},
        {"damping_n_m_s", 0.11, 0.0, 1e3},
        {"gravity_n_m", 0.18, 0.0, 1e3},
        {"full_thrust_n", 7.0, 1e-6, 1e4},
        {"arm_m", 0.25, 1e-3, 10.0},
        {"delay_s", 0.02, 0.0, 10.0},
        {"interval_s", 0.01, 1e-4, 10.0},
        {"spread_s", 0.001, 0.0, 5.0},
        {"gain_error.gain", 1.0, 1e-3, 1e3},
        {"time_scale_error.scale", 1.0, 1e-2, 1e2},
        {"dead_time_error.extra_s", 0.0, 0.0, 10.0},
        {"start_up_time.duration_s", 0.0, 0.0, 10.0},
        {"start_up_threshold.threshold", 0.0, 0.0, 1.0},
        {"input_dead_zone.width", 0.0, 0.0, 1.0},
        {"input_saturation.limit", unlimited, 1e-6, unlimited},
        {"rate_limit.per_s", unlimited, 1e-6, unlimited},
        {"actuator_lag.tau_s", 0.0, 0.0, 100.0},
        {"input_curve.curvature", 0.0, -1.0, 1.0},
        {"input_curve.reference", 1.0, 1e-6, 1e6},
        {"supply_sag.per_unit_s", 0.0, 0.0, 10.0},
        {"supply_sag.resistance", 0.0, 0.0, 10.0},
        {"gain_drift.per_s", 0.0, -10.0, 10.0},
        {"coulomb_friction.force", 0.0, 0.0, 10.0},
        {"coulomb_friction.stiction", 1.0, 1.0, 100.0},
        {"direction_dependent_friction.force_up", 0.0, 0.0, 10.0},
        {"direction_dependent_friction.force_down", 0.0, 0.0, 10.0},
        {"quadratic_drag.coefficient", 0.0, 0.0, 100.0},
        {"gravity_nonlinearity.angle_per_unit", 0.0, 0.0, 100.0},
        {"end_stop.limit", unlimited, -unlimited, unlimited},
        {"end_stop.lower", -unlimited, -unlimited, unlimited},
        {"end_stop.restitution", 0.0, 0.0, 1.0},
        {"load_disturbance.from_s", 0.0, 0.0, 1e6},
        {"load_disturbance.to_s", 0.0, 0.0, 1e6},
        {"load_disturbance.size", 0.0, -10.0, 10.0},
        {"backlash.gap", 0.0, 0.0, 10.0},
        {"output_curve.curvature", 0.0, -1.0, 1.0},
        {"output_curve.reference", 1.0, 1e-6, 1e6},
        {"direction_asymmetry.tau_up_s", 0.0, 0.0, 100.0},
        {"direction_asymmetry.tau_down_s", 0.0, 0.0, 100.0},
        {"structural_resonance.hz", 12.0, 1e-2, 1e3},
        {"structural_resonance.damping", 0.03, 0.0, 1.0},
        {"structural_resonance.share", 0.0, -10.0, 10.0},
        {"sensor_lag.tau_s", 0.0, 0.0, 100.0},
        {"sensor_offset.offset", 0.0, -100.0, 100.0},
        {"sensor_drift.per_s", 0.0, -100.0, 100.0},
        {"noise.deviation", 0.0, 0.0, 100.0},
        {"sensor_saturation.limit", unlimited, 1e-6, unlimited},
        {"encoder_quantisation.step", 0.0, 0.0, 10.0},
        {"missed_counts.at_s", 0.0, 0.0, 1e6},
        {"missed_counts.sizes", 0.0, -1e6, 1e6},
        {"sampling_jitter.half_width_s", 0.0, 0.0, 5.0},
        {"dropped_samples.rate", 0.0, 0.0, 0.99},
    };
    ASSERT_EQ(stand::sizes().size(), std::size(ranges));
    for (std::size_t i = 0; i < std::size(ranges); ++i) {
        const stand::Size& size = stand::sizes()[i];
        const Range& range = ranges[i];
        EXPECT_EQ(size.neutral, range.absent) << range.name;
        stand::Stand built;
        stand::set_size(built, range.name, range.least);
        EXPECT_EQ(built.*size.value, range.least) << range.name;
        stand::set_size(built, range.name, range.most);
        EXPECT_EQ(built.*size.value, range.most) << range.name;
        for (const double beyond : {std::nextafter(range.least, -unlimited), std::nextafter(range.most, unlimited)}) {
            if (beyond < range.least || beyond > range.most) {
                EXPECT_THAT(message_of([&] { stand::set_size(built, range.name, beyond); }), HasSubstr(range.name));
            }
        }
        EXPECT_THAT(message_of([&] { stand::set_size(built, range.name, std::nan("")); }), HasSubstr(range.name));
        EXPECT_EQ(built.*size.value, range.most) << range.name;
    }
    // Those that shape an effect and do not make one.
    std::set<std::string> shaping;
    for (const stand::Size& size : stand::sizes()) {
        if (!size.decides) {
            shaping.insert(std::string(size.effect) + '.' + size.name);
        }
    }
    EXPECT_EQ(shaping,
              (std::set<std::string>{"input_curve.reference", "coulomb_friction.stiction", "end_stop.restitution",
                                     "load_disturbance.from_s", "load_disturbance.to_s", "output_curve.reference",
                                     "structural_resonance.hz", "structural_resonance.damping", "missed_counts.at_s"}));
}

TEST(Stand, SaysWhatIsWrongWithAFileAndWhere) {
    const auto said = [](const std::string& text) {
        return message_of([&] { (void)stand::parse_stand(text, "my.toml"); });
    };
    EXPECT_THAT(said("[backlash]\ngap = -1\n"), HasSubstr("my.toml:2: backlash.gap: expected 0 to 10, found -1"));
    EXPECT_THAT(said("[backlash]\nwidth = 1\n"), HasSubstr("my.toml:2: backlash: expected gap, found width"));
    EXPECT_THAT(said("[bakclash]\ngap = 1\n"), HasSubstr("my.toml:1: expected parts or one of the effects gain_error"));
    EXPECT_THAT(said("[backlash]\ngap = 'wide'\n"), HasSubstr("my.toml:2: backlash.gap: expected a number"));
    EXPECT_THAT(said("[backlash\n"), HasSubstr("my.toml:1: expected TOML"));
    EXPECT_THAT(said("gap = 1\n"), HasSubstr("my.toml:1: expected tables"));
    EXPECT_THAT(said("[sensor_lag]\ntau_s = nan\n"),
                HasSubstr("my.toml:2: sensor_lag.tau_s: expected 0 to 100, found nan"));
    EXPECT_THAT(said("[sensor_lag]\ntau_s = 1e-9\n"), HasSubstr("expected 0 or at least 0.0001 s"));
    EXPECT_THAT(said("[end_stop]\nlimit = -1\n"), HasSubstr("expected the lower stop below the upper"));
    EXPECT_THAT(said("[direction_asymmetry]\ntau_up_s = 1\n"), HasSubstr("expected both lags or none"));
    EXPECT_THAT(said("[parts]\nspread_s = 0.005\n"), HasSubstr("expected less than half of the interval"));
    EXPECT_THAT(said("[load_disturbance]\nsize = 1\n"), HasSubstr("expected from_s below to_s"));
    stand::Stand built;
    EXPECT_THAT(message_of([&] { stand::set_size(built, "actuator_lag.tau", 1.0); }), HasSubstr("actuator_lag.tau_s"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.name = "square"}, 1); }), HasSubstr("found square"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.duty = 1.2}, 1); }), HasSubstr("duties"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.until_s = 1e9}, 1); }), HasSubstr("10^6 samples"));
    EXPECT_THAT(message_of([&] { (void)stand::run(built, {.name = "release", .angle_rad = 2.0}, 1); }),
                HasSubstr("between the stops"));
}

}  // namespace
