// Sets of blind cases are made again from their seeds: which draw decides what, in which order and at which odds, is a
// part of what a seed fixes. Each choice is followed here draw by draw.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "drive/stand/blind/profile.hpp"
#include "drive/stand/blind/series.hpp"

namespace {

namespace blind = stand::blind;
using blind::digits;
using stand::Chance;

constexpr std::uint64_t seeds = 3000;

void skip(Chance& chance, int draws) {
    for (int i = 0; i < draws; ++i) {
        (void)chance.share();
    }
}

// What a rig at rest shows before anything happens.
double shown_at_rest(const blind::Rig& rig) { return rig.read({}, {{0.0}, {0.0}}, {}, 1).front(); }

TEST(Chances, OfMachines) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::mechanical_family().draw({}, chance);
        Chance same(seed, 5);
        const double which = same.share();
        const bool physical = which < 0.4;
        const bool fractional = which > 0.85;
        EXPECT_EQ(rig->plant, physical ? "stand" : fractional ? "fractional" : "whole") << seed;
        EXPECT_EQ(rig->input, physical ? "duty" : "input");
        EXPECT_EQ(rig->remembers, fractional);
        const double pace = physical || same.happens(0.75) ? 1.0 : digits(same.scaled(0.5, 6.0));
        EXPECT_DOUBLE_EQ(rig->clock.interval_s, 0.01 * pace) << seed;
        const double samples = same.happens(0.7) ? 4000.0 : 250.0 * std::round(same.between(8.0, 22.0));
        EXPECT_DOUBLE_EQ(rig->clock.until_s, samples * rig->clock.interval_s) << seed;
        EXPECT_DOUBLE_EQ(rig->clock.spread_s, same.happens(0.5) ? 0.1 * rig->clock.interval_s : 0.0) << seed;
        double full_output = 0.0;
        if (physical) {
            (void)same.scaled(0.02, 0.08);
            const double thrust = digits(same.between(5.0, 9.0));
            const double gravity = digits(same.scaled(0.4, 1.2));
            skip(same, 3);
            full_output = rig->full_input * thrust * stand::Stand().arm_m / gravity;
        } else {
            EXPECT_DOUBLE_EQ(rig->tau_s, digits(pace * same.scaled(0.15, 0.9)));
            const double gain = digits(same.scaled(0.2, 20.0));
            EXPECT_EQ(rig->full_input,
                      same.happens(0.5) ? digits(same.between(0.3, 1.0)) : digits(same.between(1.0, 12.0)))
                << seed;
            if (!same.happens(0.3)) {  // a dead time
                skip(same, 1);
            }
            const std::size_t shape = same.below(3);
            skip(same, fractional && shape != 0 ? 3 : 1);
            full_output = rig->full_input * gain;
            EXPECT_EQ(rig->output, same.happens(0.5) ? "output" : "y") << seed;
        }
        const double offset = same.happens(0.5) ? full_output * same.between(-0.3, 0.5) : 0.0;
        EXPECT_NEAR(shown_at_rest(*rig), offset, 2e-3 * full_output) << seed;
    }
    // What no stand can have is asked of a linear plant, and what only a stand has of one.
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Chance chance(seed, 5);
        EXPECT_NE(blind::mechanical_family().draw({"cubic_stiffness"}, chance)->plant, "stand");
        EXPECT_NE(blind::mechanical_family().draw({"backlash", "order_error"}, chance)->plant, "stand");
        EXPECT_EQ(blind::mechanical_family().draw({"start_up_time"}, chance)->plant, "stand");
    }
}

