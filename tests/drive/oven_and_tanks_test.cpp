// Ovens and tanks in motion: what switches, swings or waits, by closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/drive/oven_and_tanks.hpp"

namespace {

using oven_and_tanks::filled;
using oven_and_tanks::Held;
using oven_and_tanks::levels;
using oven_and_tanks::Oven;
using oven_and_tanks::Tanks;
using oven_and_tanks::warmed;

// What a first order of time constant tau makes of sin(w t), from rest.
double swung(double t, double w, double tau) {
    return (std::sin(w * t) - w * tau * std::cos(w * t) + w * tau * std::exp(-t / tau)) / (1.0 + w * w * tau * tau);
}

const Oven plain{
    .body_j_per_k = 2.0, .body_loss_w_per_k = 1.0, .power_w_per_unit = 10.0, .ambient_c = 0.0, .start_c = 0.0};
double first(double t) { return t > 0.0 ? 1.0 - std::exp(-t / 2.0) : 0.0; }

TEST(Oven, FollowsSurroundingsAndMainsThatSwing) {
    const double w = 2.0 * std::numbers::pi / 3.0;
    Oven oven = plain;
    oven.ambient_swing_k = 4.0;
    oven.ambient_period_s = 3.0;
    for (const double t : {0.7, 2.9}) {
        EXPECT_NEAR(warmed(oven, levels({{0.0, 0.0}}), t), 4.0 * swung(t, w, 2.0), 1e-6);
    }
    oven = plain;
    oven.mains_share = 0.2;
    oven.mains_period_s = 3.0;
    for (const double t : {0.7, 2.9}) {
        EXPECT_NEAR(warmed(oven, levels({{0.0, 0.5}}), t), 5.0 * (first(t) + 0.2 * swung(t, w, 2.0)), 1e-6);
    }
    // Surroundings that drift are followed by a time constant behind them; power that grows likewise.
    oven = plain;
    oven.ambient_drift_k_per_s = 0.5;
    EXPECT_NEAR(warmed(oven, levels({{0.0, 0.0}}), 3.0), 0.5 * (3.0 - 2.0 * first(3.0)), 1e-6);
    oven = plain;
    oven.gain_growth_per_s = 0.1;
    EXPECT_NEAR(warmed(oven, levels({{0.0, 1.0}}), 3.0), 10.0 * (first(3.0) + 0.1 * (3.0 - 2.0 * first(3.0))), 1e-6);
}

TEST(Oven, BendsItsInputAtItsReference) {
    Oven oven = plain;
    oven.curvature = 0.5;
    oven.curve_reference = 1.6;
    EXPECT_NEAR(warmed(oven, levels({{0.0, 0.8}}), 60.0), 8.0 * (1.0 + 0.5 * (0.8 / 1.6 - 1.0)), 1e-6);
    // The threshold itself does not act yet; the dead zone is lost before the limit bites.
    oven = plain;
    oven.threshold = 0.8;
    EXPECT_EQ(warmed(oven, levels({{0.0, 0.8}}), 10.0), 0.0);
    oven = plain;
    oven.dead_zone = 0.2;
    oven.input_limit = 0.7;
    EXPECT_NEAR(warmed(oven, levels({{0.0, 0.8}}), 60.0), 6.0, 1e-6);
    EXPECT_NEAR(warmed(oven, levels({{0.0, 1.0}}), 60.0), 7.0, 1e-6);
    EXPECT_EQ(warmed(oven, levels({{0.0, 0.1}}), 60.0), 0.0);
    // A slope of 0.25 a second, up and down.
    oven = plain;
    oven.body_j_per_k = 1e-2;
    oven.rate_per_s = 0.25;
    const Held there_and_back = levels({{0.0, 0.5}, {5.0, 0.25}});
    EXPECT_NEAR(warmed(oven, there_and_back, 1.0, 1e-3), 2.5, 0.05);
    EXPECT_NEAR(warmed(oven, there_and_back, 5.0, 1e-3), 5.0, 1e-3);
    EXPECT_NEAR(warmed(oven, there_and_back, 5.5, 1e-3), 3.75, 0.05);
    EXPECT_NEAR(warmed(oven, there_and_back, 7.0, 1e-3), 2.5, 1e-3);
}

TEST(Oven, CoolsByItsThermometersOtherLag) {
    Oven oven = plain;
    oven.start_c = 10.0;
    oven.sensor_tau_s = 0.05;
    oven.falling_tau_s = 0.5;
    // Body 2 s, thermometer 0.5 s on the way down.
    for (const double t : {0.4, 1.5}) {
        EXPECT_NEAR(warmed(oven, levels({{0.0, 0.0}}), t),
                    10.0 * (2.0 * std::exp(-t / 2.0) - 0.5 * std::exp(-t / 0.5)) / 1.5, 1e-6);
    }
}

TEST(Oven, LosesWhileItIsOpen) {
    Oven oven = plain;
    oven.disturbance_w = 3.0;
    oven.disturbance_from_s = 1.0;
    oven.disturbance_to_s = 2.5;
    for (const double t : {0.9, 1.7, 2.4, 4.0}) {
        EXPECT_NEAR(warmed(oven, levels({{0.0, 1.0}}), t), 10.0 * first(t) - 3.0 * (first(t - 1.0) - first(t - 2.5)),
                    0.01)
            << t;
    }
}

// Without losses so much later as the melting takes heat: share w sqrt(pi) of the body's own for each degree.
TEST(Oven, MeltingTakesItsHeat) {
    Oven oven = plain;
    oven.body_loss_w_per_k = 0.0;
    oven.melting_share = 3.0;
    oven.melting_c = 20.0;
    oven.melting_width_k = 2.0;
    const double melted_j = 2.0 * 3.0 * 2.0 * std::sqrt(std::numbers::pi);
    EXPECT_NEAR(warmed(oven, levels({{0.0, 1.0}}), 10.0), (100.0 - melted_j) / 2.0, 1e-4);
    EXPECT_NEAR(warmed(oven, levels({{0.0, 1.0}}), 2.0), 10.0, 1e-4);  // not yet
}

// The fan starts above one temperature and stops below a lower one: between them it does what it did.
TEST(Oven, ItsFanHasTwoTemperatures) {
    Oven oven = plain;
    oven.fan_share = 0.5;
    oven.fan_on_c = 6.0;
    oven.fan_off_c = 2.0;
    EXPECT_NEAR(warmed(oven, levels({{0.0, 0.5}}), 60.0), 5.0, 1e-6);                     // never started
    EXPECT_NEAR(warmed(oven, levels({{0.0, 1.0}, {30.0, 0.5}}), 90.0), 5.0 / 1.5, 1e-6);  // and now still runs
    EXPECT_NEAR(warmed(oven, levels({{0.0, 1.0}, {30.0, 0.0}, {60.0, 0.5}}), 120.0), 5.0, 1e-6);
}

TEST(Oven, ScalesItsStoresAndItsWall) {
    // Body and wall under constant power: rest at P over what both lose.
    const Oven oven{.body_j_per_k = 2.0,
                    .body_loss_w_per_k = 0.5,
                    .wall_j_per_k = 1.0,
                    .wall_loss_w_per_k = 2.0,
                    .coupling_w_per_k = 2.0,
                    .power_w_per_unit = 3.0,
                    .ambient_c = 10.0,
                    .start_c = 10.0};
    EXPECT_DOUBLE_EQ(stand::thermal::static_loss_w_per_k(oven), 0.5 + 1.0);
    EXPECT_NEAR(warmed(oven, levels({{0.0, 2.0}}), 60.0), 10.0 + 6.0 / 1.5, 1e-6);
    Oven alone = oven;
    alone.wall_j_per_k = 0.0;
    EXPECT_DOUBLE_EQ(stand::thermal::static_loss_w_per_k(alone), 0.5);
    EXPECT_NEAR(warmed(alone, levels({{0.0, 2.0}}), 60.0), 10.0 + 6.0 / 0.5, 1e-4);
    // It starts from where it stood, whatever surrounds it.
    Oven warm = plain;
    warm.start_c = 8.0;
    warm.ambient_c = 3.0;
    EXPECT_NEAR(warmed(warm, levels({{0.0, 0.0}}), 1.0), 3.0 + 5.0 * std::exp(-0.5), 1e-6);
}

const Tanks tank{.area_cm2 = 8.0, .outflow_cm2_per_s = 4.0, .reference_cm = 25.0, .inflow_per_unit = 100.0};

TEST(Tanks, LagByPumpAndGauge) {
    const auto two = [](double t) { return 1.0 - (2.0 * std::exp(-t / 2.0) - 0.5 * std::exp(-t / 0.5)) / 1.5; };
    for (const double t : {0.6, 2.5}) {
        Tanks tanks = tank;
        tanks.pump_tau_s = 0.5;
        EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), t), 25.0 * two(t), 1e-3);
        tanks.pump_tau_s = 0.0;
        tanks.sensor_tau_s = 0.5;
        EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), t), 25.0 * two(t), 1e-3);
        tanks.sensor_tau_s = 0.0;
        tanks.delay_s = 0.3;
        EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), t), 25.0 * first(t - 0.3), 0.02);
        tanks.delay_s = 0.0;
        tanks.gain_growth_per_s = 0.1;
        EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), t), 25.0 * (first(t) + 0.1 * (t - 2.0 * first(t))), 1e-3);
    }
}

