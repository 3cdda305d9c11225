// Which stand the results are of, its series and its commands; effects that are absent and come back.
#include "drive/stand/stand.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "base/failure.hpp"
#include "drive/stand/experiment.hpp"
#include "drive/stand/motion.hpp"
#include "tests/drive/stand_rig.hpp"

namespace {

using stand::EventKind;
using test::bare;
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
    record.truth.events = {
        {0.05, EventKind::impact, 0.1, 0.3}, {0.06, EventKind::sticks, 0.1, 0.0}, {0.15, EventKind::impact, 0.25, 0.2}};
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

}  // namespace