TEST(Chances, OfOvens) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::thermal_family().draw({}, chance);
        Chance same(seed, 5);
        EXPECT_EQ(rig->tau_s, digits(same.scaled(20.0, 2000.0)));
        skip(same, 1);
        const double full = same.happens(0.4) ? 100.0 : same.happens(0.5) ? 1.0 : digits(same.between(5.0, 230.0));
        skip(same, 1);
        const bool wall = same.happens(0.5);
        EXPECT_EQ(rig->plant, wall ? "body and wall" : "body") << seed;
        skip(same, wall ? 3 : 1);
        if (!same.happens(0.4)) {  // a dead time
            skip(same, 1);
        }
        if (!same.happens(0.5)) {  // a thermometer's lag
            skip(same, 1);
        }
        EXPECT_NEAR(shown_at_rest(*rig), digits(same.between(5.0, 30.0)), 1e-9) << seed;
        EXPECT_EQ(rig->input, same.happens(0.5) ? "input" : "duty") << seed;
        EXPECT_EQ(rig->output, same.happens(0.5) ? "output" : "y") << seed;
        EXPECT_EQ(rig->full_input, rig->input == "duty" ? 1.0 : full) << seed;
        EXPECT_EQ(rig->clock.interval_s, digits(rig->tau_s / same.between(20.0, 40.0)));
        EXPECT_DOUBLE_EQ(rig->clock.until_s, rig->clock.interval_s * 250.0 * std::round(same.between(6.0, 12.0)));
    }
}

TEST(Chances, OfTanks) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::hydraulic_family().draw({}, chance);
        Chance same(seed, 5);
        EXPECT_EQ(rig->tau_s, digits(same.scaled(4.0, 400.0)));
        const double full_cm = digits(same.scaled(5.0, 200.0));
        EXPECT_EQ(rig->full_input, same.happens(0.4)   ? 10.0
                                   : same.happens(0.5) ? 100.0
                                                       : digits(same.between(2.0, 24.0)))
            << seed;
        EXPECT_EQ(rig->plant, same.happens(0.5) ? "two tanks" : "one tank") << seed;
        skip(same, 2);
        if (!same.happens(0.5)) {  // a pump's lag
            skip(same, 1);
        }
        if (!same.happens(0.4)) {  // a dead time
            skip(same, 1);
        }
        EXPECT_NEAR(shown_at_rest(*rig), same.happens(0.5) ? 0.0 : digits(full_cm * same.between(-0.3, 0.6)), 1e-9)
            << seed;
        EXPECT_EQ(rig->input, "input");
        EXPECT_EQ(rig->output, same.happens(0.5) ? "output" : "y") << seed;
        EXPECT_EQ(rig->clock.interval_s, digits(rig->tau_s / same.between(20.0, 40.0)));
        EXPECT_DOUBLE_EQ(rig->clock.until_s, rig->clock.interval_s * 250.0 * std::round(same.between(6.0, 12.0)));
    }
}

// The levels that a sequence goes through, each with how long it holds.
TEST(Chances, OfLevelsAndBits) {
    const blind::Clock clock{.interval_s = 0.01, .spread_s = 0.0, .until_s = 40.0};
    constexpr double tau_s = 0.4;
    for (const char* kind : {"levels", "prbs"}) {
        const bool bits = kind[0] == 'p';
        for (std::uint64_t seed = 1; seed <= 300; ++seed) {
            Chance chance(seed, 3);
            const auto held = blind::make_profile(kind, clock, 1.0, tau_s, chance);
            Chance same(seed, 3);
            const double rest_s = same.between(0.01, 0.04) * clock.until_s;
            const double low = bits ? same.between(0.2, 0.5) : 0.0;
            const double bit_s = tau_s * same.between(0.7, 2.0);
            skip(same, 2);
            for (double t = rest_s; t < clock.until_s;) {
                const double level = bits                 ? (same.happens(0.5) ? 1.0 : low)
                                     : same.happens(0.15) ? 0.0
                                                          : 0.01 * std::round(same.between(15.0, 100.0));
                const double for_s = bits ? bit_s : tau_s * same.between(3.0, 8.0);
                const auto middle = static_cast<std::size_t>(std::lround((t + 0.5 * for_s) / clock.interval_s));
                if (middle < held.input.size()) {
                    EXPECT_NEAR(held.input[middle], level, 1e-4) << kind << ' ' << seed << ' ' << t;
                }
                t += for_s;
            }
        }
    }
}

}  // namespace