TEST(Tanks, TheirValveSticksAndItsLinkagePlays) {
    const Held steps = levels({{0.0, 0.25}, {40.0, 0.5}, {80.0, 0.75}, {120.0, 0.875}, {160.0, 0.5}});
    Tanks sticking = tank;
    sticking.stiction_band = 0.3;
    const double opened[] = {0.0, 0.5, 0.5, 0.875, 0.5};
    for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(filled(sticking, steps, 40.0 * i + 39.9, 0.02), 25.0 * opened[i], 1e-3) << i;
    }
    // A move of the band itself is none yet.
    sticking.stiction_band = 0.25;
    EXPECT_NEAR(filled(sticking, levels({{0.0, 0.25}}), 30.0, 0.02), 0.0, 1e-12);
    // Half of the flow goes through a linkage that lags by half its play, up and down.
    Tanks playing = tank;
    playing.play_width = 0.2;
    playing.play_share = 0.5;
    EXPECT_NEAR(filled(playing, levels({{0.0, 0.8}}), 40.0, 0.02), 25.0 * 0.75, 1e-3);
    EXPECT_NEAR(filled(playing, levels({{0.0, 0.8}, {40.0, 0.4}}), 80.0, 0.02), 25.0 * 0.45, 1e-3);
}

TEST(Tanks, BendTheirInputAtTheReference) {
    Tanks tanks = tank;
    tanks.curvature = 0.5;
    tanks.curve_reference = 1.6;
    EXPECT_NEAR(filled(tanks, levels({{0.0, 0.8}}), 40.0, 0.02), 20.0 * (1.0 + 0.5 * (0.8 / 1.6 - 1.0)), 1e-3);
    tanks = tank;
    tanks.threshold = 0.8;
    EXPECT_EQ(filled(tanks, levels({{0.0, 0.8}}), 10.0, 0.02), 0.0);
    tanks = tank;
    tanks.dead_zone = 0.2;
    tanks.input_limit = 0.7;
    EXPECT_NEAR(filled(tanks, levels({{0.0, 0.8}}), 40.0, 0.02), 15.0, 1e-3);
    EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), 40.0, 0.02), 17.5, 1e-3);
    // A quick tank shows the slope of its valve, up and down.
    tanks = tank;
    tanks.area_cm2 = 0.04;
    tanks.rate_per_s = 0.25;
    const Held there_and_back = levels({{0.0, 0.5}, {5.0, 0.25}});
    EXPECT_NEAR(filled(tanks, there_and_back, 1.0, 5e-4), 6.25, 0.1);
    EXPECT_NEAR(filled(tanks, there_and_back, 5.5, 5e-4), 9.375, 0.1);
    EXPECT_NEAR(filled(tanks, there_and_back, 7.0, 5e-4), 6.25, 1e-2);
}

// Without an outflow a level is the inflow summed up.
const Tanks closed{.area_cm2 = 10.0, .outflow_cm2_per_s = 0.0, .reference_cm = 25.0, .inflow_per_unit = 20.0};

TEST(Tanks, AreWiderAbove) {
    Tanks tanks = closed;
    tanks.upper_area_share = 3.0;
    tanks.wider_from_cm = 6.0;
    EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), 2.0), 4.0, 1e-9);
    EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), 7.0), 6.0 + 4.0 / 4.0 * 2.0, 0.01);
}

TEST(Tanks, OverflowAndAreNeverLessThanEmpty) {
    Tanks tanks = closed;
    tanks.overflow_cm = 5.0;
    tanks.disturbance_cm3_per_s = 10.0;
    tanks.disturbance_from_s = 4.0;
    tanks.disturbance_to_s = 5.0;
    EXPECT_EQ(filled(tanks, levels({{0.0, 1.0}, {3.0, 0.0}}), 3.5), 5.0);
    EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}, {3.0, 0.0}}), 4.5), 4.5, 0.01);
    EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}, {3.0, 0.0}}), 9.0), 4.0, 0.01);
    tanks.disturbance_to_s = 99.0;
    EXPECT_EQ(filled(tanks, levels({{0.0, 1.0}, {3.0, 0.0}}), 20.0), 0.0);
}

// Of a disturbance its beginning counts and its end does not: by Heun's one step from one to the other.
TEST(Tanks, AreDisturbedFromTheFirstMomentToBeforeTheLast) {
    Tanks tanks = closed;
    tanks.start_cm = 10.0;
    tanks.disturbance_cm3_per_s = 10.0;
    tanks.disturbance_to_s = 99.0;
    EXPECT_DOUBLE_EQ(filled(tanks, levels({{0.0, 0.0}}), 1.0, 1.0), 9.0);
    tanks.disturbance_to_s = 1.0;
    EXPECT_DOUBLE_EQ(filled(tanks, levels({{0.0, 0.0}}), 1.0, 1.0), 9.5);
}

TEST(Tanks, PrimeTheirPumpWheneverItStarts) {
    Tanks tanks = closed;
    tanks.priming_s = 1.5;
    const Held twice = levels({{0.0, 1.0}, {4.0, 0.0}, {5.0, 1.0}});
    EXPECT_EQ(filled(tanks, twice, 1.4), 0.0);
    EXPECT_NEAR(filled(tanks, twice, 4.5), 2.0 * 2.5, 0.02);
    EXPECT_NEAR(filled(tanks, twice, 6.4), 2.0 * 2.5, 0.02);
    EXPECT_NEAR(filled(tanks, twice, 8.0), 2.0 * (2.5 + 1.5), 0.03);
}

TEST(Tanks, HaveASiphonThatStartsFullAndEndsLow) {
    Tanks tanks = closed;
    tanks.siphon_cm3_per_s = 60.0;
    tanks.siphon_on_cm = 8.0;
    tanks.siphon_off_cm = 2.0;
    // Up by 2 cm/s to 8 cm in 4 s, down by 4 cm/s to 2 cm in 1.5 s, up again in 3 s.
    for (const auto& [t, level] : {std::pair(3.9, 7.8), std::pair(4.75, 5.0), std::pair(5.4, 2.4), std::pair(6.5, 4.0),
                                   std::pair(8.4, 7.8), std::pair(9.0, 6.0)}) {
        EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), t, 0.001), level, 0.05) << t;
    }
}

TEST(Tanks, TakeWhatSomebodyElsePumps) {
    Tanks tanks = tank;
    tanks.pulsing_cm3_per_s = 10.0;
    tanks.pulsing_period_s = 3.0;
    const double w = 2.0 * std::numbers::pi / 3.0;
    for (const double t : {5.7, 7.9}) {
        EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), t), 25.0 * first(t) + 2.5 * swung(t, w, 2.0), 2e-3);
    }
}

// The delay swings between its own and `depth` more: d + depth (1 + sin(2 pi t / T)) / 2.
TEST(Tanks, WaitForADelayThatSwings) {
    Tanks tanks = closed;
    tanks.delay_s = 0.5;
    tanks.delay_depth_s = 0.8;
    tanks.delay_period_s = 20.0;
    const auto delay_at = [](double t) { return 0.5 + 0.4 * (1.0 + std::sin(2.0 * std::numbers::pi * t / 20.0)); };
    for (const double from_s : {0.0, 4.0, 13.0}) {
        // It begins where t - delay(t) reaches the command; from then on the level rises evenly.
        double begins_s = from_s;
        for (int i = 0; i < 60; ++i) {
            begins_s = from_s + delay_at(begins_s);
        }
        const Held late = levels({{0.0, 0.0}, {from_s, 1.0}});
        EXPECT_NEAR(filled(tanks, late, begins_s + 2.0), 4.0, 0.01) << from_s;
    }
}

// Bubbles take their share of the flow, in turns of half to one and a half times their mean time.
TEST(Tanks, PassBubbles) {
    Tanks tanks = closed;
    tanks.bubbles_share = 0.4;
    tanks.bubbles_s = 2.0;
    std::vector<double> at_s;
    for (int k = 0; k <= 200'000; ++k) {
        at_s.push_back(0.01 * k);
    }
    const auto level = stand::hydraulic::gauge(tanks, levels({{0.0, 1.0}}), at_s, 0.01);
    std::vector<double> turns_s;
    double begun_s = 0.0;
    bool thin = false;
    for (std::size_t k = 1; k < level.size(); ++k) {
        const double rate = (level[k] - level[k - 1]) / 0.01;
        EXPECT_TRUE(std::fabs(rate - 2.0) < 1e-5 || std::fabs(rate - 1.2) < 1e-5) << rate;
        if ((rate < 1.6) != thin) {
            thin = !thin;
            turns_s.push_back(at_s[k - 1] - begun_s);
            begun_s = at_s[k - 1];
        }
    }
    EXPECT_NEAR(*std::min_element(turns_s.begin(), turns_s.end()), 1.0, 0.02);
    EXPECT_NEAR(*std::max_element(turns_s.begin(), turns_s.end()), 3.0, 0.02);
    EXPECT_NEAR(2000.0 / static_cast<double>(turns_s.size()), 2.0, 0.1);
    // Another seed, other bubbles.
    tanks.bubbles_seed = 1;
    EXPECT_NE(stand::hydraulic::gauge(tanks, levels({{0.0, 1.0}}), std::vector{100.0}, 0.01).front(), level[10'000]);
}

TEST(Tanks, FillTheSecondThroughTheFirst) {
    Tanks tanks = tank;
    tanks.two = true;
    tanks.first_area_cm2 = 4.0;
    tanks.first_outflow_cm2_per_s = 8.0;  // 0.5 s, and at the same flow half as high
    const auto two = [](double t) { return 1.0 - (2.0 * std::exp(-t / 2.0) - 0.5 * std::exp(-t / 0.5)) / 1.5; };
    EXPECT_NEAR(filled(tanks, levels({{0.0, 1.0}}), 1.7), 25.0 * two(1.7), 1e-3);
    // All levels begin where they stood: both empty by themselves.
    tanks.start_cm = 10.0;
    const double t = 1.0;
    const double from_first = 8.0 * 10.0 / 8.0 * (std::exp(-t / 2.0) - std::exp(-t / 0.5)) / (1.0 / 0.5 - 1.0 / 2.0);
    EXPECT_NEAR(filled(tanks, levels({{0.0, 0.0}}), t), 10.0 * std::exp(-t / 2.0) + from_first, 1e-3);
    // A hole and a pipe at once: r sqrt and 1 - r straight; at rest the flows are equal.
    Tanks holed = tank;
    holed.root_share = 0.4;
    const double level = filled(holed, levels({{0.0, 0.5}}), 60.0, 0.02);
    EXPECT_NEAR(100.0 * (0.6 * level / 25.0 + 0.4 * std::sqrt(level / 25.0)), 50.0, 1e-4);
}

}  // namespace
